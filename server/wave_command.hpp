// SPDX-License-Identifier: GPL-3.0-or-later
// `seaway-run wave`: the wave that a case asks for, and what arrives of it at the ship's place in the empty tank.
#pragma once

#include <string>

#include "server/jobs/solver.hpp"

namespace seaway::server {

struct WaveOptions {
  std::string folder;     ///< pictures and their data; empty: none
  bool json = false;
  bool calibrate = false; ///< run the empty tank
  std::string run_folder; ///< of that run
  double duration = 0;    ///< that is looked at, there and in the picture [s]; 0: 20 periods
  int threads = 0;        ///< 0: all cores
};

/// Prints the report and returns the exit code: 3 if the calibration was stopped, 1 if it diverged. Throws Error.
int print_wave(const sim::Case& c, const WaveOptions& options, const jobs::Solver& solver);

}  // namespace seaway::server
