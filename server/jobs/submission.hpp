// SPDX-License-Identifier: GPL-3.0-or-later
// From a request to something that can run: files in place, defaults applied, checked.
#pragma once

#include <string>

#include "core/sim/case.hpp"
#include "seaway/v1/job_service.pb.h"
#include "server/jobs/solver.hpp"
#include "server/jobs/workspace.hpp"

namespace seaway::jobs {

using Files = google::protobuf::RepeatedPtrField<v1::CaseFile>;

/// Bytes of a message that are the same for equal messages: digests are taken of them.
std::string serialise(const google::protobuf::Message& message);

/// What is stored of a submitted job: case and files, nothing of the request around them.
std::string encode_spec(const v1::Case& message, const Files& files);
v1::CreateJobRequest decode_spec(const std::string& spec);

/// The case with its file names replaced by places in the workspace. Throws convert::InputError for wrong
/// fields, for a file that the case names but the request lacks, and for one that nothing names.
sim::Case bind_case(const v1::Case& message, const Files& files, const Workspace& workspace);

/// Throws convert::InputError for files that are too many, too large, without a name or given twice.
void check_files(const Files& files);
/// bind_case, then the solver's own check. Does not throw for what the check finds; see report.ok.
v1::CaseReport check_case(const v1::Case& message, const Files& files, const Workspace& workspace, const Solver& solver);

/// Paths of the fields in which two specs differ, at most a dozen.
std::vector<std::string> differing_fields(const std::string& spec_a, const std::string& spec_b);

}  // namespace seaway::jobs
