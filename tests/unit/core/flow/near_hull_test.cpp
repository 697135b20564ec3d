// Which boxes come near a hull: not their circumscribed spheres count.
#include "core/flow/near_hull.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/flow/barges.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

// The barge of 0.3 x 0.1 m afloat upright reaches from y = -0.15 to 0.15 m and from z = -0.05 to 0.05 m.
TEST(NearHull, LongBoxBesideTheHullIsNotNear) {
  const BargeTank tank;
  const auto pose = BargeTank::afloat(0, 0, 0);
  const auto near = [&](const Vec2& lower, const Vec2& upper, double slack) {
    return comes_near<2>(*tank.hull, tank.body, pose, lower, upper, slack);
  };
  // 0.4 m long, its middle 0.12 m below the bottom: the sphere about it (0.2 m) holds the hull, the box does not.
  EXPECT_FALSE(near({-0.2, -0.19}, {0.2, -0.15}, 0.02));
  EXPECT_TRUE(near({-0.2, -0.19}, {0.2, -0.15}, 0.10));
  EXPECT_TRUE(near({-0.2, -0.08}, {0.2, -0.04}, 0.0));  // cuts the bottom
}

// Halving finds no less: what touches the hull anywhere is near, whatever the depth.
TEST(NearHull, NoBoxThatTouchesIsMissed) {
  const BargeTank tank;
  const auto pose = BargeTank::afloat(20 * degree);
  int touching = 0;
  for (double y = -0.3; y < 0.3; y += 0.031) {
    for (double z = -0.2; z < 0.2; z += 0.029) {
      const Vec2 lower(y, z), upper(y + 0.04, z + 0.04);
      bool touches = false;
      for (int k = 0; k < 81; ++k) {
        const Vec2 x(y + 0.005 * (k % 9), z + 0.005 * (k / 9));
        touches = touches || tank.hull->signed_distance(motion::earth_to_hull<2>(tank.body, pose, x)) < 0;
      }
      touching += touches;
      if (!touches) continue;
      for (const int depth : {0, 2, 4}) EXPECT_TRUE(comes_near<2>(*tank.hull, tank.body, pose, lower, upper, 0, depth));
    }
  }
  EXPECT_GT(touching, 30);
}

}  // namespace
}  // namespace seaway::flow
