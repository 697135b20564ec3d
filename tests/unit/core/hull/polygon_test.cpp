#include "core/hull/polygon.hpp"

#include <gtest/gtest.h>

#include "core/hull/boolean.hpp"

namespace seaway::hull {
namespace {

const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(Polygon, AreaAndMomentOfTriangleMatchFormula) {
  const Polygon triangle = {{1, 1}, {4, 1}, {1, 3}};
  EXPECT_NEAR(signed_area(triangle), 3.0, 1e-14);
  EXPECT_NEAR(first_moment(triangle).x(), 3.0 * 2.0, 1e-13);
  EXPECT_NEAR(first_moment(triangle).y(), 3.0 * 5.0 / 3.0, 1e-13);
}

TEST(Polygon, ClockwiseLoopHasNegativeArea) {
  EXPECT_DOUBLE_EQ(signed_area({{0, 0}, {0, 1}, {1, 1}, {1, 0}}), -1.0);
}

TEST(Polygon, KnowsInsideOfConcaveShape) {
  const Polygon u = {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_TRUE(contains(u, Vec2(0.5, 1.5)));
  EXPECT_FALSE(contains(u, Vec2(1.5, 1.5)));
  EXPECT_TRUE(contains(u, Vec2(1.5, 0.5)));
  EXPECT_FALSE(contains(u, Vec2(3.5, 0.5)));
}

TEST(Polygon, ClippingKeepsAreaOfPieces) {
  const Polygon u = {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_NEAR(signed_area(clip_to_box(u, {{-1, 1.5}, {4, 3}})), 1.0, 1e-14);  // two separate tips
  EXPECT_TRUE(clip_to_box(u, {{5, 5}, {6, 6}}).empty());
}

TEST(Polygon, FindsSelfIntersections) {
  EXPECT_FALSE(first_self_intersection(square));
  EXPECT_TRUE(first_self_intersection({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));  // bow tie
  EXPECT_TRUE(first_self_intersection({{0, 0}, {2, 0}, {1, 0}, {1, 1}}));  // runs back
  EXPECT_TRUE(
      first_self_intersection({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}));  // touches an edge
}

TEST(Boolean, ShrinkKeepsCornersSharp) {
  const Polygons inner = shrink(square, 0.1);
  ASSERT_EQ(inner.size(), 1u);
  EXPECT_NEAR(area_of(inner), 0.64, 1e-8);  // rounding to 1e-9 m
  EXPECT_EQ(inner[0].size(), 4u);
  EXPECT_TRUE(shrink(square, 0.6).empty());
}

TEST(Boolean, DifferenceMakesHoleClockwise) {
  const Polygons ring = subtract({square}, {box_polygon({{0.25, 0.25}, {0.75, 0.75}})});
  ASSERT_EQ(ring.size(), 2u);
  EXPECT_NEAR(area_of(ring), 0.75, 1e-12);
  EXPECT_LT(signed_area(ring[0]) * signed_area(ring[1]), 0.0);
}

}  // namespace
}  // namespace seaway::hull
