#include "core/hull/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/hull/surface_shapes.hpp"

namespace seaway::hull {
namespace {

using Kind = SurfaceProblem::Kind;

TEST(Surface, MeasuresOfBox) {
  const Surface s = box_surface(2, 0.4, 0.3);
  EXPECT_TRUE(find_surface_problems(s).empty());
  EXPECT_NEAR(enclosed_volume(s), 0.24, 1e-15);
  EXPECT_NEAR((volume_moment(s) - 0.24 * Vec3(0, 0, 0.15)).norm(), 0, 1e-15);
  EXPECT_NEAR(area_of(s), 2 * (0.8 + 0.6 + 0.12), 1e-15);
}

TEST(Surface, MeasuresFollowTransformation) {
  Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Surface s = transformed(box_surface(2, 0.4, 0.3), 0.5, turn, Vec3(3, -4, 5));
  EXPECT_NEAR(enclosed_volume(s), 0.03, 1e-14);
  const Vec3 centre = turn * Vec3(0, 0, 0.075) + Vec3(3, -4, 5);
  EXPECT_NEAR((volume_moment(s) / 0.03 - centre).norm(), 0, 1e-12);
}

TEST(Surface, RoundShapesHaveTheirStatedVolumes) {
  for (const int n : {8, 31, 96}) {
    const Surface c = cylinder_surface(1.5, 0.2, n);
    EXPECT_TRUE(find_surface_problems(c).empty());
    EXPECT_NEAR(enclosed_volume(c), pi * 0.04 * 1.5, 1e-13);
    EXPECT_NEAR(volume_moment(c).z() / enclosed_volume(c), 0.2, 1e-13);
    const Surface s = sphere_surface(0.3, n);
    EXPECT_TRUE(find_surface_problems(s).empty());
    EXPECT_NEAR(enclosed_volume(s), 4.0 / 3.0 * pi * 0.027, 1e-13);
    EXPECT_NEAR(volume_moment(s).z() / enclosed_volume(s), 0.3, 1e-13);
  }
}

TEST(Surface, RoundedBoxIsThePrismOfItsSection) {
  const Surface s = rounded_box_surface(2, 0.4, 0.3, 0.1);
  EXPECT_TRUE(find_surface_problems(s).empty());
  const double corner = 0.01 - 0.5 * 16 * 0.01 * std::sin(pi / 32);
  EXPECT_NEAR(enclosed_volume(s), 2 * (0.12 - 2 * corner), 1e-9);
}

TEST(Surface, WigleyVolumeConvergesToItsFormula) {
  const double exact = 4.0 / 9.0 * 2 * 0.2 * 0.125 + 2.0 / 3.0 * 2 * 0.2 * 0.1;
  double last = 1;
  for (const int n : {16, 32, 64}) {
    const Surface s = wigley_surface(2, 0.2, 0.125, 0.225, 2 * n, n);
    EXPECT_TRUE(find_surface_problems(s).empty());
    const double error = 1 - enclosed_volume(s) / exact;
    EXPECT_GT(error, 0);
    EXPECT_LT(error, 0.3 * last);
    last = error;
  }
  EXPECT_LT(last, 5e-4);
}

TEST(Surface, ShapesRefuseSizesThatAreNotPositive) {
  EXPECT_THROW(box_surface(0, 1, 1), Error);
  EXPECT_THROW(sphere_surface(std::nan("")), Error);
  EXPECT_THROW(cylinder_surface(1, -1), Error);
  EXPECT_THROW(wigley_surface(1, 0.1, 0.1, 0.05), Error);
}

Kind only_problem(const Surface& s) {
  const auto problems = find_surface_problems(s);
  EXPECT_EQ(problems.size(), 1u);
  return problems.empty() ? Kind::empty : problems[0].kind;
}

TEST(Surface, ProblemsAreFound) {
  const Surface box = box_surface(2, 0.4, 0.3);
  EXPECT_EQ(only_problem({}), Kind::empty);
  Surface s = box;
  s.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(only_problem(s), Kind::not_finite);
  s = box;
  s.triangles[2][1] = 8;
  EXPECT_EQ(only_problem(s), Kind::bad_index);
  s = box;
  s.triangles[2][1] = s.triangles[2][0];
  EXPECT_EQ(only_problem(s), Kind::degenerate);
  s = box;
  s.triangles.pop_back();
  EXPECT_EQ(only_problem(s), Kind::open);
  s = box;
  std::swap(s.triangles[5][0], s.triangles[5][1]);
  EXPECT_EQ(only_problem(s), Kind::orientation);
  EXPECT_EQ(only_problem(flipped(box)), Kind::inverted);
}

TEST(Surface, NeighboursShareTheirEdge) {
  const Surface s = box_surface(2, 0.4, 0.3);
  const auto next = neighbours_of(s);
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (int e = 0; e < 3; ++e) {
      const auto& other = s.triangles[next[t][e]];
      for (const int v : {s.triangles[t][e], s.triangles[t][(e + 1) % 3]})
        EXPECT_NE(std::find(other.begin(), other.end(), v), other.end());
    }
}

}  // namespace
}  // namespace seaway::hull
