// SPDX-License-Identifier: GPL-3.0-or-later
// STL files, binary and ASCII. The first byte chooses the unit.
#include "core/base/error.hpp"
#include "core/hull/stl_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seaway;
  if (size == 0) return 0;
  constexpr double units[] = {1, 0.001, 0.0254, 0, -1};
  const fuzz::InputFile file(fuzz::view(data + 1, size - 1));
  try {
    const hull::Surface surface = hull::read_stl(file.path(), units[data[0] % 5]);
    fuzz::require(!surface.triangles.empty() && units[data[0] % 5] > 0, "a surface of nothing");
  } catch (const Error& error) {
    fuzz::require(error.code() == ErrorCode::invalid_argument, error.what());
  }
  return 0;
}
