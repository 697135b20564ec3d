// SPDX-License-Identifier: GPL-3.0-or-later
// Free decay of a motion: periods, turning points, and two ways to say how it is damped. Any unit of the angle; what has
// one comes back in it. Pure functions.
#pragma once

#include <optional>
#include <vector>

#include "core/analysis/least_squares.hpp"
#include "core/analysis/local_fit.hpp"

namespace seaway::analysis {

struct DecayPeak {
  double time = 0;                      ///< [s]
  double angle = 0;                     ///< with its sign, from the mean
  std::optional<double> period;         ///< twice the distance of the crossings around it [s]
  std::optional<double> loss, mean;     ///< of |angle| to the next peak, and their mean
  std::optional<double> damping_ratio;  ///< of the half cycle that follows, from the logarithmic decrement
};

/// Cycle n from turning point 2 (n - 1) to 2 n.
struct DecayCycle {
  int number = 1;
  double angle = 0;
  double period = 0;         ///< between its first crossing and that of the next cycle [s]
  double damping_ratio = 0;  ///< from the logarithmic decrement over the cycle
};

/// mean + amplitude exp(-zeta omega_0 s) cos(2 pi s / period + phase), s = t - start, over all samples of the cycles.
struct DampedCosine {
  Estimate period, damping_ratio, amplitude, mean;
  double phase = 0;  ///< [rad]
  double start = 0;  ///< [s]
  double residual = 0;
};

/// loss = linear m + quadratic m^2 per half cycle, m the mean of two turning points [froude1874], as least squares over
/// the turning points themselves: the sequence p_0, p_1 = p_0 - loss ... , with p_0 and the mean angle as unknowns. (Over
/// the losses, neighbours would share a turning point and its error, and the intervals would be wrong.)
struct Extinction {
  Estimate linear, quadratic, mean;
  double residual = 0;
};

struct DecayOptions {
  double smallest_peak = 0.02;  ///< part of the first peak below which half cycles are left out
};

struct Decay {
  std::vector<double> crossings;  ///< of the mean angle [s]
  std::vector<DecayPeak> peaks;
  std::vector<DecayCycle> cycles;
  Estimate mean_period;  ///< of the cycles
  DampedCosine damped_cosine;
  std::optional<Extinction> extinction;  ///< five turning points and more
};

/// Index of the sample at which a motion that was held begins: the last of the leading equal values.
std::size_t begin_of_motion(const Signal& signal);

/// The signal should begin at the release (it then counts as the first turning point) or anywhere later. Throws
/// Error(failed_precondition) if it shows fewer than two half cycles or is not finite.
Decay analyse_decay(const Signal& signal, const DecayOptions& options = {});

}  // namespace seaway::analysis
