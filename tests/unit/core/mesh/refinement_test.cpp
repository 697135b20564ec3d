#include "core/mesh/refinement.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/error.hpp"

namespace seaway::mesh {
namespace {

TEST(TankGrid, WholeMultiplesGiveExactlyTheWantedCell) {
  const auto grid = make_tank_grid<2>(Vec2(-3.2, -0.8), Vec2(3.2, 0.8), 0.1, {false, false});
  EXPECT_EQ(grid.root_blocks, (IVec<2>{4, 1}));
}

TEST(TankGrid, CellsAreAtMostTwelvePercentTooLarge) {
  for (double length = 0.3; length < 20; length *= 1.07) {
    const auto grid =
        make_tank_grid<3>(Vec3(0, 0, 0), Vec3(length, 1, 2), 0.05, {false, false, false});
    EXPECT_LE(length / (grid.root_blocks[0] * BlockShape<3>::n), 0.05 * 1.12 + 1e-12);
  }
}

TEST(TankGrid, RefusesNonsense) {
  EXPECT_THROW(make_tank_grid<2>(Vec2(0, 0), Vec2(1, 1), 0, {false, false}), Error);
  EXPECT_THROW(make_tank_grid<2>(Vec2(0, 1), Vec2(1, 1), 0.1, {false, false}), Error);
}

TEST(Refinement, LevelHalvesUntilTheCellIsSmallEnough) {
  const Vec2 base(0.08, 0.08);
  EXPECT_EQ(level_for_cell<2>(base, 0.08), 0);
  EXPECT_EQ(level_for_cell<2>(base, 0.0799), 0);  // within the stretch that a tank grid may need
  EXPECT_EQ(level_for_cell<2>(base, 0.04), 1);
  EXPECT_EQ(level_for_cell<2>(base, 0.01), 3);
  EXPECT_EQ(level_for_cell<2>(Vec2(0.08, 0.04), 0.04), 1);  // the longer edge counts
  EXPECT_THROW(level_for_cell<2>(base, 1e-9), Error);
  EXPECT_THROW(level_for_cell<2>(base, -1), Error);
}

TEST(Refinement, EveryPointOfABoxHasItsCell) {
  const double everywhere = std::numeric_limits<double>::infinity();
  const auto grid = make_tank_grid<2>(Vec2(0, 0), Vec2(8, 16), 0.25, {true, false});
  const std::vector<RefinedBox<2>> boxes{{Vec2(1, 1), Vec2(2.2, 1.7), 0.0625},
                                         {Vec2(-everywhere, 2.9), Vec2(everywhere, 3.1), 0.125}};
  const Forest<2> f(grid, finest_level<2>(grid, boxes), refine_boxes<2>(grid, boxes));
  EXPECT_EQ(f.n_levels(), 3);
  for (double x = 0.05; x < 8; x += 0.1)
    for (double z = 0.05; z < 4; z += 0.1)
      for (const auto& box : boxes) {
        const Vec2 at(x, z);
        if ((at.array() > box.lower.array()).all() && (at.array() < box.upper.array()).all()) {
          EXPECT_LE(f.block(f.find_leaf(at)).h.maxCoeff(), box.cell);
        }
      }
  EXPECT_EQ(f.block(f.find_leaf(Vec2(7.9, 15.9))).level, 0);
}

}  // namespace
}  // namespace seaway::mesh
