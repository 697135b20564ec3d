// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints. The check sum of the whole file is put right, so that what lies behind it is reached.
#include <zlib.h>

#include <cstring>

#include "core/base/error.hpp"
#include "core/io/checkpoint.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seaway;
  std::string bytes(fuzz::view(data, size));
  if (size >= 4) {
    const auto sum = static_cast<std::uint32_t>(::crc32(0, data, static_cast<unsigned>(size - 4)));
    std::memcpy(bytes.data() + size - 4, &sum, 4);
  }
  const fuzz::InputFile file(bytes);
  try {
    const io::CheckpointReader reader(file.path(), "digest");
    reader.text("meta");
    reader.values("pose");
  } catch (const Error& error) {
    fuzz::require(error.code() == ErrorCode::data_loss, error.what());
  }
  return 0;
}
