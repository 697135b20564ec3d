// The book of the water at the hull: who takes what a cell has too much of, and who does not.
#include "core/flow/volume_book.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/flow/barges.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

// A submerged cut cell has too much water, and the only mixed cell near it is all but full: it must not be emptied
// for that. What it cannot give is owed, and nothing is lost.
TEST(VolumeBook, AlmostFullCellIsNotEmptiedForItsNeighbours) {
  const BargeTank tank;
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(0));
  const auto& window = mask.window();
  FlowState<2> state(tank.forest);
  fill_flat(tank, &mask, 0.0, state);
  std::vector<double> vof;
  window.load_cells(state.vof, vof);
  std::size_t cut = 0, taker = 0;
  window.for_cells([&](const IVec<2>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    const double theta = mask.fluid_fraction()[at];
    const auto below = at - static_cast<std::size_t>(window.stride(1));
    if (theta > 0.2 && theta < 0.8 && std::abs(window.cell_centre(i)[0]) < 0.1 && window.cell_centre(i)[1] < 0 && mask.fluid_fraction()[below] == 1) cut = at;
  });
  ASSERT_GT(cut, 0u);
  taker = cut - static_cast<std::size_t>(window.stride(1));  // below the bottom
  ASSERT_EQ(mask.fluid_fraction()[taker], 1.0);
  vof[cut] = 0.9;
  vof[taker] = 0.999;
  window.store_cells(vof, state.vof);

  VolumeBook<2> book;
  book.restart(mask, vof);
  double before = 0;
  for (const double v : book.visible()) before += v;
  book.begin_step(mask, state);
  book.close_fluxes(mask, state.vof, motion::Twist<2>::Zero(), 0.01);
  const std::vector<double> advected = vof;
  vof[cut] = 1.0;
  book.settle(mask, advected, vof, 0.01, true);

  EXPECT_GE(vof[taker], 0.995);  // two shares of at most c (1 - c): a neighbour's and the reservoir's
  double after = book.reservoir_total();
  for (const double v : book.visible()) after += v;
  EXPECT_NEAR(after, before, 1e-15);
}

}  // namespace
}  // namespace seaway::flow
