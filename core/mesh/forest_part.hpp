// Some leaves of a forest, to work on them alone: the leaves, their sides behind which the rest of the mesh lies, and
// what restriction (core/field/restrict.hpp) has to look at.
#pragma once

#include "core/mesh/forest.hpp"

namespace seaway::mesh {

/// A side of a leaf (0: lower, 1: upper along the axis).
struct LeafSide {
  int leaf = 0, axis = 0, side = 0;
};

template <int Dim>
struct ForestPart {
  std::vector<int> leaves;                  ///< in the order of Forest::leaves
  std::vector<unsigned char> cut_sides;     ///< by block: bit 2 axis + side where what lies behind is not all in the part
  std::vector<LeafSide> rim;                ///< sides of leaves outside the part behind which a leaf of it lies
  std::vector<int> parents;                 ///< Forest::interface_parents over the leaves, finest level first
  std::vector<CoarseFace> coarse_faces;     ///< those of Forest::coarse_faces with all their leaves in the part

  bool is_cut(int b, int axis, int side) const {
    return (cut_sides[static_cast<std::size_t>(b)] >> (2 * axis + side)) & 1;
  }
};

/// Chooses (by block) the leaves behind a side (0: lower, 1: upper along the axis) of a leaf.
template <int Dim>
void choose_behind(const Forest<Dim>& forest, int leaf, int axis, int side, std::vector<char>& chosen);

/// Adds to chosen leaves (by block), of each face between levels whose coarse leaf and some finer one are chosen, all finer
/// leaves. One pass: what it adds completes no further face.
template <int Dim>
void complete_jumps(const Forest<Dim>& forest, std::vector<char>& chosen);

/// The part made of the chosen leaves (by block).
template <int Dim>
ForestPart<Dim> make_part(const Forest<Dim>& forest, const std::vector<char>& chosen);

}  // namespace seaway::mesh
