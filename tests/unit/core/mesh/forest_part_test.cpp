#include "core/mesh/forest_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace seaway::mesh {
namespace {

/// Two levels of refinement around a point off the middle.
template <int Dim>
Forest<Dim> uneven(bool periodic) {
  TankGrid<Dim> grid;
  grid.lower.setZero();
  grid.upper.setConstant(4);
  grid.root_blocks.fill(4);
  grid.periodic.fill(periodic);
  const RefineRule<Dim> rule = [](const Vec<Dim>& lower, const Vec<Dim>& upper, int) {
    return (lower.array() <= 1.3).all() && (upper.array() >= 1.3).all();
  };
  return Forest<Dim>(grid, 2, rule, 1);
}

/// Whether leaf `b` lies behind a side of leaf `a`, sharing more than an edge with it; of a periodic tank images count.
template <int Dim>
bool behind(const Forest<Dim>& f, int a, int b, int axis, int side) {
  constexpr int n = BlockShape<Dim>::n;
  for (int d = 0; d < Dim; ++d) {
    const double la = f.block(a).origin[d], lb = f.block(b).origin[d];
    const double ha = la + n * f.block(a).h[d], hb = lb + n * f.block(b).h[d];
    bool meets = false;
    for (const double shift : {0.0, -4.0, 4.0}) {
      if (shift != 0 && !f.grid().periodic[static_cast<std::size_t>(d)]) continue;
      meets = meets || (d == axis ? std::abs(side == 0 ? la - hb - shift : ha - lb - shift) < 1e-9
                                  : la < hb + shift - 1e-9 && lb + shift < ha - 1e-9);
    }
    if (!meets) return false;
  }
  return true;
}

template <int Dim>
void those_behind_a_side_are_chosen(bool periodic) {
  const Forest<Dim> f = uneven<Dim>(periodic);
  for (const int leaf : f.leaves())
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side) {
        std::vector<char> chosen(static_cast<std::size_t>(f.n_blocks()), 0);
        choose_behind(f, leaf, axis, side, chosen);
        for (const int b : f.leaves())
          EXPECT_EQ(chosen[static_cast<std::size_t>(b)] != 0, behind(f, leaf, b, axis, side)) << leaf << " " << axis << side << " " << b;
      }
}
TEST(ForestPart, ThoseBehindASideAreChosenIn2D) { those_behind_a_side_are_chosen<2>(false); }
TEST(ForestPart, ThoseBehindASideAreChosenIn3D) { those_behind_a_side_are_chosen<3>(false); }
TEST(ForestPart, ThoseBehindASideAreChosenAcrossPeriodicSides) { those_behind_a_side_are_chosen<2>(true); }

/// Nothing but finer leaves on the faces of chosen coarse ones with some chosen finer leaf, and all of those.
template <int Dim>
void jumps_are_completed(unsigned pick) {
  const Forest<Dim> f = uneven<Dim>(false);
  std::vector<char> chosen(static_cast<std::size_t>(f.n_blocks()), 0);
  for (std::size_t i = 0; i < f.leaves().size(); ++i)
    chosen[static_cast<std::size_t>(f.leaves()[i])] = ((i * 2654435761U) >> 7) % pick == 0;
  std::vector<char> expected = chosen, completed = chosen;
  for (const CoarseFace& face : f.coarse_faces()) {
    std::vector<int> finer;
    for (const int b : f.block(face.parent).child)
      if (f.block(b).neighbour[static_cast<std::size_t>(face_neighbour<Dim>(face.axis, 1 - face.side))] == coarser_neighbour)
        finer.push_back(b);
    const auto is_chosen = [&](int b) { return chosen[static_cast<std::size_t>(b)] != 0; };
    if (is_chosen(face.leaf) && std::any_of(finer.begin(), finer.end(), is_chosen))
      for (const int b : finer) expected[static_cast<std::size_t>(b)] = 1;
  }
  complete_jumps(f, completed);
  EXPECT_EQ(completed, expected);
  EXPECT_NE(completed, chosen);
}
TEST(ForestPart, JumpsBetweenChosenLeavesAreCompletedIn2D) { jumps_are_completed<2>(2); }
TEST(ForestPart, JumpsBetweenChosenLeavesAreCompletedIn3D) { jumps_are_completed<3>(3); }

template <int Dim>
void sides_are_cut_for_both(unsigned pick) {
  const Forest<Dim> f = uneven<Dim>(false);
  std::vector<char> chosen(static_cast<std::size_t>(f.n_blocks()), 0);
  for (std::size_t i = 0; i < f.leaves().size(); ++i)
    chosen[static_cast<std::size_t>(f.leaves()[i])] = ((i * 2654435761U) >> 7) % pick != 0;
  const auto part = make_part(f, chosen);
  int cut = 0;
  for (const int b : part.leaves)
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side) {
        const int nb = f.block(b).neighbour[static_cast<std::size_t>(face_neighbour<Dim>(axis, side))];
        cut += part.is_cut(b, axis, side);
        if (nb == no_block) {
          EXPECT_FALSE(part.is_cut(b, axis, side));
        }
        if (nb >= 0 && f.block(nb).leaf) {
          EXPECT_EQ(part.is_cut(b, axis, side), !chosen[static_cast<std::size_t>(nb)]);
        }
        if (nb < 0 || f.block(nb).leaf) continue;
        bool all = true;  // a jump is open for the coarse leaf and every fine one on it, or for none
        for (int c = 0; c < BlockShape<Dim>::children; ++c)
          if (((c >> axis) & 1) == 1 - side) all = all && chosen[static_cast<std::size_t>(f.block(nb).child[static_cast<std::size_t>(c)])];
        EXPECT_EQ(part.is_cut(b, axis, side), !all);
        for (int c = 0; c < BlockShape<Dim>::children; ++c) {
          const int child = f.block(nb).child[static_cast<std::size_t>(c)];
          if (((c >> axis) & 1) == 1 - side && chosen[static_cast<std::size_t>(child)]) {
            EXPECT_EQ(part.is_cut(child, axis, 1 - side), !all);
          }
        }
      }
  EXPECT_GT(cut, 0);
  // From outside, the same sides.
  std::set<std::array<int, 3>> rim;
  for (const LeafSide& side : part.rim) {
    EXPECT_FALSE(chosen[static_cast<std::size_t>(side.leaf)]);
    rim.insert({side.leaf, side.axis, side.side});
  }
  for (const int b : part.leaves)
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side) {
        const int nb = f.block(b).neighbour[static_cast<std::size_t>(face_neighbour<Dim>(axis, side))];
        if (nb >= 0 && f.block(nb).leaf && part.is_cut(b, axis, side)) {
          EXPECT_TRUE(rim.contains({nb, axis, 1 - side}));
        }
      }
}
TEST(ForestPart, BothLeavesOfASideSeeItCutIn2D) { sides_are_cut_for_both<2>(3); }
TEST(ForestPart, BothLeavesOfASideSeeItCutIn3D) { sides_are_cut_for_both<3>(4); }

}  // namespace
}  // namespace seaway::mesh
