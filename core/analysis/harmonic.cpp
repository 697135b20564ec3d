// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/analysis/harmonic.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::analysis {
namespace {

using Normal = Eigen::Matrix<double, 5, 5>;
using Five = Eigen::Matrix<double, 5, 1>;

/// 1, cos, sin, cos 2, sin 2 of omega t, over the samples in [from, until].
Five fit_window(const Signal& s, double omega, double from, double until) {
  const double slack = 1e-9 * (until - from);
  const auto begin = std::lower_bound(s.t.begin(), s.t.end(), from - slack) - s.t.begin();
  const auto end = std::upper_bound(s.t.begin(), s.t.end(), until + slack) - s.t.begin();
  Normal normal = Normal::Zero();
  Five right = Five::Zero();
  for (auto k = begin; k < end; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double before = k > begin ? s.t[i - 1] : s.t[i], after = k + 1 < end ? s.t[i + 1] : s.t[i];
    const double weight = 0.5 * (after - before);
    const double a = omega * s.t[i];
    Five row;
    row << 1, std::cos(a), std::sin(a), std::cos(2 * a), std::sin(2 * a);
    normal += weight * row * row.transpose();
    right += weight * s.x[i] * row;
  }
  return normal.ldlt().solve(right);
}

double phase_of(const Five& c) { return std::atan2(-c[2], c[1]); }
double amplitude_of(const Five& c) { return std::hypot(c[1], c[2]); }

void fill_scatter(const std::vector<Five>& fits, Harmonic& out) {
  const auto n = static_cast<double>(fits.size());
  if (fits.size() < 2) return;
  double sum = 0;
  for (const Five& c : fits) sum += amplitude_of(c);
  const double mean = sum / n;
  double amplitudes = 0, phases = 0, slope = 0, spread = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const double from_mean = amplitude_of(fits[i]) - mean;
    const double turn = wrap(phase_of(fits[i]) - out.phase);
    const double place = static_cast<double>(i) - 0.5 * (n - 1);
    amplitudes += from_mean * from_mean;
    phases += turn * turn;
    slope += place * from_mean;
    spread += place * place;
  }
  out.amplitude_scatter = std::sqrt(amplitudes / (n - 1));
  out.phase_scatter = std::sqrt(phases / (n - 1));
  out.amplitude_trend = slope / spread * (n - 1);
}

}  // namespace

double wrap(double angle) {
  const double turned = std::remainder(angle, 2 * pi);
  return turned <= -pi ? turned + 2 * pi : turned;
}

Harmonic fit_harmonic(const Signal& s, double omega, int periods) {
  const double period = 2 * pi / omega;
  const double length = s.t.empty() ? 0 : s.t.back() - s.t.front();
  Harmonic out;
  out.periods = std::min(periods, static_cast<int>(std::floor(length / period * (1 + 1e-9))));
  if (out.periods < 1)
    fail(ErrorCode::failed_precondition, "the history has {:.3g} s to fit, less than one period of {:.3g} s; run longer", length, period);
  out.until = s.t.back();
  out.from = out.until - out.periods * period;
  const auto count = s.t.end() - std::lower_bound(s.t.begin(), s.t.end(), out.from);
  if (static_cast<double>(count) < 10 * out.periods)
    fail(ErrorCode::failed_precondition, "the history has {:.3g} samples a period; 10 are needed",
         static_cast<double>(count) / out.periods);
  const Five all = fit_window(s, omega, out.from, out.until);
  out.mean = all[0];
  out.amplitude = amplitude_of(all);
  out.phase = phase_of(all);
  out.second = std::hypot(all[3], all[4]);
  std::vector<Five> single;
  for (int i = 0; i < out.periods; ++i)
    single.push_back(fit_window(s, omega, out.from + i * period, out.from + (i + 1) * period));
  fill_scatter(single, out);
  return out;
}

}  // namespace seaway::analysis
