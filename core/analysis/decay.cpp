// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/analysis/decay.hpp"

#include <algorithm>
#include <cmath>

#include "core/analysis/half_cycles.hpp"
#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::analysis {
namespace {

/// Of a decrement from a to b over so many half cycles: ln(a/b) = n pi zeta / sqrt(1 - zeta^2).
double damping_from(double a, double b, int half_cycles) {
  const double decrement = std::log(std::abs(a) / std::abs(b)) / half_cycles;
  return decrement / std::hypot(pi, decrement);
}

/// The amplitude after the next half cycle, from loss = a m + b m^2 with m = (p + next) / 2.
double next_amplitude(double p, double a, double b) {
  const double sum = a + 2;
  const double root = std::sqrt(std::max(sum * sum + 8 * b * p, 0.0));
  return 2 * (4 * p / (sum + root)) - p;
}

/// Linear least squares of loss over mean amplitude: where the nonlinear fit begins.
std::pair<double, double> rough_extinction(const std::vector<TurningPoint>& turns, double level) {
  double s22 = 0, s23 = 0, s33 = 0, r2 = 0, r3 = 0;
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const double p = std::abs(turns[i].value - level), q = std::abs(turns[i + 1].value - level);
    const double m = 0.5 * (p + q), loss = p - q;
    s22 += m * m;
    s23 += m * m * m;
    s33 += m * m * m * m;
    r2 += m * loss;
    r3 += m * m * loss;
  }
  const double determinant = s22 * s33 - s23 * s23;
  if (!(determinant > 1e-12 * s22 * s33)) return {r2 / s22, 0};
  return {(r2 * s33 - r3 * s23) / determinant, (s22 * r3 - s23 * r2) / determinant};
}

/// Amplitudes are scaled with the first one, so that all unknowns are of order 1.
Extinction fit_extinction(const std::vector<TurningPoint>& turns, double level) {
  const double scale = std::abs(turns.front().value - level);
  const double first_sign = turns.front().value > level ? 1 : -1;
  const auto [linear, quadratic] = rough_extinction(turns, level);
  Eigen::VectorXd start(4);  // mean - level, first amplitude, both in `scale`; linear; quadratic * scale
  start << 0, 1, linear, quadratic * scale;
  const auto fit = minimise(
      [&](const Eigen::VectorXd& p, Eigen::VectorXd& r) {
        double amplitude = p[1], sign = first_sign;
        for (std::size_t i = 0; i < turns.size(); ++i, sign = -sign) {
          r[static_cast<Eigen::Index>(i)] = (turns[i].value - level) / scale - p[0] - sign * amplitude;
          amplitude = next_amplitude(amplitude, p[2], p[3]);
        }
      },
      static_cast<int>(turns.size()), start);
  const auto scaled = [&](int i, double factor, double shift = 0) {
    Estimate e = fit.estimate(i);
    e.value = shift + factor * e.value;
    if (e.interval >= 0) e.interval *= std::abs(factor);
    return e;
  };
  return {scaled(2, 1), scaled(3, 1 / scale), scaled(0, scale, level),
          scale * std::sqrt(fit.sum_of_squares / static_cast<double>(turns.size()))};
}

DampedCosine fit_damped_cosine(const Signal& s, double level, double period, double damping_ratio) {
  const double start = s.t.front(), scale = std::max(std::abs(s.x.front() - level), 1e-300);
  const double omega = 2 * pi / period;
  Eigen::VectorXd p0(5);  // mean - level and the factors of cosine and sine in `scale`; decay and frequency in `omega`
  p0 << 0, (s.x.front() - level) / scale, 0, damping_ratio, 1;
  const auto fit = minimise(
      [&](const Eigen::VectorXd& p, Eigen::VectorXd& r) {
        for (std::size_t i = 0; i < s.t.size(); ++i) {
          const double tau = omega * (s.t[i] - start);
          const double wave = std::exp(-p[3] * tau) * (p[1] * std::cos(p[4] * tau) + p[2] * std::sin(p[4] * tau));
          r[static_cast<Eigen::Index>(i)] = (s.x[i] - level) / scale - p[0] - wave;
        }
      },
      static_cast<int>(s.t.size()), p0);
  const double correlation = correlation_length(fit.residuals);
  const Eigen::VectorXd& p = fit.parameters;
  const auto estimate = [&](double value, double dm, double dc, double ds, double dd, double df) {
    Eigen::VectorXd gradient(5);
    gradient << dm, dc, ds, dd, df;
    return fit.estimate(value, gradient, correlation);
  };
  const double size = std::hypot(p[1], p[2]), full = std::hypot(p[3], p[4]);
  DampedCosine out;
  out.period = estimate(period / p[4], 0, 0, 0, 0, -period / (p[4] * p[4]));
  const double cubed = full * full * full;
  out.damping_ratio = estimate(p[3] / full, 0, 0, 0, p[4] * p[4] / cubed, -p[3] * p[4] / cubed);
  out.amplitude = estimate(scale * size, 0, scale * p[1] / size, scale * p[2] / size, 0, 0);
  out.mean = estimate(level + scale * p[0], scale, 0, 0, 0, 0);
  out.phase = std::atan2(-p[2], p[1]);
  out.start = start;
  out.residual = scale * std::sqrt(fit.sum_of_squares / static_cast<double>(s.t.size()));
  return out;
}

