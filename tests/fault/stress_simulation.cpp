// SPDX-License-Identifier: GPL-3.0-or-later
// simulation: queue, store and a stand-in for the solver under a simulated clock and disk, with crashes, seed by seed.
#include <chrono>
#include <cstdio>

#include "tests/fault/stress.hpp"
#include "tests/simulation/simulation.hpp"

namespace seaway::stress {

std::vector<Line> simulation(const Settings& s) {
  const auto began = std::chrono::steady_clock::now();
  int violations = 0;
  std::int64_t crashes = 0, jobs = 0, samples = 0;
  for (int i = 0; i < s.seeds; ++i) {
    const std::uint64_t seed = s.seed + static_cast<std::uint64_t>(i);
    const auto result = testing::simulate(seed, false);
    violations += static_cast<int>(result.violations.size());
    crashes += result.crashes;
    jobs += result.jobs;
    samples += result.samples;
    for (const auto& text : result.violations)
      std::fprintf(stderr, "simulation: seed %llu: %s\n", static_cast<unsigned long long>(seed), text.c_str());
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  std::fprintf(stderr, "simulation: %d seeds from %u in %.1f s: %lld jobs, %lld crashes, %lld samples seen\n", s.seeds, s.seed,
               wall, static_cast<long long>(jobs), static_cast<long long>(crashes), static_cast<long long>(samples));
  int found = 1;
  while (found < 10'000 && testing::simulate(s.seed + static_cast<std::uint64_t>(found) - 1, true).violations.empty()) ++found;
  return {{"simulation", "violations", static_cast<double>(violations), "1", 0, wall},
          {"simulation", "planted_bug_seed", static_cast<double>(found), "1", 200, 0}};
}

}  // namespace seaway::stress
