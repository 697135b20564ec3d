// SPDX-License-Identifier: GPL-3.0-or-later
// A case file with the files that it names, as a client sends it.
#pragma once

#include <string>

#include "client/job_client.hpp"
#include "proto/yaml.hpp"

namespace seaway::client {

struct CaseInput {
  v1::Case message;
  yaml::SourceMap lines;
  google::protobuf::RepeatedPtrField<v1::CaseFile> files;
};

/// Throws yaml::InputError for what is wrong with it, a named file that cannot be opened included.
CaseInput read_case(const std::string& path);

/// What the service says about fields, with the lines of the file. Paths begin inside the case.
[[noreturn]] void rethrow_with_lines(const RpcError& error, const CaseInput& in, const std::string& file);

}  // namespace seaway::client
