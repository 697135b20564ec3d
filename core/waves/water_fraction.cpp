#include "core/waves/water_fraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace seaway::waves {
namespace {

double cube_plus(double v) { return v > 0 ? v * v * v : 0; }
double square_plus(double v) { return v > 0 ? v * v : 0; }

/// Mean of clamp(eta - bottom, 0, dz) / dz for the plane eta = mid + p x + q y on the unit square.
double filled(double mid, double p, double q, double bottom, double dz) {
  return (mean_positive_part(mid - bottom, p, q) - mean_positive_part(mid - bottom - dz, p, q)) /
         dz;
}

/// The box's horizontal edges: one in 2-D (y), two in 3-D (x, y).
template <int Dim>
struct Footprint {
  Vec3 lower, size;
  explicit Footprint(const Vec<Dim>& lo, const Vec<Dim>& hi)
      : lower(to_vec3<Dim>(lo)), size(to_vec3<Dim>(hi) - lower) {}
};

double sum_2d(const WaveField& wave, const Footprint<2>& box, double t, int n) {
  const double dy = box.size.y() / n;
  double left = wave.elevation(0, box.lower.y(), t), sum = 0;
  for (int i = 0; i < n; ++i) {
    const double y = box.lower.y() + i * dy;
    const double mid = wave.elevation(0, y + dy / 2, t), right = wave.elevation(0, y + dy, t);
    sum += filled((left + 4 * mid + right) / 6, right - left, 0, box.lower.z(), box.size.z());
    left = right;
  }
  return sum / n;
}

double sum_3d(const WaveField& wave, const Footprint<3>& box, double t, int n) {
  constexpr int max_n = 8;
  std::array<double, (2 * max_n + 1) * (2 * max_n + 1)> points;
  const int m = 2 * n + 1;
  wave.elevation_grid({box.lower.x(), box.lower.y(), box.size.x() / (2 * n), box.size.y() / (2 * n), m, m}, t,
                      std::span(points).first(static_cast<std::size_t>(m * m)));
  std::array<const double*, 2 * max_n + 1> eta{};
  for (int j = 0; j < m; ++j) eta[static_cast<std::size_t>(j)] = points.data() + j * m;
  double sum = 0;
  for (int j = 0; j < 2 * n; j += 2) {
    for (int i = 0; i < 2 * n; i += 2) {
      const double corners = eta[j][i] + eta[j][i + 2] + eta[j + 2][i] + eta[j + 2][i + 2];
      const double edges = eta[j][i + 1] + eta[j + 2][i + 1] + eta[j + 1][i] + eta[j + 1][i + 2];
      const double mean = (corners + 4 * edges + 16 * eta[j + 1][i + 1]) / 36;  // Simpson
      const double p = eta[j + 1][i + 2] - eta[j + 1][i], q = eta[j + 2][i + 1] - eta[j][i + 1];
      sum += filled(mean, p, q, box.lower.z(), box.size.z());
    }
  }
  return sum / (n * n);
}

}  // namespace

double mean_positive_part(double a, double p, double q) {
  p = std::abs(p);
  q = std::abs(q);
  if (p < q) std::swap(p, q);
  if (a >= (p + q) / 2) return a;
  if (a <= -(p + q) / 2) return 0;
  // Below this ratio the exact formula loses digits and the one without q is good to q^2 / p.
  if (q < 1e-5 * p) return (square_plus(a + p / 2) - square_plus(a - p / 2)) / (2 * p);
  return (cube_plus(a + (p + q) / 2) - cube_plus(a + (p - q) / 2) - cube_plus(a - (p - q) / 2) +
          cube_plus(a - (p + q) / 2)) /
         (6 * p * q);
}

template <int Dim>
double water_fraction(const WaveField& wave, const Vec<Dim>& lower, const Vec<Dim>& upper,
                      double t) {
  const Footprint<Dim> box(lower, upper);
  const double bottom = box.lower.z(), top = bottom + box.size.z();
  if (top <= wave.trough()) return 1;
  if (bottom >= wave.crest()) return 0;
  const double reach = 0.5 * wave.max_slope() * std::hypot(box.size.x(), box.size.y());
  const double mid =
      wave.elevation(box.lower.x() + box.size.x() / 2, box.lower.y() + box.size.y() / 2, t);
  if (mid - reach >= top) return 1;
  if (mid + reach <= bottom) return 0;
  const bool through_sides_only = mid - reach >= bottom && mid + reach <= top;
  double fraction;
  if constexpr (Dim == 2) {
    fraction = sum_2d(wave, box, t, through_sides_only ? 4 : 16);
  } else {
    fraction = sum_3d(wave, box, t, through_sides_only ? 4 : 8);
  }
  return std::clamp(fraction, 0.0, 1.0);
}

template double water_fraction<2>(const WaveField&, const Vec2&, const Vec2&, double);
template double water_fraction<3>(const WaveField&, const Vec3&, const Vec3&, double);

}  // namespace seaway::waves
