// SPDX-License-Identifier: GPL-3.0-or-later
// The half cycles of a damped oscillation: where it crosses a level and where it turns.
#pragma once

#include <vector>

#include "core/analysis/local_fit.hpp"

namespace seaway::analysis {

struct HalfCycles {
  /// Turning points; the first one is the release where `from_release`, else the first that lies between crossings.
  std::vector<TurningPoint> turns;
  /// crossings[i] lies between turns[i] and turns[i + 1]. One more than that if the record does not begin at a turn:
  /// then crossings[0] comes before turns[0].
  std::vector<double> crossings;
  bool from_release = false;

  double before(std::size_t turn) const { return crossings[from_release ? turn - 1 : turn]; }
  double after(std::size_t turn) const { return crossings[from_release ? turn : turn + 1]; }
};

/// Splits the signal about `level`. A crossing counts if the signal then leaves the level by more than `smallest` times
/// its first peak (or, if that is more, four times the noise, which is estimated from second differences); the first
/// half cycle that does not reach so far ends the search. Complete half cycles only.
HalfCycles find_half_cycles(const Signal& signal, double level, double smallest);

}  // namespace seaway::analysis
