// SPDX-License-Identifier: GPL-3.0-or-later
// What wave gauges say: spectra, and what comes and goes. Pure functions.
#pragma once

#include <complex>
#include <vector>

#include "core/analysis/local_fit.hpp"

namespace seaway::analysis {

/// Frequencies at which a record of this length is looked at: whole multiples of 1 / duration in [lower, upper] [Hz].
std::vector<double> frequencies_of(double duration, double lower, double upper);

/// Complex amplitudes a: the record less its mean is about Re sum a exp(i 2 pi f t). Hann's window, samples weighted with
/// the time around them. With windows amplitudes belong to bins and their neighbours; their energies add up:
/// m0 = sum |a|^2 / 2 / 1.5.
std::vector<std::complex<double>> transform(const Signal& signal, const std::vector<double>& frequencies);

/// 4 standard deviations of the record [its unit].
double significant_height(const Signal& signal);

/// Period of the largest value of |a|^2 smoothed by a Gaussian of this standard deviation [Hz].
double peak_period(const std::vector<double>& frequencies, const std::vector<std::complex<double>>& amplitudes, double width);

/// Mean distance of zero up-crossings of the record less its mean [s]; 0 with fewer than two.
double mean_up_crossing_period(const Signal& signal);

struct Gauge {
  double place = 0;  ///< along the direction that the waves come in [m]
  std::vector<std::complex<double>> amplitudes;
};

/// Waves that come in and go back, by least squares over three or more gauges at each frequency [mansard1980].
struct Separation {
  double incident_height = 0;  ///< 4 sqrt(m0) of what comes in
  double reflection = 0;       ///< sqrt(m0 of what goes back / m0 of what comes in)
};
/// `wave_numbers` of the frequencies [1/m]. Frequencies at which the gauges' distances are near whole half waves are left
/// out.
Separation separate(const std::vector<Gauge>& gauges, const std::vector<double>& wave_numbers);

}  // namespace seaway::analysis
