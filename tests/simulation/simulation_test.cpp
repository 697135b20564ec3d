// SPDX-License-Identifier: GPL-3.0-or-later
// The short form of `seaway-stress simulation`; SEAWAY_SEED=n runs that seed alone.
#include "tests/simulation/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace seaway::testing {
namespace {

constexpr std::uint64_t seeds = std::max(20, 400 / SEAWAY_SLOWDOWN);  // fewer under sanitizers

TEST(Simulation, KeepsEveryPromiseOverManySeeds) {
  const char* chosen = std::getenv("SEAWAY_SEED");
  const std::uint64_t first = chosen != nullptr ? std::strtoull(chosen, nullptr, 10) : 1;
  int crashes = 0;
  std::int64_t samples = 0;
  for (std::uint64_t seed = first; seed < first + (chosen != nullptr ? 1 : seeds); ++seed) {
    const SimulationResult result = simulate(seed, false);
    crashes += result.crashes;
    samples += result.samples;
    for (const auto& text : result.violations) ADD_FAILURE() << "seed " << seed << ": " << text;
  }
  if (chosen != nullptr) return;
  EXPECT_GT(crashes, static_cast<int>(seeds)) << "the simulation has to be rough";
  EXPECT_GT(samples, static_cast<std::int64_t>(25 * seeds));
}

TEST(Simulation, SameSeedDoesTheSame) {
  for (std::uint64_t seed = 1; seed <= std::min<std::uint64_t>(20, seeds / 4); ++seed) {
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
