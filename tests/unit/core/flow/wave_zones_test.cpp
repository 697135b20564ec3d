// Relaxation towards a wave and towards rest at the ends of a tank.
#include "core/flow/wave_zones.hpp"

#include <gtest/gtest.h>

#include "core/waves/water_fraction.hpp"
#include "tests/unit/core/flow/tanks.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

constexpr double zone = 0.75, rate = 8, dt = 0.02, level = 1.5;

std::shared_ptr<const waves::WaveField> wave() {
  waves::RegularWaveSpec spec;
  spec.height = 0.2;
  spec.length = 3;
  spec.depth = 1.5;
  return waves::make_wave(spec);
}

/// A tank of 3 x 3 with the calm surface at its middle, z from -1.5 to 1.5.
Forest<2> tank() {
  mesh::TankGrid<2> grid;
  grid.lower = {0, -level};
  grid.upper = {3, level};
  grid.root_blocks = {3, 3};
  return Forest<2>(grid, 1, [](const Vec2& lower, const Vec2& upper, int at) {
    return at == 0 && lower[1] < 0.2 && upper[1] > -0.2;
  });
}

SideZones<2> sides(const ZoneSpec& lower, const ZoneSpec& upper) {
  SideZones<2> out;
  out[0] = {lower, upper};
  return out;
}

TEST(WaveZones, VofGoesTowardsTheWaveAndTheBookSaysByHowMuch) {
  const auto forest = tank();
  const WaveZones<2> zones(forest, wave(), sides({zone, true}, {zone, true}), rate);
  FlowState<2> state(forest);
  fill_water<2>(
      forest, [](const Vec2&) { return 0.013; }, state);
  const auto before = state.vof;
  const double t = 0.3;
  const double added = zones.relax_vof(state.vof, t, dt);
  EXPECT_NEAR(added, water_volume<2>(forest, state.vof) - water_volume<2>(forest, before), 1e-13);
  EXPECT_NE(added, 0);
  each_cell<2>(forest, [&](int b, const IVec<2>& i) {
    const auto& block = forest.block(b);
    const Vec2 x = block.cell_centre(i), half = 0.5 * block.h;
    const double into = std::max(0.0, std::max(zone - x[0], x[0] - 3 + zone)) / zone;
    const double weight = 1 - std::exp(-rate * into * into * dt);
    const double target = waves::water_fraction<2>(*wave(), x - half, x + half, t);
    const double c = cell_of(before, b, i);
    EXPECT_NEAR(cell_of(state.vof, b, i), c + weight * (target - c), 1e-12);
  });
}

TEST(WaveZones, ZonesOfRestChangeNoWater) {
  const auto forest = tank();
  FlowState<2> state(forest);
  fill_water<2>(
      forest, [](const Vec2& x) { return 0.1 * x[0]; }, state);
  const auto before = state.vof;
  const WaveZones<2> calm(forest, nullptr, sides({zone, false}, {zone, false}), rate);
  EXPECT_EQ(calm.relax_vof(state.vof, 0, dt), 0);
  EXPECT_FALSE(calm.drives(0, 0));
  const WaveZones<2> beach(forest, wave(), sides({0, true}, {zone, false}), rate);
  EXPECT_EQ(beach.relax_vof(state.vof, 0, dt), 0);
  EXPECT_TRUE(beach.drives(0, 0));
  EXPECT_FALSE(beach.drives(0, 1));
  EXPECT_EQ(state.vof.data(), before.data());
}

