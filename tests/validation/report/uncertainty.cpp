#include "tests/validation/report/uncertainty.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/error.hpp"

namespace seaway::validation {
namespace {

constexpr double good_order_from = 0.5, good_order_to = 2.1;  // eca2014
constexpr double range_factor = 3;                           // for values that do not converge

/// f0 + sum of c_j h^(p_j): least squares with weights that add up to 1.
struct Fit {
  double f0 = 0, deviation = std::numeric_limits<double>::infinity(), order = 0;
  double at_finest = 0;
  double error(const GridSeries&) const { return std::abs(at_finest - f0); }
};

Fit fit_powers(const GridSeries& s, const std::vector<double>& powers, bool weighted, int unknowns) {
  const auto n = static_cast<Eigen::Index>(s.h.size());
  const auto m = static_cast<Eigen::Index>(powers.size());
  Eigen::VectorXd w(n), f(n);
  Eigen::MatrixXd a(n, m + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    w[i] = weighted ? 1 / s.h[at] : 1.0;
    f[i] = s.value[at];
    a(i, 0) = 1;
    for (Eigen::Index j = 0; j < m; ++j) a(i, j + 1) = std::pow(s.h[at] / s.h[0], powers[static_cast<std::size_t>(j)]);
  }
  w /= w.sum();
  const Eigen::VectorXd root = w.cwiseSqrt();
  const Eigen::VectorXd c = (root.asDiagonal() * a).colPivHouseholderQr().solve(root.cwiseProduct(f));
  const Eigen::VectorXd fitted = a * c;
  Fit out;
  out.f0 = c[0];
  out.at_finest = fitted[0];
  out.order = powers[0];
  const double squares = (w.array() * (f - fitted).array().square()).sum();
  const auto freedom = static_cast<double>(n - unknowns);
  out.deviation = std::sqrt(static_cast<double>(n) * squares / std::max(freedom, 1.0));
  return out;
}

/// The order that fits best: a coarse search, then the golden section.
Fit fit_order(const GridSeries& s, bool weighted) {
  const auto at = [&](double p) { return fit_powers(s, {p}, weighted, 3); };
  double best = 0.05;
  for (double p = 0.05; p <= 8; p += 0.05)
    if (at(p).deviation < at(best).deviation) best = p;
  double low = std::max(best - 0.05, 0.01), high = best + 0.05;
  const double ratio = 0.5 * (std::sqrt(5.0) - 1);
  while (high - low > 1e-9) {
    const double left = high - ratio * (high - low), right = low + ratio * (high - low);
    (at(left).deviation < at(right).deviation ? high : low) = at(left).deviation < at(right).deviation ? right : left;
  }
  return at(0.5 * (low + high));
}

Fit better(const Fit& a, const Fit& b) { return b.deviation < a.deviation ? b : a; }

double range_of(const std::vector<double>& v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return *high - *low;
}

NumericalUncertainty by_least_squares(const GridSeries& s) {
  const Fit power = better(fit_order(s, false), fit_order(s, true));
  Fit used = power;
  std::string terms = "one power";
  if (!(power.order >= good_order_from && power.order <= 2)) {
    used = Fit{};
    for (const bool weighted : {false, true}) {
      used = better(used, fit_powers(s, {1}, weighted, 2));
      used = better(used, fit_powers(s, {2}, weighted, 2));
      if (power.order < good_order_from) used = better(used, fit_powers(s, {1, 2}, weighted, 3));
    }
    terms = "fixed powers";
  }
  const double data_range = range_of(s.value) / static_cast<double>(s.h.size() - 1);
  const bool reliable = power.order >= good_order_from && power.order < good_order_to && used.deviation < data_range;
  const double factor = reliable ? 1.25 : 3.0;
  const double misfit = std::abs(s.value[0] - used.at_finest);
  NumericalUncertainty out;
  out.method = fmt::format("least squares on {} meshes, {}, factor of safety {}", s.h.size(), terms, factor);
  out.order = power.order;
  out.extrapolated = used.f0;
  out.fit_deviation = used.deviation;
  out.converging = reliable;
  out.expanded = used.deviation < data_range || data_range == 0
                     ? factor * used.error(s) + used.deviation + misfit
                     : 3 * used.deviation / data_range * (used.error(s) + used.deviation + misfit);
  return out;
}

/// Factor of safety for the ratio of observed to formal order [xing2010].
double factor_of_safety(double ratio) { return ratio <= 1 ? 2.45 - 0.85 * ratio : 16.4 * ratio - 14.8; }

NumericalUncertainty by_range(const GridSeries& s, const std::string& why) {
  NumericalUncertainty out;
  out.method = fmt::format("{}: three times the range of the values", why);
  out.expanded = range_factor * range_of(s.value);
  return out;
}

NumericalUncertainty by_three(const GridSeries& s) {
  const auto p = order_of_three(s.h.data(), s.value.data());
  if (!p) {
    const double d21 = s.value[1] - s.value[0], d32 = s.value[2] - s.value[1];
    return by_range(s, d21 * d32 < 0 ? "oscillating" : "not converging");
  }
  const double error = (s.value[0] - s.value[1]) / (std::pow(s.h[1] / s.h[0], *p) - 1);
  const double factor = factor_of_safety(*p / s.formal_order);
  NumericalUncertainty out;
  out.method = fmt::format("Richardson on 3 meshes, factor of safety {:.3g}", factor);
  out.order = p;
  out.extrapolated = s.value[0] + error;
  out.expanded = factor * std::abs(error);
  out.converging = true;
  return out;
}

NumericalUncertainty by_two(const GridSeries& s) {
  const double error = (s.value[0] - s.value[1]) / (std::pow(s.h[1] / s.h[0], s.formal_order) - 1);
  NumericalUncertainty out;
  out.method = fmt::format("grid convergence index on 2 meshes with the formal order {:.3g}, factor of safety 3", s.formal_order);
  out.extrapolated = s.value[0] + error;
  out.expanded = 3 * std::abs(error);
  return out;
}

/// Finest mesh first.
void sort(GridSeries& s) {
  std::vector<std::size_t> order(s.h.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return s.h[a] < s.h[b]; });
  const GridSeries old = s;
  for (std::size_t i = 0; i < order.size(); ++i) {
    s.h[i] = old.h[order[i]];
    s.value[i] = old.value[order[i]];
  }
}

}  // namespace

