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

}  // namespace
}  // namespace seaway::flow
