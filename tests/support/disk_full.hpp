// SPDX-License-Identifier: GPL-3.0-or-later
// The shared memory between a test and the programs whose disk it fills.
#pragma once

#include <atomic>
#include <cstdint>

namespace seaway::testing {

struct DiskFullControl {
  std::atomic<std::int64_t> writes;     ///< so far, refused ones included
  std::atomic<std::int64_t> full_from;  ///< number of the first write that fails; < 0: none
  std::atomic<std::int64_t> refused;
};

}  // namespace seaway::testing
