#include "core/motion/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::motion {
namespace {

constexpr double rounding = 1e-14;

TEST(Pose, SignsFollowTheConventions) {
  const Vec3 zero = Vec3::Zero();
  const Vec3 starboard(0, -1, 0), port(0, 1, 0), bow(1, 0, 0);
  EXPECT_LT(to_earth<3>(make_pose<3>(zero, {0.1, 0, 0}), starboard).z(), 0);  // starboard down
  EXPECT_LT(to_earth<3>(make_pose<3>(zero, {0, 0.1, 0}), bow).z(), 0);        // bow down
  EXPECT_GT(to_earth<3>(make_pose<3>(zero, {0, 0, 0.1}), bow).y(), 0);        // bow to port
  EXPECT_GT(to_earth<2>(make_pose<2>(Vec2::Zero(), {0.1, 0, 0}), Vec2(1, 0)).y(), 0);  // port up
  Twist<3> roll_rate = Twist<3>::Zero();
  roll_rate[dof_index<3>(Dof::roll)] = 0.2;
  EXPECT_GT(velocity_at<3>(roll_rate, Pose<3>{}, port).z(), 0);
}

TEST(Pose, SectionIsTheShipWithRollOnly) {
  const Pose<2> section = make_pose<2>(Vec2(0.3, -0.1), {0.7, 0, 0});
  const Pose<3> ship = make_pose<3>(Vec3(0, 0.3, -0.1), {0.7, 0, 0});
  const Vec2 x(0.4, 0.25);
  EXPECT_LT((to_vec3<2>(to_earth<2>(section, x)) - to_earth<3>(ship, to_vec3<2>(x))).norm(),
            rounding);
  const Twist<2> twist(0.1, -0.2, 0.6);
  Twist<3> ship_twist;
  ship_twist << 0, 0.1, -0.2, 0.6, 0, 0;
  EXPECT_LT((to_vec3<2>(velocity_at<2>(twist, section, x)) -
             velocity_at<3>(ship_twist, ship, to_vec3<2>(x)))
                .norm(),
            rounding);
  const Pose<2> section_after = advance(section, twist, 0.4);
  const Pose<3> ship_after = advance(ship, ship_twist, 0.4);
  EXPECT_NEAR(section_after.roll, angles(ship_after).roll, rounding);
  EXPECT_LT((to_vec3<2>(section_after.cog) - ship_after.cog).norm(), rounding);
  EXPECT_NEAR(moment<2>(section, x, Vec2(3, -2))[0],
              moment<3>(ship, to_vec3<2>(x), Vec3(0, 3, -2)).x(), rounding);
}

TEST(Pose, AnglesRoundTripWithIntrinsicYawPitchRoll) {
  for (const double roll : {-3.0, -0.4, 0.0, 1.2}) {
    for (const double pitch : {-1.5, -0.2, 0.0, 0.9}) {
      for (const double yaw : {-2.0, 0.0, 0.3, 3.1}) {
        const Pose<3> pose = make_pose<3>(Vec3::Zero(), {roll, pitch, yaw});
        const Angles a = angles(pose);
        EXPECT_NEAR(a.roll, roll, 1e-13);
        EXPECT_NEAR(a.pitch, pitch, 1e-13);
        EXPECT_NEAR(a.yaw, yaw, 1e-13);
        EXPECT_NEAR(rotation(pose).determinant(), 1, rounding);
      }
    }
  }
  // Yaw first: a ship turned to port by a quarter and then heeled has its mast in the x-z plane.
  const Vec3 mast = vector_to_earth<3>(make_pose<3>(Vec3::Zero(), {0.1, 0, pi / 2}), Vec3(0, 0, 1));
  EXPECT_NEAR(mast.y(), 0, rounding);
  EXPECT_NEAR(mast.x(), std::sin(0.1), rounding);
  const Pose<3> upright = make_pose<3>(Vec3::Zero(), {0.3, pi / 2, 0.2});
  const Angles a = angles(upright);
  const Rotation<3> same = rotation(make_pose<3>(Vec3::Zero(), a));
  EXPECT_LT((same - rotation(upright)).norm(), 1e-7);  // the angles are ill-conditioned there
}

TEST(Pose, TransformsAreInverse) {
  const Pose<3> pose = make_pose<3>(Vec3(1, 2, 3), {0.4, -0.3, 2.0});
  const Vec3 x(0.3, -0.7, 1.1);
  EXPECT_LT((to_body<3>(pose, to_earth<3>(pose, x)) - x).norm(), 1e-14);
  EXPECT_LT((vector_to_body<3>(pose, vector_to_earth<3>(pose, x)) - x).norm(), 1e-14);
}

TEST(Pose, AdvanceIsExactForConstantTwist) {
  Twist<3> twist;
  twist << 0.1, 0.2, -0.3, 0.5, -0.9, 1.3;
  const Pose<3> start = make_pose<3>(Vec3(1, 0, 0), {0.2, 0.1, -0.4});
  Pose<3> small = start;
  for (int i = 0; i < 1000; ++i) small = advance(small, twist, 0.002);
  const Pose<3> large = advance(start, twist, 2);
  EXPECT_LT((small.cog - large.cog).norm(), 1e-12);
  EXPECT_LT((rotation(small) - rotation(large)).norm(), 1e-12);
  EXPECT_NEAR(small.attitude.norm(), 1, 1e-15);
  EXPECT_LT((rotation(advance(large, twist, -2)) - rotation(start)).norm(), 1e-14);
  const Vec3 omega = twist.tail<3>();  // the axis of the turn stays where it is
  const Eigen::AngleAxisd turn(2 * omega.norm(), omega.normalized());
  EXPECT_LT((rotation(large) - turn.toRotationMatrix() * rotation(start)).norm(), 1e-14);
}

TEST(Pose, MaterialPointsMoveWithVelocityAt) {
  Twist<3> twist;
  twist << 0.1, 0.2, -0.3, 0.5, -0.9, 1.3;
  const Pose<3> pose = make_pose<3>(Vec3(1, 0, 0), {0.2, 0.1, -0.4});
  const Vec3 body_point(0.3, 0.1, -0.2);
  const double dt = 1e-5;
  const Vec3 before = to_earth<3>(advance(pose, twist, -dt), body_point);
  const Vec3 after = to_earth<3>(advance(pose, twist, dt), body_point);
  const Vec3 now = to_earth<3>(pose, body_point);
  EXPECT_LT(((after - before) / (2 * dt) - velocity_at<3>(twist, pose, now)).norm(), 1e-9);
}

TEST(Pose, SectionRollPassesHalfATurnWithoutAJump) {
  Pose<2> pose;
  for (int i = 0; i < 100; ++i) pose = advance(pose, Twist<2>(0, 0, 1), 0.1);
  EXPECT_NEAR(pose.roll, 10, 1e-12);
  EXPECT_NEAR(displacement<2>(pose, Vec2::Zero())[2], 10, 1e-12);
  EXPECT_NEAR(unwrapped(-3.1, 3.1), 2 * pi - 3.1, 1e-14);
  EXPECT_NEAR(unwrapped(0.1, 12.5), 0.1 + 4 * pi, 1e-14);
}

TEST(Pose, DisplacementListsMotionsInOrder) {
  const Pose<3> pose = make_pose<3>(Vec3(1.1, 2.2, 3.3), {0.1, 0.2, 0.3});
  DofVector<3> expected;
  expected << 0.1, 0.2, 0.3, 0.1, 0.2, 0.3;
  EXPECT_LT((displacement<3>(pose, Vec3(1, 2, 3)) - expected).norm(), 1e-14);
}

}  // namespace
}  // namespace seaway::motion
