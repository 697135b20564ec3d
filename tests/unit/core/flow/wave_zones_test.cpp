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

TEST(WaveZones, VofGoesTowardsTheWaveAndTheBookSaysByHowMuch) {
  const auto forest = tank();
  const WaveZones<2> zones(forest, wave(), 0, {zone, true}, {zone, true}, rate);
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
  const WaveZones<2> calm(forest, nullptr, 0, {zone, false}, {zone, false}, rate);
  EXPECT_EQ(calm.relax_vof(state.vof, 0, dt), 0);
  EXPECT_FALSE(calm.drives(0));
  const WaveZones<2> beach(forest, wave(), 0, {0, true}, {zone, false}, rate);
  EXPECT_EQ(beach.relax_vof(state.vof, 0, dt), 0);
  EXPECT_TRUE(beach.drives(0));
  EXPECT_FALSE(beach.drives(1));
  EXPECT_EQ(state.vof.data(), before.data());
}

TEST(WaveZones, VelocityOfTheWaterGoesTowardsItsTargetAndAirIsLeftAlone) {
  const auto forest = tank();
  const auto w = wave();
  const WaveZones<2> zones(forest, w, 0, {zone, true}, {zone, false}, rate);
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

}  // namespace
}  // namespace seaway::flow
