#include "core/waves/mode_series.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace seaway::waves {
namespace {

constexpr double negligible = 1e-11;  // of the first mode; well below any scheme's error

/// Modes up to the last one that matters.
std::vector<double> significant(std::span<const double> modes, double growth) {
  std::size_t n = modes.size();
  const double first = modes.empty() ? 0.0 : std::abs(modes[0]);
  while (n > 1 && std::abs(modes[n - 1]) * std::exp(growth * static_cast<double>(n - 1)) <
                      negligible * first) {
    --n;
  }
  return {modes.begin(), modes.begin() + static_cast<std::ptrdiff_t>(n)};
}

/// sum_j a_j x^j for j = 1..n (no constant term).
inline double power_sum(const double* a, int n, double x) {
  double sum = 0;
  for (int j = n - 1; j >= 0; --j) sum = (sum + a[j]) * x;
  return sum;
}

}  // namespace

ModeSeries::ModeSeries(double k, double depth, double top, double current,
                       std::span<const double> elevation_modes,
                       std::span<const double> velocity_modes)
    : k_(k),
      depth_(depth),
      top_(top),
      current_(current),
      two_depth_decay_(std::exp(-2 * k * depth)),
      e_(significant(elevation_modes, 0)),
      b_(significant(velocity_modes, k * top)) {
  if (e_.size() > max_modes || b_.size() > max_modes) {
    fail(ErrorCode::internal, "a wave has {} modes; at most {} are supported",
         std::max(e_.size(), b_.size()), max_modes);
  }
  const double x = std::exp(k * top), y = two_depth_decay_ / x;
  for (std::size_t i = 0; i < b_.size(); ++i) {
    const double j = static_cast<double>(i + 1);
    b_[i] /= 1 + std::exp(-2 * j * k * depth);
    cosh_top_.push_back(b_[i] * (std::pow(x, j) + std::pow(y, j)));
    sinh_top_.push_back(b_[i] * (std::pow(x, j) - std::pow(y, j)));
  }
}

double ModeSeries::elevation(double theta) const {
  // Clenshaw's recurrence for a cosine series.
  const double c2 = 2 * std::cos(theta);
  double b1 = 0, b2 = 0;
  for (std::size_t j = e_.size(); j-- > 0;) {
    const double b0 = e_[j] + c2 * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return 0.5 * c2 * b1 - b2;
}

double ModeSeries::elevation_slope(double theta) const {
  double sum = 0;
  for (std::size_t i = 0; i < e_.size(); ++i) {
    const double j = static_cast<double>(i + 1);
    sum -= j * e_[i] * std::sin(j * theta);
  }
  return sum;
}

double ModeSeries::max_slope() const {
  double sum = 0;
  for (std::size_t i = 0; i < e_.size(); ++i) {
    sum += static_cast<double>(i + 1) * k_ * std::abs(e_[i]);
  }
  return sum;
}

ModeSeries::Column ModeSeries::column(double theta) const {
  Column out;
  out.n = static_cast<int>(b_.size());
  out.cos_theta = std::cos(theta);
  out.sin_theta = std::sin(theta);
  double c = out.cos_theta, s = out.sin_theta;
  for (int j = 0; j < out.n; ++j) {
    out.even[j] = b_[j] * c;
    out.odd[j] = b_[j] * s;
    const double next = c * out.cos_theta - s * out.sin_theta;
    s = s * out.cos_theta + c * out.sin_theta;
    c = next;
  }
  return out;
}

// Stream function of mode j above the top, over the one at the top: f = (1 + a s) exp(-j k s) with
// a = j k (1 + C/S), which makes f' at s = 0 the j k C/S of the wave below. u = f'/(jk) S, w = f S.
void ModeSeries::prepare_above(Column& column) const {
  double c = column.cos_theta, s = column.sin_theta;
  for (int i = 0; i < column.n; ++i) {
    const double jk = (i + 1) * k_;
    const double sum = cosh_top_[i] + sinh_top_[i];
    column.above_u0[i] = cosh_top_[i] * c;
    column.above_u1[i] = -jk * sum * c;
    column.above_w0[i] = sinh_top_[i] * s;
    column.above_w1[i] = jk * sum * s;
    const double next = c * column.cos_theta - s * column.sin_theta;
    s = s * column.cos_theta + c * column.sin_theta;
    c = next;
  }
  column.above_ready = true;
}

ModeSeries::Velocity ModeSeries::velocity(Column& column, double z) const {
  if (z > top_) {
    if (!column.above_ready) prepare_above(column);
    const double s = z - top_, x = std::exp(-k_ * s);
    return {current_ + power_sum(column.above_u0.data(), column.n, x) +
                s * power_sum(column.above_u1.data(), column.n, x),
            power_sum(column.above_w0.data(), column.n, x) +
                s * power_sum(column.above_w1.data(), column.n, x)};
  }
  // At the bed x^j and y^j must cancel exactly in w.
  const double above_bed = std::max(z, -depth_);
  const double x = std::exp(k_ * above_bed);
  const double y = z <= -depth_ ? x : two_depth_decay_ / x;
  return {current_ + power_sum(column.even.data(), column.n, x) +
              power_sum(column.even.data(), column.n, y),
          power_sum(column.odd.data(), column.n, x) - power_sum(column.odd.data(), column.n, y)};
}

}  // namespace seaway::waves
