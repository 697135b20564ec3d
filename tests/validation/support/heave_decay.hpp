// A body let go above the position in which it floats, free in heave only: its record, and what is read off it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/sim/case.hpp"
#include "tests/validation/results.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {

struct HeaveDecay {
  Record heave;            ///< [m] from the position afloat, the release at t = 0 included
  std::int64_t cells = 0;
  double cpu_s = 0;

  /// Twice the time from the first to the second crossing of the position afloat [s]; not a number if it is not reached.
  double period() const;
  /// Turning point number i >= 1 after the release [m]; not a number if it is not reached.
  double peak(std::size_t i) const;
};

/// Runs the first stage of the case, a section or a ship by its `dim`, for `duration` seconds. Throws Error(diverged).
HeaveDecay run_heave_decay(const sim::Case& c, double duration, int threads);

/// Order p of |f - f_h| = C h^p of the whole record, from its rms changes over three meshes, each twice as fine as the one
/// before, run with the same steps.
double order_of_records(const Record& coarse, const Record& medium, const Record& fine);

/// Three meshes with cells of h, h / 2, h / 4: the order of the record, which has to be 1 at least (the wall's treatment is
/// of first order); period and first three peaks (in release heights) on each, and their changes between the two finest, at most
/// `largest_change` of the value.
void report_refinement(const std::array<HeaveDecay, 3>& runs, double h, double release_height, double largest_change,
                       Results& results);

}  // namespace seaway::validation
