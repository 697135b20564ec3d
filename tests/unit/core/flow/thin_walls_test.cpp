// Walls thinner than a cell: spaces of cells, closed faces, openings, and the water that the walls take.
#include <gtest/gtest.h>

#include "core/flow/hull_mask.hpp"
#include "tests/unit/core/flow/barges.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

/// The barge as a tub with walls of 3 mm (cells of 6.25 mm) and, on request, a hole in its port side.
std::shared_ptr<const hull::SectionHull> tub(double cell, bool hole) {
  hull::SectionSpec spec;
  spec.shape = hull::SectionSpec::Shape::box;
  spec.beam = beam;
  spec.height = height;
  hull::CompartmentSpec hold{"hold", {Vec2(-0.147, 0.003), Vec2(0.147, 0.097)}, 0.003, 1, {}};
  if (hole) hold.openings.push_back({"hole", {Vec2(0.1465, 0.02), Vec2(0.1505, 0.045)}});
  spec.compartments = {hold};
  return std::make_shared<hull::SectionHull>(hull::build_section(spec), 0.5 * cell, 0.25, 2 * cell);
}

class Roll : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(ThinWalls, Roll, ::testing::Values(0.0, 7.3, 15.0, 31.0),
                         [](const auto& p) { return std::to_string(static_cast<int>(p.param)); });

HullMask<2> mask_of(const BargeTank& tank, bool hole, double roll, double y) {
  HullMask<2> mask(tank.forest, tub(tank.forest.finest_cell(), hole), tank.body, 6, Walls::thin);
  const auto pose = BargeTank::afloat(roll * degree, y);
  mask.update(pose, pose);
  return mask;
}

TEST_P(Roll, NoOpenFaceJoinsTwoSpaces) {
  const BargeTank tank;
  const HullMask<2> mask = mask_of(tank, false, GetParam(), 0.0037);
  const auto& window = mask.window();
  int walls = 0, inside = 0;
  for (int axis = 0; axis < 2; ++axis)
    window.for_cells([&](const IVec<2>& i) {
      const auto at = static_cast<std::size_t>(window.at(i));
      inside += mask.now().space[at] == 1;
      if (!mask.is_wall(mask.now(), at, axis, i[axis] == 0)) return;
      ++walls;
      EXPECT_EQ(mask.now().aperture[static_cast<std::size_t>(axis)][at], 0.0);
    });
  EXPECT_GT(walls, 100);
  EXPECT_GT(inside, 1000);
}

/// Rows of cells that lead from the hold to the sea without a closed face: as high as the hole.
TEST_P(Roll, AHoleOpensTheRowsThatItMeets) {
  const BargeTank tank;
  const HullMask<2> mask = mask_of(tank, true, GetParam(), 0.0037);
  const auto& window = mask.window();
  const auto& spaces = mask.now().space;
  int rows = 0;
  for (int j = 1; j + 1 < window.n()[1]; ++j) {
    bool open = false;
    for (int i = 1, from = -1; i < window.n()[0]; ++i) {
      const auto at = static_cast<std::size_t>(window.at({i, j}));
      if (spaces[at - 1] == 1) from = i;  // the last cell of the hold
      if (spaces[at] != 0 || from < 0) continue;
      open = true;
      for (int k = from; k <= i; ++k)
        open = open && mask.now().aperture[0][static_cast<std::size_t>(window.at({k, j}))] > 0.5;
      from = -1;
    }
    rows += open;
  }
  const double wanted = 0.025 * std::cos(GetParam() * degree);
  EXPECT_NEAR(rows * window.h()[1], wanted, 1.2 * window.h()[1]);
}

/// Water at the same level inside and outside: what the walls displace is all that the hull feels, wherever the
/// grid's lines fall.
TEST_P(Roll, WeightOfTheCarriedWaterRestoresArchimedes) {
  const BargeTank tank;
  const double level = 0.15;  // all under water
  for (const double y : {0.0037, 0.0052, 0.0061}) {
    const HullMask<2> mask = mask_of(tank, false, GetParam(), y);
    CellField<double, 2> p(tank.forest);
    const double rho = tank.fluids.rho_water, g = tank.fluids.gravity;
    each_cell<2>(tank.forest, [&](int b, const IVec<2>& i) {
      p.block(b)[field::offset<2>(i, field::cell_strides<2>())] =
          rho * g * (level - tank.forest.block(b).cell_centre(i)[1]);
    });
    const std::vector<double> water(mask.window().size(), 1.0);
    const motion::DofVector<2> force = mask.rigid_rows(mask.now()).gather(p.data()) + mask.carried_weight(water, tank.fluids);
    const double solid = beam * height - 0.294 * 0.094;
    EXPECT_NEAR(force[1], rho * g * solid, 1e-3 * rho * g * solid) << y;
    EXPECT_NEAR(force[0], 0, 1e-9 * rho * g * beam * height) << y;
  }
}

}  // namespace
}  // namespace seaway::flow
