#include "tests/validation/support/signal.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "core/base/constants.hpp"

namespace seaway::validation {

std::vector<double> zero_crossings(const Record& r) {
  std::vector<double> out;
  for (std::size_t i = 1; i < r.t.size(); ++i) {
    const double a = r.value[i - 1], b = r.value[i];
    if ((a < 0) != (b < 0)) out.push_back(r.t[i - 1] + (r.t[i] - r.t[i - 1]) * a / (a - b));
  }
  return out;
}

std::vector<TurningPoint> turning_points(const Record& r) {
  std::vector<TurningPoint> out;
  for (std::size_t i = 1; i + 1 < r.t.size(); ++i) {
    const double before = r.value[i] - r.value[i - 1], after = r.value[i + 1] - r.value[i];
    if (before * after >= 0) continue;
    const double h = 0.5 * (r.t[i + 1] - r.t[i - 1]);
    const double gradient = 0.5 * (before + after), curvature = after - before;
    const double at = -gradient / curvature;
    out.push_back({r.t[i] + at * h, r.value[i] + 0.5 * gradient * at});
  }
  return out;
}

double high_frequency_rms(const Record& r, double from, double width, bool parabola) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < r.t.size(); ++i) {
    if (r.t[i] < from + 0.5 * width || r.t[i] > r.t.back() - 0.5 * width) continue;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t j = 0; j < r.t.size(); ++j) {
      const double x = (r.t[j] - r.t[i]) / width;
      if (std::abs(x) > 0.5) continue;
      const Eigen::Vector3d powers(1, x, x * x);
      normal += powers * powers.transpose();
      right += powers * r.value[j];
    }
    const double fit = parabola ? normal.ldlt().solve(right)[0] : right[0] / normal(0, 0);
    sum += std::pow(r.value[i] - fit, 2);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : std::numeric_limits<double>::quiet_NaN();
}

std::complex<double> harmonic(const Record& r, double omega, double from) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < r.t.size(); ++i) {
    if (r.t[i] < from) continue;
    const Eigen::Vector3d base(1, std::cos(omega * r.t[i]), std::sin(omega * r.t[i]));
    normal += base * base.transpose();
    right += base * r.value[i];
  }
  const Eigen::Vector3d a = normal.ldlt().solve(right);
  return {a[1], a[2]};
}

double slope(const Record& r) {
  double n = 0, t = 0, v = 0, tt = 0, tv = 0;
  for (std::size_t i = 0; i < r.t.size(); ++i) {
    ++n;
    t += r.t[i];
    v += r.value[i];
    tt += r.t[i] * r.t[i];
    tv += r.t[i] * r.value[i];
  }
  return (n * tv - t * v) / (n * tt - t * t);
}

void unwrap(std::vector<double>& angle) {
  for (std::size_t i = 1; i < angle.size(); ++i)
    angle[i] -= 2 * pi * std::round((angle[i] - angle[i - 1]) / (2 * pi));
}

double observed_order(double coarse, double medium, double fine) {
  return std::log2(std::abs((coarse - medium) / (medium - fine)));
}

double extrapolate(double medium, double fine, double order) {
  return fine + (fine - medium) / (std::pow(2, order) - 1);
}

}  // namespace seaway::validation
