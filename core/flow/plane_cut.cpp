#include "core/flow/plane_cut.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace seaway::flow {
namespace {

template <std::size_t Dim>
void add_point(std::vector<std::array<double, Dim>>& points, const std::array<double, Dim>& x) {
  for (const auto& p : points) {
    double apart = 0;
    for (std::size_t a = 0; a < Dim; ++a) apart += std::abs(p[a] - x[a]);
    if (apart < 1e-9) return;
  }
  points.push_back(x);
}

/// Where the plane crosses the edges of the unit cube.
template <std::size_t Dim>
std::vector<std::array<double, Dim>> edge_points(const std::array<double, Dim>& normal, double d) {
  std::vector<std::array<double, Dim>> points;
  for (std::size_t along = 0; along < Dim; ++along) {
    if (normal[along] == 0) continue;
    for (unsigned corner = 0; corner < (1U << Dim); ++corner) {
      if (corner >> along & 1U) continue;
      std::array<double, Dim> x;
      double rest = d;
      for (std::size_t a = 0; a < Dim; ++a) {
        x[a] = corner >> a & 1U ? 1 : 0;
        if (a != along) rest -= normal[a] * x[a];
      }
      x[along] = rest / normal[along];
      if (x[along] >= -1e-12 && x[along] <= 1 + 1e-12) add_point<Dim>(points, x);
    }
  }
  return points;
}

}  // namespace

std::vector<std::array<double, 2>> cut_unit_cell(const Plane<2>& plane) {
  auto points = edge_points<2>(plane.normal, plane.d);
  if (points.size() != 2) points.clear();
  return points;
}

std::vector<std::array<double, 3>> cut_unit_cell(const Plane<3>& plane) {
  auto points = edge_points<3>(plane.normal, plane.d);
  if (points.size() < 3) return {};
  const Vec3 n(plane.normal[0], plane.normal[1], plane.normal[2]);
  const Vec3 u = n.unitOrthogonal(), v = n.normalized().cross(u);
  Vec3 middle = Vec3::Zero();
  for (const auto& p : points) middle += Vec3(p[0], p[1], p[2]) / static_cast<double>(points.size());
  const auto angle = [&](const std::array<double, 3>& p) {
    const Vec3 r = Vec3(p[0], p[1], p[2]) - middle;
    return std::atan2(r.dot(v), r.dot(u));
  };
  std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
  return points;
}

}  // namespace seaway::flow