TEST(WaveZones, VelocityOfTheWaterGoesTowardsItsTargetAndAirIsLeftAlone) {
  const auto forest = tank();
  const auto w = wave();
  const WaveZones<2> zones(forest, w, sides({zone, true}, {zone, false}), rate);
  FlowState<2> state(forest);
  fill_water<2>(
      forest, [](const Vec2&) { return 0.0; }, state);  // on a grid line
  fill_faces<2>(
      forest, [](const Vec2&, int) { return 0.4; }, state.u);
  const double t = 0.3;
  zones.relax_velocity(state, t, dt);
  for (int axis = 0; axis < 2; ++axis)
    each_face<2>(forest, axis, [&](int b, const IVec<2>& i) {
      const auto& block = forest.block(b);
      const Vec2 x = block.face_centre(i, axis);
      // Level jumps hold means of the fine faces; they lie in plain water and air here.
      if (std::abs(std::abs(x[1]) - 0.5) < 1e-9) return;
      double water = x[1] < 0 ? 1.0 : 0.0;
      if (axis == 1 && std::abs(x[1]) < 1e-9) water = 0.5;
      const bool end = axis == 0 && (x[0] < 1e-9 || x[0] > 3 - 1e-9);
      const double target = x[0] < 1.5 ? waves::velocity_at<2>(*w, x, t)[axis] : 0.0;
      const double into = std::max(0.0, std::max(zone - x[0], x[0] - 3 + zone)) / zone;
      const double r = rate * into * into * dt * water;
      const double expected = end ? water * target : (0.4 + r * target) / (1 + r);
      EXPECT_NEAR(face_of(state.u, axis, b, i), expected, 1e-10) << x.transpose();
    });
}

// Zones at all four sides of a tank of 3 x 3 x 3; where two overlap the deeper one counts.
TEST(WaveZones, AnObliqueWaveHasZonesAtAllSides) {
  mesh::TankGrid<3> grid;
  grid.lower = {0, 0, -level};
  grid.upper = {3, 3, level};
  grid.root_blocks = {3, 3, 3};
  const Forest<3> forest(grid, 0, [](const Vec3&, const Vec3&, int) { return false; });
  waves::RegularWaveSpec spec;
  spec.height = 0.2;
  spec.length = 3;
  spec.depth = 1.5;
  spec.heading = 40 * pi / 180;
  const std::shared_ptr<const waves::WaveField> w = waves::make_wave(spec);
  SideZones<3> all;
  all[0] = {ZoneSpec{zone, true}, ZoneSpec{0.5, true}};
  all[1] = {ZoneSpec{zone, true}, ZoneSpec{0.5, true}};
  const WaveZones<3> zones(forest, w, all, rate);
  const auto depth_in = [](double x) { return std::max({0.0, (zone - x) / zone, (x - 2.5) / 0.5}); };
  FlowState<3> state(forest);
  fill_water<3>(
      forest, [](const Vec3&) { return 0.013; }, state);
  fill_faces<3>(
      forest, [](const Vec3&, int) { return 0.4; }, state.u);
  const auto before = state.vof;
  const double t = 0.3;
  zones.relax_velocity(state, t, dt);
  int inside = 0;
  for (int axis = 0; axis < 3; ++axis)
    each_face<3>(forest, axis, [&](int b, const IVec<3>& i) {
      const Vec3 x = forest.block(b).face_centre(i, axis);
      if (std::abs(x[2]) < 0.2) return;
      const double water = x[2] < 0 ? 1.0 : 0.0;
      const bool end = axis < 2 && (x[axis] < 1e-9 || x[axis] > 3 - 1e-9);
      const double into = std::max(depth_in(x[0]), depth_in(x[1])), r = rate * into * into * dt * water;
      inside += into > 0;
      const double target = waves::velocity_at<3>(*w, x, t)[axis];
      EXPECT_NEAR(face_of(state.u, axis, b, i), end ? water * target : (0.4 + r * target) / (1 + r), 1e-10) << x.transpose();
    });
  EXPECT_GT(inside, 10000);
  zones.relax_vof(state.vof, t, dt);
  each_cell<3>(forest, [&](int b, const IVec<3>& i) {
    const auto& block = forest.block(b);
    const Vec3 x = block.cell_centre(i), half = 0.5 * block.h;
    const double into = std::max(depth_in(x[0]), depth_in(x[1]));
    const double target = waves::water_fraction<3>(*w, x - half, x + half, t), c = cell_of(before, b, i);
    EXPECT_NEAR(cell_of(state.vof, b, i), c + (1 - std::exp(-rate * into * into * dt)) * (target - c), 1e-12) << x.transpose();
  });
}

}  // namespace
}  // namespace seaway::flow
