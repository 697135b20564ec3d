// SPDX-License-Identifier: GPL-3.0-or-later
// The solver as the service sees it: two functions. The programs bind them to sim::run_cascade and
// sim::check_case, tests to a deterministic stand-in.
#pragma once

#include <functional>

#include "core/sim/cascade.hpp"
#include "core/sim/check_case.hpp"

namespace seaway::jobs {

struct Solver {
  std::function<sim::RunOutcome(const sim::Case&, const sim::RunOptions&, sim::RunObserver&, const RunContext&)> run;
  std::function<sim::CaseReport(const sim::Case&)> check;
};

}  // namespace seaway::jobs
