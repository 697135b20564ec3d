#include "core/motion/prescribed_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::motion {
namespace {

const PrescribedMotion roll{Dof::roll, 0.2, 1.4, 2.0};

TEST(PrescribedMotion, VelocityIsTheDerivativeOfPosition) {
  for (double t = 0.01; t < 4; t += 0.037) {
    const double d = 1e-5;
    EXPECT_NEAR(roll.velocity(t), (roll.position(t + d) - roll.position(t - d)) / (2 * d), 1e-8)
        << t;
  }
}

TEST(PrescribedMotion, StartsWithoutJumpAndEndsAsASine) {
  EXPECT_EQ(roll.position(-1), 0);
  EXPECT_EQ(roll.position(0), 0);
  EXPECT_NEAR(roll.velocity(1e-3), 0, 1e-7);
  const double acceleration_jump =
      (roll.velocity(2 + 1e-6) - 2 * roll.velocity(2) + roll.velocity(2 - 1e-6)) / 1e-6;
  EXPECT_NEAR(acceleration_jump, 0, 1e-3);
  EXPECT_NEAR(roll.position(3.3), 0.2 * std::sin(2 * pi * 3.3 / 1.4), 1e-15);
}

TEST(PrescribedMotion, MeanVelocityCarriesTheBodyExactly) {
  const std::array<PrescribedMotion, 2> motions{roll, PrescribedMotion{Dof::heave, 0.01, 0.9, 0}};
  Pose<2> section;
  Pose<3> ship;
  double t = 0;
  for (int i = 0; i < 300; ++i) {
    const double dt = 0.01 + 0.002 * std::sin(i);  // any steps
    Twist<2> twist = Twist<2>::Zero();
    prescribe<2>(motions, t, dt, twist);
    Twist<3> ship_twist = Twist<3>::Zero();
    prescribe<3>(motions, t, dt, ship_twist);
    section = advance(section, twist, dt);
    ship = advance(ship, ship_twist, dt);
    t += dt;
  }
  EXPECT_NEAR(section.roll, roll.position(t), 1e-13);
  EXPECT_NEAR(section.cog[1], motions[1].position(t), 1e-14);
  EXPECT_NEAR(angles(ship).roll, roll.position(t), 1e-13);
  EXPECT_EQ(ship.cog.x(), 0);
}

}  // namespace
}  // namespace seaway::motion
