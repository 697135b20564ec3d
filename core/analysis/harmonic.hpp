// SPDX-License-Identifier: GPL-3.0-or-later
// Harmonics of a response at a known frequency over the last whole periods. Pure functions.
#pragma once

#include "core/analysis/local_fit.hpp"

namespace seaway::analysis {

/// x(t) = mean + amplitude cos(omega t + phase) + second harmonic, least squares over whole periods; each sample counts
/// as much as the time around it.
struct Harmonic {
  double mean = 0, amplitude = 0;
  double phase = 0;            ///< of t = 0, positive leads [rad], in (-pi, pi]
  double second = 0;           ///< amplitude of the second harmonic
  int periods = 0;
  double from = 0, until = 0;  ///< [s]
  /// Over the periods, each fitted by itself: standard deviations, and the change of amplitude from the first to the
  /// last one by a straight line. 0 with one period.
  double amplitude_scatter = 0, phase_scatter = 0, amplitude_trend = 0;
};

/// Over the last `periods` periods of the signal, or as many as it has. Throws Error(failed_precondition) if that is
/// none or if they have fewer than 10 samples each.
Harmonic fit_harmonic(const Signal& signal, double omega, int periods);

/// The angle in (-pi, pi].
double wrap(double angle);

}  // namespace seaway::analysis
