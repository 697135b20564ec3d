#include "core/transfer/mesh_pair.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/unit/core/transfer/meshes.hpp"

namespace seaway::transfer {
namespace {

using testing::boxed;
using testing::unit_tank;

template <int Dim>
void check_sources() {
  const auto grid = unit_tank<Dim>(4);
  const Forest<Dim> from = boxed<Dim>(grid, 0.1, 0.45, 2), to = boxed<Dim>(grid, 0.3, 0.9, 3);
  const MeshPair<Dim> pair(from, to);
  std::array<std::int64_t, 3> cells{};
  for (const int b : to.leaves()) {
    const BlockSource& s = pair.source(b);
    const auto& block = to.block(b);
    const auto& old = from.block(s.block);
    cells[static_cast<std::size_t>(s.origin)] += BlockShape<Dim>::cells;
    EXPECT_EQ(block.level - s.depth, old.level);
    for (int a = 0; a < Dim; ++a) EXPECT_EQ(block.coord[a] >> s.depth, old.coord[a]);
    EXPECT_EQ(s.origin == Origin::coarsened, !old.leaf);
    EXPECT_EQ(s.origin == Origin::refined, s.depth > 0);
  }
  for (std::size_t o = 0; o < 3; ++o) {
    EXPECT_GT(cells[o], 0);
    EXPECT_EQ(cells[o], pair.cells(static_cast<Origin>(o)));
  }
  EXPECT_EQ(pair.max_depth(), 3);
}
TEST(MeshPair, EveryLeafHasItsSourceIn2D) { check_sources<2>(); }
TEST(MeshPair, EveryLeafHasItsSourceIn3D) { check_sources<3>(); }

template <int Dim>
void check_steps(double low, double high) {
  const auto grid = unit_tank<Dim>(4);
  const Forest<Dim> from = boxed<Dim>(grid, low, high, 2), to = boxed<Dim>(grid, 0.3, 0.7, 3);
  const auto between = forests_between(from, to);
  std::vector<const Forest<Dim>*> chain{&from};
  for (const auto& f : between) chain.push_back(f.get());
  chain.push_back(&to);
  for (std::size_t k = 1; k < chain.size(); ++k) {
    const MeshPair<Dim> step(*chain[k - 1], *chain[k]);
    EXPECT_LE(step.max_depth(), 1);
    EXPECT_FALSE(step.cells(Origin::coarsened) > 0 && step.max_depth() > 0) << "step " << k;
  }
}
TEST(MeshPair, StepsRefineByOneLevelOrCoarsenIn2D) { check_steps<2>(0.1, 0.4); }
TEST(MeshPair, StepsRefineByOneLevelOrCoarsenIn3D) { check_steps<3>(0.1, 0.4); }
TEST(MeshPair, PureRefinementByOneLevelNeedsNoStepsBetween) {
  const auto grid = unit_tank<2>(4);
  EXPECT_TRUE(forests_between(boxed<2>(grid, 0.2, 0.8, 2), boxed<2>(grid, 0.3, 0.7, 3)).empty());
}

TEST(MeshPair, RefusesAnotherTank) {
  const Forest<2> a = boxed<2>(unit_tank<2>(2), 0, 0, 0), b = boxed<2>(unit_tank<2>(3), 0, 0, 0);
  EXPECT_THROW(MeshPair<2>(a, b), Error);
}

}  // namespace
}  // namespace seaway::transfer
