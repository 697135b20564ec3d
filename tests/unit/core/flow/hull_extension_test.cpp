// Values inside the hull: the surface goes straight on, also over a bottom that sees nothing but water.
#include "core/flow/hull_extension.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/core/flow/barges.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

class Bottom : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(HullExtension, Bottom, ::testing::Values(0.0, 0.8, 1.6), [](const auto& p) {
  return std::to_string(static_cast<int>(10 * p.param));
});

// A counter: 3 mm of water over a flat bottom, cells of 6.25 mm. All that the cells above the bottom see is below them
// and wet; the surface has to come in level from the sides.
TEST_P(Bottom, SurfaceJustAboveItGoesOnLevel) {
  const BargeTank tank;
  const double level = 0.0007;
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(GetParam() * degree, 0.0037, 0.05 - 0.003 + level));
  const auto& window = mask.window();
  const auto flat = [&](const IVec<2>& i) {
    return std::clamp(0.5 + (level - window.cell_centre(i)[1]) / window.h()[1], 0.0, 1.0);
  };
  std::vector<double> vof(window.size(), 0.0);  // as a run starts: level everywhere, the hull put into it
  window.for_cells([&](const IVec<2>& i) { vof[static_cast<std::size_t>(window.at(i))] = flat(i); });
  for (int step = 0; step < 5; ++step) HullExtension<2>().extend_vof(mask, vof);
  int over_the_bottom = 0;
  window.for_cells([&](const IVec<2>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    const double phi = mask.now().phi[at];
    if (mask.fluid_fraction()[at] >= 0.5 || phi < -1.5 * window.h()[1]) return;
    if (window.cell_centre(i)[1] > 0.03) return;  // the sides and the bottom, not the deck
    over_the_bottom += std::abs(window.cell_centre(i)[0]) < 0.1;
    EXPECT_NEAR(vof[at], flat(i), 1e-12) << window.cell_centre(i).transpose();
  });
  EXPECT_GT(over_the_bottom, 20);
}

// Three cells under the middle of the bottom hold half a per cent of air, and the hull is full of air from the step
// before: the water still goes on into the hull.
TEST(HullExtension, TraceOfAirUnderTheBottomStaysATrace) {
  const BargeTank tank;
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(0));
  const auto& window = mask.window();
  std::vector<double> vof(window.size(), 1.0);
  int traces = 0, inside = 0;
  window.for_cells([&](const IVec<2>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    const auto below = at - static_cast<std::size_t>(window.stride(1));
    const Vec2 x = window.cell_centre(i);
    if (mask.fluid_fraction()[at] < 0.5 || x[1] > 0) vof[at] = 0;
    if (std::abs(x[0]) < 0.01 && x[1] < 0 && mask.fluid_fraction()[at] < 0.5 && mask.fluid_fraction()[below] >= 0.5) {
      vof[below] = 0.995;
      ++traces;
    }
  });
  ASSERT_GE(traces, 3);
  HullExtension<2>().extend_vof(mask, vof);
  window.for_cells([&](const IVec<2>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    if (mask.fluid_fraction()[at] >= 0.5 || mask.now().phi[at] < -window.h()[1] || window.cell_centre(i)[1] > -0.02) return;
    EXPECT_GE(vof[at], 0.99) << window.cell_centre(i).transpose();
    ++inside;
  });
  EXPECT_GT(inside, 40);
}

// Water on a floor stands on it, whatever is beside the floor at its own height: the air outside a tank's walls, say.
TEST(HullExtension, WaterOnADeckGoesOnIntoTheDeck) {
  const BargeTank tank;
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(1.3 * degree));
  const auto& window = mask.window();
  const double deck = height - draft + 0.0021;  // over z = 0
  std::vector<double> vof(window.size(), 0.0);
  window.for_cells([&](const IVec<2>& i) {
    const Vec2 x = window.cell_centre(i);
    if (std::abs(x[0]) < 0.5 * beam && x[1] > deck - 0.02 && x[1] < deck + 0.03) vof[static_cast<std::size_t>(window.at(i))] = 1;
  });
  for (int step = 0; step < 3; ++step) HullExtension<2>().extend_vof(mask, vof);
  int in_the_deck = 0;
  window.for_cells([&](const IVec<2>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    const Vec2 x = window.cell_centre(i);
    if (mask.fluid_fraction()[at] >= 0.5 || mask.now().phi[at] < -window.h()[1]) return;
    if (std::abs(x[0]) > 0.08 || x[1] < 0) return;
    ++in_the_deck;
    EXPECT_EQ(vof[at], 1) << x.transpose();
  });
  EXPECT_GT(in_the_deck, 20);
}

}  // namespace
}  // namespace seaway::flow
