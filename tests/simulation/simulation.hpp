// SPDX-License-Identifier: GPL-3.0-or-later
// Queue, store and a stand-in for the solver in one thread, with a clock, a disk and crashes that a seed chooses:
// the same seed always does the same. What clients were told is remembered outside, and compared.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace seaway::testing {

struct SimulationResult {
  std::vector<std::string> violations;
  int crashes = 0, jobs = 0;
  std::int64_t samples = 0;       ///< that clients have received
  std::uint64_t fingerprint = 0;  ///< of all that happened
};

/// `planted_bug`: the store publishes before its commit.
SimulationResult simulate(std::uint64_t seed, bool planted_bug);

}  // namespace seaway::testing
