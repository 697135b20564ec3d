// SPDX-License-Identifier: GPL-3.0-or-later
// A message as JSON with the field names of the schema and all fields written out. As protobuf has it,
// 64-bit integers are strings.
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace seaway {

/// One line, or indented. Throws std::runtime_error for text that is not UTF-8.
std::string to_json(const google::protobuf::Message& message, bool indented = false);

}  // namespace seaway
