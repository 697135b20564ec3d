// SPDX-License-Identifier: GPL-3.0-or-later
// Zero crossings and turning points of a sampled oscillation, from polynomials fitted to the samples around them: less
// sensitive to noise than single samples, and finer than their distance.
#pragma once

#include <span>

namespace seaway::analysis {

/// Times [s], increasing, and values; equally many.
struct Signal {
  std::span<const double> t, x;
};

struct TurningPoint {
  double time = 0, value = 0;
};

/// Where x crosses `level` near `guess`: root of the cubic fitted to the samples within `reach` [s] of it. With fewer
/// than six samples there: `guess`.
double find_crossing(const Signal& signal, double level, double guess, double reach);

/// Extremum of the quartic fitted to the samples within `reach` of `guess`; with fewer than eight samples there the
/// sample farthest from `level`.
TurningPoint find_turning_point(const Signal& signal, double level, double guess, double reach);

/// Value at the first sample of a motion that begins there at rest: c0 + c2 s^2 + c3 s^3 + c4 s^4 fitted over `reach`.
double value_at_release(const Signal& signal, double reach);

}  // namespace seaway::analysis
