// SPDX-License-Identifier: GPL-3.0-or-later
// A solver that computes nothing real, for tests of the service: deterministic samples, stages, checkpoints
// of its own, artifacts; it can be stopped and resumed, and ends with the same bits as an unbroken run.
//
// The number of steps of a stage is its duration over time.dt (0.01 s if not given), at most 1e6. A title
// with the word "diverge" blows up in the last stage; one with "broken" has an error in its check;
// for "fault" see fake_fault.hpp.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>

#include "server/jobs/solver.hpp"

namespace seaway::testing {

struct FakeOptions {
  std::chrono::microseconds step{0};  ///< wall time of a step
  int checkpoint_steps = 0;           ///< a checkpoint every so many steps; 0: by the interval of the options
  double perturbation = 0;            ///< added to heave: a solver that does not repeat itself
  bool clock = false;                 ///< two more channels, the last one the steady clock [s]: to measure delays
  /// The run waits before a step while this is below the step's number (tests let it go on step by step).
  std::shared_ptr<std::atomic<std::int64_t>> allowed_steps;
};

jobs::Solver fake_solver(FakeOptions options = {});

}  // namespace seaway::testing
