// Linear sloshing: limits that are known without it.
#include "tests/validation/support/linear_sloshing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::validation {
namespace {

TEST(LinearSloshing, SlowRollIsHydrostatics) {
  for (const double axis : {-0.14, -0.04, 0.0, 0.1}) {
    const RollingTank tank{0.36, 0.14, axis};
    EXPECT_NEAR(tank.moment_per_angle(1e-3), tank.moment_per_angle_at_rest(), 1e-5 * std::abs(tank.moment_per_angle_at_rest())) << axis;
  }
}

// Far above all modes the surface only moves along its normal: of a tank that is narrow for its depth the water turns as
// the lidded tank's would about its middle, its mass goes with the middle: depth^3 breadth / 12 + area arm^2.
TEST(LinearSloshing, FastRollOfANarrowTankIsAnInertia) {
  const RollingTank tank{0.02, 1.0, 0.3};
  const double omega = 2000, area = 0.02, arm = 0.8;
  const double inertia = 1000 * area * (1.0 / 12 + arm * arm);
  EXPECT_NEAR(tank.moment_per_angle(omega) / (omega * omega), inertia, 0.02 * inertia);
}

TEST(LinearSloshing, FirstModeOfAShallowTankIsALongWave) {
  const RollingTank tank{2.0, 0.02, 0};
  EXPECT_NEAR(tank.first_mode(), pi / 2.0 * std::sqrt(9.81 * 0.02), 2e-4 * tank.first_mode());
  // Resonance: the moment changes its sign across the mode.
  EXPECT_GT(tank.moment_per_angle(0.99 * tank.first_mode()), 0);
  EXPECT_LT(tank.moment_per_angle(1.01 * tank.first_mode()), 0);
}

// The axis matters through rigid-body terms alone where the surface keeps level with the earth: moving it by e changes the
// static moment by the weight's lever.
TEST(LinearSloshing, LoweringTheAxisUnderSlowRollAddsTheWeight) {
  const RollingTank high{0.36, 0.14, 0.05}, low{0.36, 0.14, 0.0};
  EXPECT_NEAR(low.moment_per_angle_at_rest() - high.moment_per_angle_at_rest(), 9810 * 0.36 * 0.14 * 0.05, 1e-9);
}

}  // namespace
}  // namespace seaway::validation
