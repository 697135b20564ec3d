// SPDX-License-Identifier: GPL-3.0-or-later
// The empty tank of a case: does the wave arrive where the ship will be?
#pragma once

#include <string>

#include "core/base/run_context.hpp"
#include "server/jobs/solver.hpp"

namespace seaway::server {

/// The case without its hull, on the mesh of its last stage, with three gauges about the ship's place for
/// settle + duration seconds.
struct EmptyTank {
  sim::Case tank;
  double settle = 0;      ///< [s] before the window: the way of the energy through the tank and back
  double duration = 0;    ///< [s] of the window
  std::array<double, 3> places{};  ///< of the gauges along the heading [m]; the first one is the ship's
};

/// `duration` in whole periods for a regular wave; 0: 20 periods. Throws Error(invalid_argument) if the gauges do not fit
/// between the zones.
EmptyTank empty_tank(const sim::Case& c, double duration);

struct Calibration {
  double height = 0, asked_height = 0;  ///< at the ship: mean crest to trough, of a sea Hs; and of the wave as asked for
  double period = 0, asked_period = 0;  ///< mean zero up-crossing period, likewise
  double length = 0, asked_length = 0;  ///< from the phases of two gauges; of a sea at its peak period
  double peak_period = 0, asked_peak_period = 0;  ///< of smoothed spectra; seas only
  double reflection = 0;                ///< [mansard1980]
};

/// What the history of the empty tank says (history.csv in `folder`).
Calibration evaluate(const EmptyTank& tank, const std::string& folder);

}  // namespace seaway::server
