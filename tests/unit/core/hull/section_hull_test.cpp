#include "core/hull/section_hull.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/base/error.hpp"
#include "tests/unit/core/hull/example_section.hpp"

namespace seaway::hull {
namespace {

double distance_to_walls(const Section& section, const Vec2& x) {
  double d2 = 1e300;
  for (const WeightedLoop& loop : section.solid)
    for (std::size_t i = 0; i < loop.points.size(); ++i)
      d2 = std::min(d2, squared_distance_to_edge(x, loop.points[i],
                                                 loop.points[(i + 1) % loop.points.size()]));
  return std::sqrt(d2);
}

bool is_solid(const Section& section, const Vec2& x) {
  std::vector<Polygon> loops;
  for (const WeightedLoop& loop : section.solid) loops.push_back(loop.points);
  return contains(loops, x);
}

TEST(SectionHull, DistanceOfBargeIsExactAtStraightWalls) {
  const SectionHull hull(build_section(barge()), 0.0025);
  EXPECT_NEAR(hull.signed_distance({0.0, -0.0317}), 0.0317, 1e-12);
  EXPECT_NEAR(hull.signed_distance({0.1613, 0.05}), 0.0113, 1e-12);
  EXPECT_NEAR(hull.signed_distance({0.1389, 0.05}), -0.0111, 1e-12);
  EXPECT_NEAR((hull.distance_gradient({0.16, 0.05}) - Vec2(1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((hull.distance_gradient({0.01, 0.11}) - Vec2(0, 1)).norm(), 0, 1e-12);
}

TEST(SectionHull, DistanceBeyondMarginIsLargerThanMargin) {
  const SectionHull hull(build_section(barge()), 0.0025, 0.1);
  EXPECT_GT(hull.signed_distance({2.0, 0.05}), 0.1);
  EXPECT_LT(hull.signed_distance({2.0, 0.05}), 1.85 + 1e-12);
  EXPECT_NEAR(hull.distance_gradient({2.0, 0.05}).x(), 1.0, 1e-12);
}

TEST(SectionHull, DistanceOfExampleIsAccurateAndSigned) {
  const double spacing = 0.0025;
  const SectionHull hull(build_section(damaged_midship()), spacing);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> y(-0.4, 0.4), z(-0.2, 0.5);
  double sum = 0;
  const int n = 4000;
  for (int i = 0; i < n; ++i) {
    const Vec2 x(y(random), z(random));
    const double d = distance_to_walls(hull.section(), x);
    const double want = is_solid(hull.section(), x) ? -d : d;
    const double error = std::abs(hull.signed_distance(x) - want);
    ASSERT_LE(error, 0.71 * spacing) << x.transpose();
    sum += error;
  }
  EXPECT_LT(sum / n, 0.02 * spacing);
}

TEST(SectionHull, LabelsCompartments) {
  const SectionHull hull(build_section(damaged_midship()), 0.0025);
  ASSERT_EQ(hull.n_compartments(), 2);
  EXPECT_EQ(hull.compartment_at({0.14, 0.15}), 0);
  EXPECT_EQ(hull.compartment_at({-0.14, 0.15}), 1);
  EXPECT_EQ(hull.compartment_at({0.0, 0.15}), -1);    // solid middle
  EXPECT_EQ(hull.compartment_at({0.175, 0.08}), -1);  // inside the opening
  EXPECT_EQ(hull.compartment_at({0.5, 0.1}), -1);     // sea
}

TEST(SectionHull, BoundsAreOuterPolygon) {
  const SectionHull hull(build_section(barge()), 0.0025);
  EXPECT_EQ(hull.bounds().lower, Vec2(-0.15, 0.0));
  EXPECT_EQ(hull.bounds().upper, Vec2(0.15, 0.1));
}

TEST(SectionHull, TooFineTableIsRefused) {
  EXPECT_THROW(SectionHull(build_section(barge()), 1e-6), Error);
  EXPECT_THROW(SectionHull(build_section(barge()), 0.0), Error);
}

}  // namespace
}  // namespace seaway::hull
