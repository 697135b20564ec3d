// SPDX-License-Identifier: GPL-3.0-or-later
// The short form of `seaway-stress simulation`; SEAWAY_SEED=n runs that seed alone.
#include "tests/simulation/simulation.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace seaway::testing {
namespace {

TEST(Simulation, KeepsEveryPromiseOverManySeeds) {
  const char* chosen = std::getenv("SEAWAY_SEED");
  const std::uint64_t first = chosen != nullptr ? std::strtoull(chosen, nullptr, 10) : 1;
  int crashes = 0;
  std::int64_t samples = 0;
  for (std::uint64_t seed = first; seed < first + (chosen != nullptr ? 1 : 400); ++seed) {
    const SimulationResult result = simulate(seed, false);
    crashes += result.crashes;
    samples += result.samples;
    for (const auto& text : result.violations) ADD_FAILURE() << "seed " << seed << ": " << text;
  }
  if (chosen != nullptr) return;
  EXPECT_GT(crashes, 400) << "the simulation has to be rough";
  EXPECT_GT(samples, 10'000);
}

TEST(Simulation, SameSeedDoesTheSame) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SimulationResult a = simulate(seed, false), b = simulate(seed, false);
    EXPECT_EQ(a.fingerprint, b.fingerprint) << seed;
    EXPECT_EQ(a.crashes, b.crashes);
    EXPECT_EQ(a.samples, b.samples);
  }
}

TEST(Simulation, FindsThePlantedBugWithinTwoHundredSeeds) {
  std::uint64_t found = 0;
  for (std::uint64_t seed = 1; seed <= 200 && found == 0; ++seed)
    if (!simulate(seed, true).violations.empty()) found = seed;
  EXPECT_GT(found, 0u);
}

}  // namespace
}  // namespace seaway::testing