void fill_peaks(const HalfCycles& half, double level, Decay& out) {
  const auto& turns = half.turns;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    DecayPeak peak;
    peak.time = turns[i].time;
    peak.angle = turns[i].value - level;
    if (!(half.from_release && i == 0)) peak.period = 2 * (half.after(i) - half.before(i));
    if (i + 1 < turns.size()) {
      const double p = std::abs(peak.angle), q = std::abs(turns[i + 1].value - level);
      peak.loss = p - q;
      peak.mean = 0.5 * (p + q);
      peak.damping_ratio = damping_from(p, q, 1);
    }
    out.peaks.push_back(peak);
  }
  for (std::size_t i = 0; i + 2 < turns.size(); i += 2) {
    if (half.from_release && i + 2 >= half.crossings.size()) break;
    const double period = half.after(i + 2) - half.after(i);
    out.cycles.push_back({static_cast<int>(i / 2) + 1, out.peaks[i].angle, period,
                          damping_from(out.peaks[i].angle, out.peaks[i + 2].angle, 2)});
  }
}

Estimate mean_of(const std::vector<DecayCycle>& cycles) {
  const auto n = static_cast<double>(cycles.size());
  if (cycles.empty()) return {};
  double sum = 0, square = 0;
  for (const auto& c : cycles) sum += c.period;
  for (const auto& c : cycles) square += (c.period - sum / n) * (c.period - sum / n);
  if (cycles.size() < 2) return {sum / n, -1};
  return {sum / n, student_95(n - 1) * std::sqrt(square / (n - 1) / n)};
}

}  // namespace

std::size_t begin_of_motion(const Signal& s) {
  double largest = 0;
  for (const double x : s.x) largest = std::max(largest, std::abs(x));
  std::size_t i = 0;
  while (i + 1 < s.x.size() && std::abs(s.x[i + 1] - s.x.front()) <= 1e-9 * largest) ++i;
  return i + 1 < s.x.size() ? i : 0;
}

Decay analyse_decay(const Signal& signal, const DecayOptions& options) {
  if (!std::all_of(signal.x.begin(), signal.x.end(), [](double x) { return std::isfinite(x); }))
    fail(ErrorCode::failed_precondition, "the history holds values that are not finite; choose another part of it");
  double level = 0;
  HalfCycles half;
  std::optional<Extinction> extinction;
  DampedCosine cosine;
  for (int pass = 0; pass < 6; ++pass) {  // crossings and turning points about the mean, which they tell
    half = find_half_cycles(signal, level, options.smallest_peak);
    if (half.turns.size() < 2 || half.crossings.size() < 2)
      fail(ErrorCode::failed_precondition,
           "the history shows {} turning points beyond the threshold; a decay needs two half cycles at least", half.turns.size());
    const auto first = std::lower_bound(signal.t.begin(), signal.t.end(), half.turns.front().time - 1e-12) - signal.t.begin();
    const auto last = std::upper_bound(signal.t.begin(), signal.t.end(), half.crossings.back()) - signal.t.begin();
    const Signal used{signal.t.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first)),
                      signal.x.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first))};
    const double period = 2 * (half.crossings.back() - half.crossings.front()) / static_cast<double>(half.crossings.size() - 1);
    const double damping = damping_from(half.turns.front().value - level, half.turns.back().value - level,
                                        static_cast<int>(half.turns.size()) - 1);
    cosine = fit_damped_cosine(used, level, period, damping);
    extinction.reset();
    if (half.turns.size() >= 5) extinction = fit_extinction(half.turns, level);
    const double next = extinction ? extinction->mean.value : cosine.mean.value;
    const double change = std::abs(next - level);
    level = next;
    if (change <= 1e-5 * std::abs(half.turns.front().value - level)) break;
  }
  Decay out;
  out.crossings = half.crossings;
  fill_peaks(half, level, out);
  out.mean_period = mean_of(out.cycles);
  out.damped_cosine = cosine;
  out.extinction = extinction;
  return out;
}

}  // namespace seaway::analysis
