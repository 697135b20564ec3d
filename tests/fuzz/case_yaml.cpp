// SPDX-License-Identifier: GPL-3.0-or-later
// A case file: read, converted, written and read again.
#include "proto/yaml.hpp"
#include "seaway/v1/case.pb.h"
#include "server/convert/case.hpp"
#include "server/convert/input_error.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seaway;
  v1::Case message;
  try {
    yaml::read(fuzz::view(data, size), "case.yaml", message);
  } catch (const yaml::InputError&) {
    return 0;
  }
  try {
    convert::to_core(message);
  } catch (const convert::InputError& error) {
    fuzz::require(!error.problems().empty(), "a case is refused without a reason");
    return 0;
  }
  // A case that is accepted survives being shown and submitted again.
  v1::Case again;
  yaml::read(yaml::write(message), "again.yaml", again);
  fuzz::require(again.SerializeAsString() == message.SerializeAsString(), "another case after writing and reading");
  return 0;
}