std::optional<double> order_of_three(const double h[3], const double f[3]) {
  const double d21 = f[1] - f[0], d32 = f[2] - f[1];
  if (!(d21 * d32 > 0)) return std::nullopt;
  const double r21 = h[1] / h[0], r32 = h[2] / h[1];
  // g(p) = d32 / d21 (r21^p - 1) - r21^p (r32^p - 1) has its one root p > 0 where the differences fall as h^p.
  const auto residual = [&](double p) {
    return d32 / d21 * (std::pow(r21, p) - 1) - std::pow(r21, p) * (std::pow(r32, p) - 1);
  };
  double low = 1e-6, high = 1;
  if (!(residual(low) > 0)) return std::nullopt;  // the differences grow
  while (residual(high) > 0 && high < 64) high *= 2;
  if (high >= 64) return std::nullopt;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    (residual(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::optional<NumericalUncertainty> numerical_uncertainty(GridSeries s) {
  SEAWAY_CHECK(s.h.size() == s.value.size(), "{} cell sizes for {} values", s.h.size(), s.value.size());
  for (std::size_t i = 0; i < s.h.size(); ++i)
    SEAWAY_CHECK(s.h[i] > 0 && std::isfinite(s.h[i]) && std::isfinite(s.value[i]), "cells of {} with the value {}", s.h[i],
                 s.value[i]);
  if (s.h.size() < 2) return std::nullopt;
  sort(s);
  for (std::size_t i = 1; i < s.h.size(); ++i) SEAWAY_CHECK(s.h[i] > s.h[i - 1], "two meshes have cells of {}", s.h[i]);
  if (s.h.size() == 2) return by_two(s);
  return s.h.size() == 3 ? by_three(s) : by_least_squares(s);
}

bool Comparison::significant() const { return std::abs(error) > 2 * u_val; }

Comparison compare(double computed, double measured, double expanded_numerical, double u_input, double u_data) {
  Comparison c;
  c.error = computed - measured;
  c.u_num = 0.5 * expanded_numerical;  // 95 % interval: two standard uncertainties
  c.u_input = u_input;
  c.u_data = u_data;
  c.u_val = std::sqrt(c.u_num * c.u_num + u_input * u_input + u_data * u_data);
  return c;
}

}  // namespace seaway::validation
