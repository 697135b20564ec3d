#include "core/mesh/forest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "core/base/error.hpp"

namespace seaway::mesh {
namespace {

/// Splits what touches a few random points, deeply: a forest that needs balancing everywhere.
template <int Dim>
Forest<Dim> thorny(bool periodic, int max_level = 4, int threads = 1) {
  TankGrid<Dim> grid;
  grid.lower.setConstant(-1);
  grid.upper.setConstant(2);
  grid.upper[0] = 3.5;  // cells are not cubes
  grid.root_blocks.fill(3);
  grid.periodic.fill(periodic);
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec<Dim>> points(5);
  for (auto& p : points)
    for (int a = 0; a < Dim; ++a)
      p[a] = grid.lower[a] + uniform(rng) * (grid.upper[a] - grid.lower[a]);
  points[0] = grid.lower;  // a corner of the tank: across it periodic neighbours meet
  const RefineRule<Dim> rule = [=](const Vec<Dim>& lower, const Vec<Dim>& upper, int) {
    for (const auto& p : points)
      if ((lower.array() <= p.array()).all() && (p.array() <= upper.array()).all()) return true;
    return false;
  };
  return Forest<Dim>(grid, max_level, rule, threads);
}

template <int Dim>
IVec<Dim> offset_of(int entry) {
  IVec<Dim> off{};
  for (int a = 0; a < Dim; ++a, entry /= 3) off[a] = entry % 3 - 1;
  return off;
}

template <int Dim>
void check_leaves_tile_the_tank() {
  const Forest<Dim> f = thorny<Dim>(false);
  double volume = 0;
  for (const int b : f.leaves()) {
    EXPECT_TRUE(f.block(b).leaf);
    volume += f.block(b).cell_volume() * BlockShape<Dim>::cells;
  }
  EXPECT_NEAR(volume, (f.grid().upper - f.grid().lower).prod(), 1e-12);
  EXPECT_EQ(f.n_cells(), static_cast<std::int64_t>(f.leaves().size()) * BlockShape<Dim>::cells);
  EXPECT_EQ(f.n_levels(), 5);
}
TEST(Forest, LeavesTileTheTankIn2D) { check_leaves_tile_the_tank<2>(); }
TEST(Forest, LeavesTileTheTankIn3D) { check_leaves_tile_the_tank<3>(); }

template <int Dim>
void check_tree() {
  const Forest<Dim> f = thorny<Dim>(false);
  for (int b = 0; b < f.n_blocks(); ++b) {
    const Block<Dim>& block = f.block(b);
    EXPECT_EQ(f.find(block.level, block.coord), b);
    EXPECT_GE(b, f.level_begin(block.level));
    EXPECT_LT(b, f.level_begin(block.level + 1));
    EXPECT_EQ(block.parent == no_block, block.level == 0);
    for (int c = 0; c < BlockShape<Dim>::children; ++c) {
      const int child = block.child[static_cast<std::size_t>(c)];
      EXPECT_EQ(child == no_block, block.leaf);
      if (block.leaf) continue;
      EXPECT_EQ(f.block(child).parent, b);
      for (int a = 0; a < Dim; ++a) {
        EXPECT_EQ(f.block(child).coord[a], 2 * block.coord[a] + ((c >> a) & 1));
        EXPECT_NEAR(f.block(child).h[a], 0.5 * block.h[a], 1e-15);
      }
    }
  }
}
TEST(Forest, ChildrenHalveTheirParentIn2D) { check_tree<2>(); }
TEST(Forest, ChildrenHalveTheirParentIn3D) { check_tree<3>(); }

/// Leaves that touch in as little as a corner differ by one level at most.
template <int Dim>
void check_balance(bool periodic) {
  const Forest<Dim> f = thorny<Dim>(periodic);
  bool jump = false;
  for (const int b : f.leaves()) {
    const Block<Dim>& block = f.block(b);
    for (int entry = 0; entry < BlockShape<Dim>::neighbours; ++entry) {
      const int nb = block.neighbour[static_cast<std::size_t>(entry)];
      if (nb == no_block) continue;
      if (nb == coarser_neighbour) {
        jump = true;
        // One level up the neighbour must be a leaf.
        IVec<Dim> at = block.coord, off = offset_of<Dim>(entry);
        for (int a = 0; a < Dim; ++a) {
          const int count = f.grid().root_blocks[a] << block.level;
          at[a] = ((at[a] + off[a] + count) % count) >> 1;
        }
        const int coarse = f.find(block.level - 1, at);
        ASSERT_NE(coarse, no_block);
        EXPECT_TRUE(f.block(coarse).leaf);
      } else if (!f.block(nb).leaf) {
        for (const int c : f.block(nb).child) {
          bool touches = true;  // children on the side of `block`
          const IVec<Dim> off = offset_of<Dim>(entry);
          for (int a = 0; a < Dim; ++a) {
            const int bit = f.block(c).coord[a] & 1;
            touches = touches && (off[a] == 0 || bit == (off[a] < 0 ? 1 : 0));
          }
          if (touches) {
            EXPECT_TRUE(f.block(c).leaf);
          }
        }
      }
    }
  }
  EXPECT_TRUE(jump);
}
TEST(Forest, IsBalancedOverCornersIn2D) { check_balance<2>(false); }
TEST(Forest, IsBalancedOverCornersIn3D) { check_balance<3>(false); }
TEST(Forest, IsBalancedAcrossPeriodicSidesIn2D) { check_balance<2>(true); }
TEST(Forest, IsBalancedAcrossPeriodicSidesIn3D) { check_balance<3>(true); }

template <int Dim>
void check_neighbours(bool periodic) {
  const Forest<Dim> f = thorny<Dim>(periodic);
  constexpr int last = BlockShape<Dim>::neighbours - 1;
  for (int b = 0; b < f.n_blocks(); ++b) {
    const Block<Dim>& block = f.block(b);
    EXPECT_EQ(block.neighbour[last / 2], b);
    for (int entry = 0; entry <= last; ++entry) {
      const int nb = block.neighbour[static_cast<std::size_t>(entry)];
      if (periodic) {
        EXPECT_NE(nb, no_block);
      }
      bool outside = false;
      for (int a = 0; a < Dim; ++a) {
        const int at = block.coord[a] + offset_of<Dim>(entry)[a];
        outside = outside || at < 0 || at >= (f.grid().root_blocks[a] << block.level);
      }
      EXPECT_EQ(nb == no_block, outside && !periodic);
      if (nb < 0) continue;
      EXPECT_EQ(f.block(nb).level, block.level);
      EXPECT_EQ(f.block(nb).neighbour[static_cast<std::size_t>(last - entry)], b);
    }
  }
}
TEST(Forest, NeighboursAreSymmetricIn2D) { check_neighbours<2>(false); }
TEST(Forest, NeighboursAreSymmetricIn3D) { check_neighbours<3>(false); }
TEST(Forest, PeriodicNeighboursAreSymmetricIn2D) { check_neighbours<2>(true); }
TEST(Forest, PeriodicNeighboursAreSymmetricIn3D) { check_neighbours<3>(true); }

TEST(Forest, OnePeriodicRootBlockIsItsOwnNeighbour) {
  TankGrid<2> grid{Vec2(0, 0), Vec2(1, 1), {1, 1}, {true, false}};
  const Forest<2> f(grid, 0, [](const Vec2&, const Vec2&, int) { return false; });
  const auto& nb = f.block(0).neighbour;
  EXPECT_EQ(nb[static_cast<std::size_t>(face_neighbour<2>(0, 0))], 0);
  EXPECT_EQ(nb[static_cast<std::size_t>(face_neighbour<2>(0, 1))], 0);
  EXPECT_EQ(nb[static_cast<std::size_t>(face_neighbour<2>(1, 0))], no_block);
}

template <int Dim>
void check_find_leaf() {
  const Forest<Dim> f = thorny<Dim>(false);
  for (const int b : f.leaves()) {
    const Block<Dim>& block = f.block(b);
    for (const double part : {0.01, 0.5, 0.99}) {
      const Vec<Dim> x = block.origin + part * BlockShape<Dim>::n * block.h;
      EXPECT_EQ(f.find_leaf(x), b);
    }
  }
  // Points outside belong to the nearest leaf, points on the upper corner to the last one.
  EXPECT_EQ(f.find_leaf(f.grid().lower - Vec<Dim>::Ones()),
            f.find_leaf(f.grid().lower + Vec<Dim>::Constant(1e-9)));
  const int last = f.find_leaf(f.grid().upper);
  EXPECT_NEAR((f.block(last).origin + BlockShape<Dim>::n * f.block(last).h - f.grid().upper).norm(),
              0, 1e-12);
}
TEST(Forest, FindsTheLeafOfAPointIn2D) { check_find_leaf<2>(); }
TEST(Forest, FindsTheLeafOfAPointIn3D) { check_find_leaf<3>(); }

/// The area of coarse faces is that of the fine faces on them, and each fine face at a jump has
/// one.
template <int Dim>
void check_coarse_faces(bool periodic) {
  const Forest<Dim> f = thorny<Dim>(periodic);
  std::set<std::array<int, 3>> listed;
  double coarse_area = 0, fine_area = 0;
  const auto area = [&](const Block<Dim>& block, int axis) {
    return std::pow(BlockShape<Dim>::n, Dim - 1) * block.cell_volume() / block.h[axis];
  };
  for (const CoarseFace& face : f.coarse_faces()) {
    EXPECT_TRUE(f.block(face.leaf).leaf);
    EXPECT_FALSE(f.block(face.parent).leaf);
    EXPECT_EQ(f.block(face.leaf).level, f.block(face.parent).level);
    EXPECT_EQ(f.block(face.leaf)
                  .neighbour[static_cast<std::size_t>(face_neighbour<Dim>(face.axis, face.side))],
              face.parent);
    EXPECT_TRUE(listed.insert({face.leaf, face.axis, face.side}).second) << "listed twice";
    coarse_area += area(f.block(face.leaf), face.axis);
  }
  for (const int b : f.leaves()) {
    bool touches = false;
    for (const int nb : f.block(b).neighbour) touches = touches || nb == coarser_neighbour;
    EXPECT_EQ(f.touches_coarser(b), touches);
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side)
        if (f.block(b).neighbour[static_cast<std::size_t>(face_neighbour<Dim>(axis, side))] ==
            coarser_neighbour)
          fine_area += area(f.block(b), axis);
  }
  EXPECT_GT(coarse_area, 0);
  EXPECT_NEAR(coarse_area, fine_area, 1e-10);
}
TEST(Forest, CoarseFacesMatchTheFineOnesIn2D) { check_coarse_faces<2>(false); }
TEST(Forest, CoarseFacesMatchTheFineOnesIn3D) { check_coarse_faces<3>(true); }

template <int Dim>
void check_interface_parents() {
  const Forest<Dim> f = thorny<Dim>(false);
  const std::set<int> listed(f.interface_parents().begin(), f.interface_parents().end());
  int level = f.n_levels();
  for (const int b : f.interface_parents()) {
    EXPECT_FALSE(f.block(b).leaf);
    EXPECT_LE(f.block(b).level, level) << "finest first";
    level = f.block(b).level;
    for (const int c : f.block(b).child) {  // restriction reads them
      EXPECT_TRUE(f.block(c).leaf || listed.count(c));
    }
  }
  for (const int b : f.leaves()) {
    for (const int nb : f.block(b).neighbour) {
      EXPECT_TRUE(nb < 0 || f.block(nb).leaf || listed.count(nb));
    }
    EXPECT_TRUE(!f.touches_coarser(b) || listed.count(f.block(b).parent));
  }
}
TEST(Forest, ListsTheParentsThatLeavesReadIn2D) { check_interface_parents<2>(); }
TEST(Forest, ListsTheParentsThatLeavesReadIn3D) { check_interface_parents<3>(); }

TEST(Forest, RefusesTooManyCells) {
  TankGrid<2> grid{Vec2(0, 0), Vec2(1, 1), {2, 2}, {false, false}};
  try {
    const Forest<2> f(
        grid, 6, [](const Vec2&, const Vec2&, int) { return true; }, 1, 100'000);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::resource_exhausted);
  }
}

TEST(Forest, PassesOnWhatTheRuleThrows) {
  TankGrid<2> grid{Vec2(0, 0), Vec2(1, 1), {2, 2}, {false, false}};
  const RefineRule<2> rule = [](const Vec2&, const Vec2&, int) -> bool {
    throw Error(ErrorCode::not_found, "nothing here");
  };
  EXPECT_THROW(Forest<2>(grid, 2, rule), Error);
}

TEST(Forest, RefusesAnEmptyTank) {
  TankGrid<2> grid{Vec2(0, 0), Vec2(1, 0), {2, 2}, {false, false}};
  EXPECT_THROW(Forest<2>(grid, 0, [](const Vec2&, const Vec2&, int) { return false; }), Error);
}

}  // namespace
}  // namespace seaway::mesh
