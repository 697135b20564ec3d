#include "core/mesh/forest_part.hpp"

namespace seaway::mesh {
namespace {

/// Offset -1, 0, 1 along an axis of an entry of Block::neighbour.
constexpr int offset_of(int entry, int axis) {
  constexpr int power[3] = {1, 3, 9};
  return entry / power[axis] % 3 - 1;
}

/// The leaf one level coarser behind an entry of `neighbour` that says so.
template <int Dim>
int coarser_leaf(const Forest<Dim>& forest, const Block<Dim>& block, int entry) {
  constexpr int power[3] = {1, 3, 9};
  int at = 0;
  for (int a = 0; a < Dim; ++a) {
    const int half = block.coord[a] & 1, moved = half + offset_of(entry, a);  // in halves of the parent, -1 .. 2
    at += ((moved < 0 ? -1 : moved / 2) + 1) * power[a];
  }
  return forest.block(block.parent).neighbour[static_cast<std::size_t>(at)];
}

/// f(child) for the children of `parent` that lie on its side (0: lower, 1: upper) along `axis`.
template <int Dim, class F>
void for_children_at(const Block<Dim>& parent, int axis, int side, F&& f) {
  for (int c = 0; c < BlockShape<Dim>::children; ++c)
    if (((c >> axis) & 1) == side) f(parent.child[static_cast<std::size_t>(c)]);
}

/// Whether everything behind a side of a leaf is chosen, as the leaf sees it.
template <int Dim>
bool goes_on(const Forest<Dim>& forest, const std::vector<char>& chosen, int b, int axis, int side) {
  const Block<Dim>& block = forest.block(b);
  const int entry = face_neighbour<Dim>(axis, side);
  const int nb = block.neighbour[static_cast<std::size_t>(entry)];
  if (nb == no_block) return true;
  if (nb == coarser_neighbour) {  // and the coarse leaf must see this side so too: one answer for all finer leaves there
    const int coarse = coarser_leaf(forest, block, entry);
    return chosen[static_cast<std::size_t>(coarse)] && goes_on(forest, chosen, coarse, axis, 1 - side);
  }
  const Block<Dim>& beside = forest.block(nb);
  if (beside.leaf) return chosen[static_cast<std::size_t>(nb)] != 0;
  bool all = true;
  for_children_at(beside, axis, 1 - side, [&](int child) { all = all && chosen[static_cast<std::size_t>(child)]; });
  return all;
}

/// Whether anything behind a side of a leaf is chosen.
template <int Dim>
bool touches_chosen(const Forest<Dim>& forest, const std::vector<char>& chosen, int b, int axis, int side) {
  const int entry = face_neighbour<Dim>(axis, side);
  const int nb = forest.block(b).neighbour[static_cast<std::size_t>(entry)];
  if (nb == no_block) return false;
  if (nb == coarser_neighbour) return chosen[static_cast<std::size_t>(coarser_leaf(forest, forest.block(b), entry))] != 0;
  if (forest.block(nb).leaf) return chosen[static_cast<std::size_t>(nb)] != 0;
  bool any = false;
  for_children_at(forest.block(nb), axis, 1 - side, [&](int child) { any = any || chosen[static_cast<std::size_t>(child)]; });
  return any;
}

}  // namespace

template <int Dim>
void choose_behind(const Forest<Dim>& forest, int leaf, int axis, int side, std::vector<char>& chosen) {
  const int entry = face_neighbour<Dim>(axis, side);
  const int nb = forest.block(leaf).neighbour[static_cast<std::size_t>(entry)];
  if (nb == no_block) return;
  if (nb == coarser_neighbour) {
    chosen[static_cast<std::size_t>(coarser_leaf(forest, forest.block(leaf), entry))] = 1;
  } else if (forest.block(nb).leaf) {
    chosen[static_cast<std::size_t>(nb)] = 1;
  } else {
    for_children_at(forest.block(nb), axis, 1 - side, [&](int child) { chosen[static_cast<std::size_t>(child)] = 1; });
  }
}

template <int Dim>
void complete_jumps(const Forest<Dim>& forest, std::vector<char>& chosen) {
  const std::vector<char> before = chosen;
  for (const CoarseFace& face : forest.coarse_faces()) {
    if (!before[static_cast<std::size_t>(face.leaf)]) continue;
    bool any = false;
    const auto look = [&](int child) { any = any || before[static_cast<std::size_t>(child)]; };
    for_children_at(forest.block(face.parent), face.axis, 1 - face.side, look);
    if (!any) continue;
    for_children_at(forest.block(face.parent), face.axis, 1 - face.side,
                    [&](int child) { chosen[static_cast<std::size_t>(child)] = 1; });
  }
}

template <int Dim>
ForestPart<Dim> make_part(const Forest<Dim>& forest, const std::vector<char>& chosen) {
  ForestPart<Dim> part;
  const auto n_blocks = static_cast<std::size_t>(forest.n_blocks());
  part.cut_sides.assign(n_blocks, 0);
  std::vector<char> above(n_blocks, 0);  // ancestors of the leaves
  for (const int b : forest.leaves()) {
    if (!chosen[static_cast<std::size_t>(b)]) {
      for (int axis = 0; axis < Dim; ++axis)
        for (int side = 0; side < 2; ++side)
          if (touches_chosen(forest, chosen, b, axis, side)) part.rim.push_back({b, axis, side});
      continue;
    }
    part.leaves.push_back(b);
    for (int up = forest.block(b).parent; up >= 0 && !above[static_cast<std::size_t>(up)]; up = forest.block(up).parent)
      above[static_cast<std::size_t>(up)] = 1;
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side)
        if (!goes_on(forest, chosen, b, axis, side))
          part.cut_sides[static_cast<std::size_t>(b)] |= static_cast<unsigned char>(1 << (2 * axis + side));
  }
  for (const int p : forest.interface_parents())
    if (above[static_cast<std::size_t>(p)]) part.parents.push_back(p);
  for (const CoarseFace& face : forest.coarse_faces())
    if (chosen[static_cast<std::size_t>(face.leaf)] && !part.is_cut(face.leaf, face.axis, face.side)) part.coarse_faces.push_back(face);
  return part;
}

template void choose_behind<2>(const Forest<2>&, int, int, int, std::vector<char>&);
template void choose_behind<3>(const Forest<3>&, int, int, int, std::vector<char>&);
template void complete_jumps<2>(const Forest<2>&, std::vector<char>&);
template void complete_jumps<3>(const Forest<3>&, std::vector<char>&);
template ForestPart<2> make_part<2>(const Forest<2>&, const std::vector<char>&);
template ForestPart<3> make_part<3>(const Forest<3>&, const std::vector<char>&);

}  // namespace seaway::mesh
