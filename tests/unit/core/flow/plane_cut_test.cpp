#include "core/flow/plane_cut.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace seaway::flow {
namespace {

double polygon_area(const std::vector<std::array<double, 3>>& p) {
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Vec3 o(p[0][0], p[0][1], p[0][2]), a(p[i][0], p[i][1], p[i][2]), b(p[i + 1][0], p[i + 1][1], p[i + 1][2]);
    const Vec3 u = a - o, v = b - o;
    twice += Vec3(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x());
  }
  return 0.5 * twice.norm();
}

TEST(PlaneCut, LevelPlaneGivesTheWholeSquare) {
  const auto p = cut_unit_cell(Plane<3>{{0, 0, 1}, 0.3});
  ASSERT_EQ(p.size(), 4U);
  for (const auto& x : p) EXPECT_DOUBLE_EQ(x[2], 0.3);
  EXPECT_NEAR(polygon_area(p), 1.0, 1e-14);
}

// The area of the cut is d(volume)/d(distance): the derivative of plane_fraction.
TEST(PlaneCut, AreaIsTheDerivativeOfTheVolume) {
  const std::array<double, 3> normals[] = {{0.2, 0.3, 0.5}, {-0.6, 0.1, 0.3}, {1. / 3, -1. / 3, -1. / 3}};
  for (const auto& n : normals) {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (double d = -0.65; d < 1; d += 0.083) {
      const double step = 1e-6;
      const double slope = (plane_fraction<3>(n, d + step) - plane_fraction<3>(n, d - step)) / (2 * step);
      EXPECT_NEAR(polygon_area(cut_unit_cell(Plane<3>{n, d})), slope * length, 1e-5) << d;
    }
  }
}

TEST(PlaneCut, MissedCellsHaveNoPiece) {
  EXPECT_TRUE(cut_unit_cell(Plane<3>{{0.2, 0.3, 0.5}, 1.01}).empty());
  EXPECT_TRUE(cut_unit_cell(Plane<2>{{0.5, 0.5}, -0.01}).empty());
}

TEST(PlaneCut, SectionOfAPlaneLiesOnIt) {
  const Plane<3> plane{{0.2, -0.3, 0.5}, 0.2};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const auto& p : cut_unit_cell(section_of(plane, axis, 0.4))) {
      double sum = plane.normal[axis] * 0.4;
      std::size_t k = 0;
      for (std::size_t a = 0; a < 3; ++a)
        if (a != axis) sum += plane.normal[a] * p[k++];
      EXPECT_NEAR(sum, plane.d, 1e-14);
    }
  }
}

}  // namespace
}  // namespace seaway::flow
