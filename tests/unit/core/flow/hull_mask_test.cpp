// Apertures, fluid fractions and rigid-body rows of a hull in the grid.
#include "core/flow/hull_mask.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/unit/core/flow/barges.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

class Angles : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(HullMask, Angles, ::testing::Values(0.0, 7.3, 15.0), [](const auto& angle) {
  return std::to_string(static_cast<int>(angle.param));
});

TEST_P(Angles, FluidFractionsLeaveOutExactlyTheHull) {
  const BargeTank tank;
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(GetParam() * degree));
  const auto& window = mask.window();
  double fluid = 0, total = 0;
  window.for_cells([&](const IVec<2>& i) {
    fluid += mask.fluid_fraction()[static_cast<std::size_t>(window.at(i))] * window.cell_volume();
    total += window.cell_volume();
  });
  EXPECT_NEAR(total - fluid, beam * height, 1e-10 * beam * height);  // clipping is exact
}

TEST_P(Angles, AperturesAreVolumesOfControlVolumes) {
  // The control volumes of an axis tile the window: their solid parts add up to the hull, but for
  // the apertures below the smallest one.
  const BargeTank tank;
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(GetParam() * degree));
  const auto& window = mask.window();
  for (int axis = 0; axis < 2; ++axis) {
    double solid = 0;
    window.for_faces(axis, [&](const IVec<2>& i) {
      const double a =
          mask.now()
              .aperture[static_cast<std::size_t>(axis)][static_cast<std::size_t>(window.at(i))];
      EXPECT_TRUE(a == 0 || (a >= smallest_aperture && a <= 1));
      solid += (1 - a) * window.cell_volume();
    });
    EXPECT_NEAR(solid, beam * height, smallest_aperture * 2 * (beam + height) * window.h()[0]);
  }
}

TEST_P(Angles, RowsOfTheRigidBodySumToZero) {
  // A constant pressure all around exerts neither force nor moment: the volume of the hull is
  // constant.
  const BargeTank tank;
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(GetParam() * degree));
  const auto rows = mask.rigid_rows(mask.now());
  ASSERT_GT(rows.cell.size(), 40u);
  motion::DofVector<2> sum = motion::DofVector<2>::Zero();
  double scale = 0;
  for (const auto& j : rows.j) {
    sum += j;
    scale += j.cwiseAbs().sum();
  }
  EXPECT_LT(sum.cwiseAbs().maxCoeff(), 1e-13 * scale);
}

TEST_P(Angles, HydrostaticPressureGivesArchimedesAndItsMoment) {
  // Fully submerged in p = -rho g z, the staggered volumes give the exact force; the moment about
  // the cog, which is the hull's centroid, is zero. Only apertures closed below the smallest one
  // are missing.
  const BargeTank tank;
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(GetParam() * degree));
  const auto rows = mask.rigid_rows(mask.now());
  CellField<double, 2> p(tank.forest);
  each_cell<2>(tank.forest, [&](int b, const IVec<2>& i) {
    cell_of(p, b, i) = -9810 * tank.forest.block(b).cell_centre(i)[1];
  });
  const auto load = rows.gather(p.data());
  const double weight = 9810 * beam * height;
  EXPECT_NEAR(load[0], 0, 1e-3 * weight);
  EXPECT_NEAR(load[1], weight, 1e-3 * weight);
  EXPECT_NEAR(load[2], 0, 1e-3 * weight * beam);
}

TEST_P(Angles, SubmergedSolidAddsUpToTheDrownedPart) {
  const BargeTank tank;
  const auto pose = BargeTank::afloat(GetParam() * degree);
  const HullMask<2> mask = tank.mask_at(pose);
  const auto& window = mask.window();
  // The surface z = level as a plane of each cell: xi_z <= d.
  const double level = pose.cog[1];  // through the centroid: half the barge at any angle
  double solid = 0, all = 0;
  window.for_cells([&](const IVec<2>& i) {
    const double bottom = window.cell_centre(i)[1] - 0.5 * window.h()[1];
    solid += mask.submerged_solid(i, {0.0, 1.0}, (level - bottom) / window.h()[1]);
    all += mask.submerged_solid(i, {0.0, 1.0}, 1e3);
  });
  EXPECT_NEAR(all, beam * height, 1e-10 * beam * height);
  EXPECT_NEAR(solid, 0.5 * beam * height, 1e-10 * beam * height);
}

TEST_P(Angles, MixtureVelocityOfARigidMotionIsThatMotionEverywhere) {
  const BargeTank tank;
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(GetParam() * degree));
  motion::Twist<2> twist;
  twist << 0.3, -0.2, 0;
  for (int axis = 0; axis < 2; ++axis) {
    const std::vector<double> u(mask.window().size(), twist[axis]);
    std::vector<double> w;
    mask.mixture_velocity(axis, twist, u, w);
    mask.window().for_faces(axis, [&](const IVec<2>& i) {
      EXPECT_NEAR(w[static_cast<std::size_t>(mask.window().at(i))], twist[axis], 1e-15);
    });
  }
}

TEST(HullMask, NotesWhetherItMovedToOtherBlocks) {
  const BargeTank tank;
  HullMask<2> mask = tank.mask_at(BargeTank::afloat(0));
  mask.update(BargeTank::afloat(0), BargeTank::afloat(0));
  EXPECT_FALSE(mask.moved());
  mask.update(BargeTank::afloat(0, 0.0037, 0.02), BargeTank::afloat(0, 0.0037, 0.021));
  EXPECT_DOUBLE_EQ(mask.now().pose.cog[1], 0.02);
  EXPECT_DOUBLE_EQ(mask.half().pose.cog[1], 0.021);
}

TEST(HullMask, SaysThatTheHullHasLeftItsRefinedRegion) {
  const BargeTank tank;
  HullMask<2> mask = tank.mask_at(BargeTank::afloat(0));
  const auto beyond = BargeTank::afloat(0, 0.3);
  try {
    mask.update(beyond, beyond);
    FAIL() << "no exception";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::failed_precondition);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("left the region refined for it"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("hull_sweep"));
  }
}

}  // namespace
}  // namespace seaway::flow
