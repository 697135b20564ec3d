#include "core/hull/surface_hull.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/hull/surface_shapes.hpp"

namespace seaway::hull {
namespace {

double box_distance(const Vec3& x, const Vec3& half) {
  const Vec3 q = x.cwiseAbs() - half;
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

TEST(DistanceGrid, BoxIsExactAtNodesAndNearFlatWalls) {
  const SurfaceTree tree(box_surface(0.6, 0.4, 0.3));
  const DistanceGrid grid(tree, 0.02, 0.1);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x(0.39 * any(random), 0.29 * any(random), 0.15 + 0.24 * any(random));
    const double exact = box_distance(x - Vec3(0, 0, 0.15), {0.3, 0.2, 0.15});
    if (std::abs(exact) < 0.08) worst = std::max(worst, std::abs(grid.value(x) - exact));
  }
  EXPECT_LT(worst, grid.error_bound());
  EXPECT_NEAR(grid.value({0.313, 0.01, 0.14}), 0.013, 1e-7);
  EXPECT_NEAR(grid.value({0.293, 0.01, 0.14}), -0.007, 1e-7);
  EXPECT_NEAR((grid.gradient({0.313, 0.01, 0.14}) - Vec3(1, 0, 0)).norm(), 0, 1e-5);
  EXPECT_GT(grid.value({5, 0, 0}), 4.6);
  EXPECT_NEAR((grid.gradient({5, 0, 0.1}) - Vec3(1, 0, 0)).norm(), 0, 1e-12);
}

TEST(DistanceGrid, FarNodesHoldALowerBoundAboveTheMargin) {
  const SurfaceTree tree(sphere_surface(0.5, 24));
  const DistanceGrid grid(tree, 0.02, 0.06);
  for (double r = 0; r < 0.8; r += 0.01) {
    const double d = grid.value({0.3 * r, r * 0.9539392, 0.5});
    const double exact = r * std::hypot(0.3, 0.9539392) - 0.5;
    if (std::abs(exact) < 0.055) {
      EXPECT_NEAR(d, exact, 0.01) << r;
    } else {
      EXPECT_GE(std::abs(d), 0.05) << r;
      EXPECT_LE(std::abs(d), std::abs(exact) + 0.02) << r;
    }
    EXPECT_EQ(d > 0, exact > 0) << r;
  }
}

TEST(DistanceGrid, RefusesTablesThatAreTooLarge) {
  const SurfaceTree tree(box_surface(3, 0.4, 0.3));
  EXPECT_THROW(DistanceGrid(tree, 0.0005, 0.1), Error);
  EXPECT_THROW(DistanceGrid(tree, -1, 0.1), Error);
  EXPECT_THROW(DistanceGrid(tree, 0.1, 0), Error);
  const double finest = DistanceGrid::finest_spacing(bounds_of(tree.surface()), 0.1);
  EXPECT_GT(finest, 0.002);
  EXPECT_LT(finest, 0.005);
}

TEST(SurfaceHull, AgreesWithItsSurface) {
  const SurfaceHull hull(cylinder_surface(1, 0.2, 96), 0.01, 0.1);
  EXPECT_EQ(hull.n_compartments(), 0);
  EXPECT_EQ(hull.compartment_at({0, 0, 0.2}), -1);
  EXPECT_NEAR(hull.bounds().upper.x(), 0.5, 1e-12);
  EXPECT_NEAR(hull.signed_distance({0, 0.25, 0.2}), 0.05, 1e-3);
  const Eigen::Matrix3d axes =
      Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const OrientedBox<3> cv{{0.1, 0.2, 0.2}, Vec3::Constant(0.01), axes};
  OrientedBox<3> block = cv;
  block.half *= 4;
  const auto patch = hull.patch(block);
  const double volume = patch->solid_part(cv).volume;
  EXPECT_GT(volume, 0.3 * 8e-6);
  EXPECT_LT(volume, 0.6 * 8e-6);
  OrientedBox<3> deep = cv;
  deep.centre = {0.09, 0.17, 0.19};
  EXPECT_NEAR(patch->solid_part(deep).volume, 8e-6, 1e-18);
}

TEST(SurfaceHull, RefusesAnOpenSurface) {
  Surface s = box_surface(1, 1, 1);
  s.triangles.pop_back();
  EXPECT_THROW(SurfaceHull(s, 0.1, 0.1), Error);
}

}  // namespace
}  // namespace seaway::hull
