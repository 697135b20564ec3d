// SPDX-License-Identifier: GPL-3.0-or-later
// seawayd and (compiled with SEAWAY_FAKE_OFFLINE) seaway-run, also as a worker, with the fake solver, for tests with real
// processes. SEAWAY_FAKE_STEP_US and SEAWAY_FAKE_CHECKPOINT_STEPS set the pace.
#include <cstdlib>
#include <optional>
#include <string_view>

#include "server/daemon.hpp"
#include "server/jobs/worker.hpp"
#include "server/offline.hpp"
#include "tests/support/fake_cascade.hpp"

int main(int argc, char** argv) {
  std::optional<seaway::jobs::Worker> worker;
  if (seaway::jobs::Worker::is_asked_for(argc, argv)) worker.emplace();
  seaway::server::block_signals();
  seaway::testing::FakeOptions options;
  if (const char* step = std::getenv("SEAWAY_FAKE_STEP_US")) options.step = std::chrono::microseconds(std::atoi(step));
  if (const char* steps = std::getenv("SEAWAY_FAKE_CHECKPOINT_STEPS")) options.checkpoint_steps = std::atoi(steps);
  options.clock = std::getenv("SEAWAY_FAKE_CLOCK") != nullptr;
  const auto solver = seaway::testing::fake_solver(options);
  if (worker) return worker->run(solver);
#ifdef SEAWAY_FAKE_OFFLINE
  return seaway::server::run_offline(argc, argv, solver);
#else
  return seaway::server::run_daemon(argc, argv, solver, false);
#endif
}
