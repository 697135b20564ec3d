// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/analysis/local_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

namespace seaway::analysis {
namespace {

struct Samples {
  std::size_t first = 0, count = 0;
};

Samples samples_within(const Signal& s, double from, double until) {
  const auto first = std::lower_bound(s.t.begin(), s.t.end(), from) - s.t.begin();
  const auto last = std::upper_bound(s.t.begin(), s.t.end(), until) - s.t.begin();
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(std::max<std::ptrdiff_t>(last - first, 0))};
}

/// Coefficients of the given powers of (t - centre) / reach.
Eigen::VectorXd fit_powers(const Signal& s, const Samples& in, double centre, double reach,
                           std::initializer_list<int> powers) {
  const auto rows = static_cast<Eigen::Index>(in.count);
  Eigen::MatrixXd matrix(rows, static_cast<Eigen::Index>(powers.size()));
  Eigen::VectorXd right(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const std::size_t at = in.first + static_cast<std::size_t>(i);
    const double tau = (s.t[at] - centre) / reach;
    Eigen::Index column = 0;
    for (const int power : powers) matrix(i, column++) = std::pow(tau, power);
    right[i] = s.x[at];
  }
  return matrix.colPivHouseholderQr().solve(right);
}

}  // namespace

double find_crossing(const Signal& s, double level, double guess, double reach) {
  const Samples in = samples_within(s, guess - reach, guess + reach);
  if (in.count < 6) return guess;
  const Eigen::VectorXd c = fit_powers(s, in, guess, reach, {0, 1, 2, 3});
  double tau = 0;
  for (int i = 0; i < 20; ++i) {
    const double value = c[0] - level + tau * (c[1] + tau * (c[2] + tau * c[3]));
    const double slope = c[1] + tau * (2 * c[2] + tau * 3 * c[3]);
    if (slope == 0) return guess;
    tau = std::clamp(tau - value / slope, -1.0, 1.0);
  }
  return guess + tau * reach;
}

TurningPoint find_turning_point(const Signal& s, double level, double guess, double reach) {
  const Samples in = samples_within(s, guess - reach, guess + reach);
  if (in.count < 8) {
    const Samples wide = samples_within(s, guess - 2 * reach, guess + 2 * reach);
    TurningPoint best{guess, level};
    for (std::size_t i = wide.first; i < wide.first + wide.count; ++i)
      if (std::abs(s.x[i] - level) > std::abs(best.value - level)) best = {s.t[i], s.x[i]};
    return best;
  }
  const Eigen::VectorXd c = fit_powers(s, in, guess, reach, {0, 1, 2, 3, 4});
  double tau = 0;
  for (int i = 0; i < 20; ++i) {
    const double slope = c[1] + tau * (2 * c[2] + tau * (3 * c[3] + tau * 4 * c[4]));
    const double curvature = 2 * c[2] + tau * (6 * c[3] + tau * 12 * c[4]);
    if (curvature == 0) break;
    tau = std::clamp(tau - slope / curvature, -1.0, 1.0);
  }
  return {guess + tau * reach, c[0] + tau * (c[1] + tau * (c[2] + tau * (c[3] + tau * c[4])))};
}

double value_at_release(const Signal& s, double reach) {
  const Samples in = samples_within(s, s.t.front(), s.t.front() + reach);
  if (in.count < 8) return s.x.front();
  return fit_powers(s, in, s.t.front(), reach, {0, 2, 3, 4})[0];
}

}  // namespace seaway::analysis
