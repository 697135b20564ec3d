// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/json.hpp"

#include <google/protobuf/util/json_util.h>

#include <stdexcept>

namespace seaway {

std::string to_json(const google::protobuf::Message& message, bool indented) {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = indented;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string out;
  if (const auto status = google::protobuf::util::MessageToJsonString(message, &out, options); !status.ok())
    throw std::runtime_error("cannot be written as JSON: " + status.ToString());
  return out;
}

}  // namespace seaway
