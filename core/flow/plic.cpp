#include "core/flow/plic.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::flow {
namespace {

/// Volume below the plane for sorted positive m with sum 1 and 0 <= a <= 1/2.
double lower_half(const std::array<double, 2>& m, double a) {
  if (a <= m[0]) return m[0] > 0 ? a * a / (2 * m[0] * m[1]) : 0.0;
  return (a - 0.5 * m[0]) / m[1];
}

double lower_half(const std::array<double, 3>& m, double a) {
  const double m12 = m[0] + m[1];
  if (a >= m12 && m12 <= m[2]) return (2 * a - m12) / (2 * m[2]);
  const double volume6 = 6 * m[0] * m[1] * m[2];
  if (a < m[0]) return a * a * a / volume6;
  if (a < m[1]) {
    const double corner = m[0] * m[0] / std::max(6 * m[1] * m[2], 1e-300);
    return a * (a - m[0]) / (2 * m[1] * m[2]) + corner;
  }
  // A vanishing smallest component makes the cubic form cancel: use the limit m0 -> 0.
  if (m[0] < 1e-7) return (a - 0.5 * m[1] - 0.5 * m[0]) / m[2];
  double sum = a * a * (3 * m12 - a) + m[0] * m[0] * (m[0] - 3 * a) + m[1] * m[1] * (m[1] - 3 * a);
  if (a > m[2]) sum = a * a * (3 - 2 * a) + m[0] * m[0] * (m[0] - 3 * a) + m[1] * m[1] * (m[1] - 3 * a) +
                      m[2] * m[2] * (m[2] - 3 * a);
  return sum / volume6;
}

/// a with lower_half(m, a) = v for 0 <= v <= 1/2.
double inverse_lower_half(const std::array<double, 2>& m, double v) {
  const double triangle = m[0] / (2 * m[1]);
  if (v <= triangle) return std::sqrt(2 * v * m[0] * m[1]);
  return v * m[1] + 0.5 * m[0];
}

double inverse_lower_half(const std::array<double, 3>& m, double v) {
  double low = 0, high = 0.5;
  double a = 0.5;
  // The volume grows monotonically: Newton with a secant slope, kept inside a shrinking bracket.
  for (int i = 0; i < 60; ++i) {
    const double f = lower_half(m, a) - v;
    if (std::abs(f) < 1e-15) break;
    (f > 0 ? high : low) = a;
    const double step = std::max(1e-7 * a, 1e-12);
    const double slope = (lower_half(m, std::min(a + step, 0.5)) - lower_half(m, std::max(a - step, 0.0))) /
                         (std::min(a + step, 0.5) - std::max(a - step, 0.0));
    double next = slope > 0 ? a - f / slope : 0.5 * (low + high);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - a) < 1e-16) break;
    a = next;
  }
  return a;
}

template <std::size_t Dim>
struct Sorted {
  std::array<double, Dim> m;  ///< |normal| / sum, ascending
  double sum;
  double negative;  ///< sum of the negative components
};

template <std::size_t Dim>
Sorted<Dim> sorted(const std::array<double, Dim>& normal) {
  Sorted<Dim> s{{}, 0, 0};
  for (std::size_t a = 0; a < Dim; ++a) {
    s.m[a] = std::abs(normal[a]);
    s.sum += s.m[a];
    if (normal[a] < 0) s.negative += normal[a];
  }
  if (s.sum > 0) {
    for (double& x : s.m) x /= s.sum;
  }
  if constexpr (Dim == 2) {
    if (s.m[0] > s.m[1]) std::swap(s.m[0], s.m[1]);
  } else {
    std::sort(s.m.begin(), s.m.end());
  }
  return s;
}

}  // namespace

template <int Dim>
double plane_fraction(const std::array<double, Dim>& normal, double d) {
  const auto s = sorted(normal);
  if (!(s.sum > 0)) return d >= 0 ? 1.0 : 0.0;
  const double a = (d - s.negative) / s.sum;
  if (a <= 0) return 0;
  if (a >= 1) return 1;
  return a <= 0.5 ? lower_half(s.m, a) : 1 - lower_half(s.m, 1 - a);
}

template <int Dim>
double plane_constant(const std::array<double, Dim>& normal, double vof) {
  const auto s = sorted(normal);
  const double v = std::clamp(vof, 0.0, 1.0);
  const double a = v <= 0.5 ? inverse_lower_half(s.m, v) : 1 - inverse_lower_half(s.m, 1 - v);
  return a * s.sum + s.negative;
}

template <int Dim>
std::array<double, Dim> interface_normal(const double* stencil) {
  constexpr int entries = Dim == 2 ? 9 : 27;
  constexpr std::array<int, 3> power{1, 3, 9};
  // Youngs: central differences smoothed by weights 1-2-1 across.
  std::array<double, Dim> youngs{};
  // Centred columns: for each axis d, heights of 3-cell columns along d; slope across axis a from the two
  // columns beside the middle one.
  std::array<std::array<double, Dim>, Dim> columns{};
  for (int e = 0; e < entries; ++e) {
    std::array<int, 3> at{};
    double weight = 1;
    for (int a = 0; a < Dim; ++a) {
      at[static_cast<std::size_t>(a)] = e / power[static_cast<std::size_t>(a)] % 3 - 1;
      if (at[static_cast<std::size_t>(a)] == 0) weight *= 2;
    }
    const double c = stencil[e];
    for (std::size_t a = 0; a < Dim; ++a) {
      if (at[a] == 0) continue;
      youngs[a] -= at[a] * weight * c;
      for (std::size_t d = 0; d < Dim; ++d) {
        if (d == a) continue;
        // The column along d beside the middle one in direction a.
        bool in_column = true;
        for (std::size_t other = 0; other < Dim; ++other)
          in_column = in_column && (other == a || other == d || at[other] == 0);
        if (in_column) columns[d][a] -= 0.5 * at[a] * c;
      }
    }
  }
  const auto normalise = [](std::array<double, Dim>& n) {
    double sum = 0;
    for (const double x : n) sum += std::abs(x);
    if (!(sum > 1e-12)) return false;
    for (double& x : n) x /= sum;
    return true;
  };
  if (!normalise(youngs)) {
    std::array<double, Dim> up{};
    up[Dim - 1] = 1;
    return up;
  }
  std::size_t best = 0;
  double largest = -1;
  for (std::size_t d = 0; d < Dim; ++d) {
    columns[d][d] = youngs[d] >= 0 ? 1 : -1;
    normalise(columns[d]);
    if (std::abs(columns[d][d]) > largest) largest = std::abs(columns[d][d]), best = d;
  }
  return std::abs(youngs[best]) < largest ? youngs : columns[best];
}

template double plane_fraction<2>(const std::array<double, 2>&, double);
template double plane_fraction<3>(const std::array<double, 3>&, double);
template double plane_constant<2>(const std::array<double, 2>&, double);
template double plane_constant<3>(const std::array<double, 3>&, double);
template std::array<double, 2> interface_normal<2>(const double*);
template std::array<double, 3> interface_normal<3>(const double*);

}  // namespace seaway::flow
