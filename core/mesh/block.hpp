// A mesh block: N^Dim cells of one size. Blocks are the nodes of a forest of trees; its leaves carry the
// solution, its inner nodes (parents) carry restricted values and the coarse levels of the multigrid.
//
// Storage, for every field over every block (leaves and parents):
//   cell (i, j[, k])          at  block * cells + (k * N + j) * N + i,   i fastest
//   face of axis a            the same with N + 1 entries along axis a: face i lies on the lower side of cell i
// Faces between two blocks are stored by both (equal to rounding). No ghost layers are stored: kernels gather a
// block and its surroundings into a Scratch (core/field/scratch.hpp).
#pragma once

#include <array>

#include "core/base/vec.hpp"

namespace seaway::mesh {

template <int Dim>
struct BlockShape {
  static constexpr int n = Dim == 2 ? 16 : 8;  ///< cells along an edge; even
  static constexpr int cells = Dim == 2 ? n * n : n * n * n;
  static constexpr int faces = Dim == 2 ? (n + 1) * n : (n + 1) * n * n;  ///< of one axis
  static constexpr int children = 1 << Dim;
  static constexpr int neighbours = Dim == 2 ? 9 : 27;  ///< 3^Dim with the block itself in the middle
};

inline constexpr int no_block = -1;          ///< outside the tank
inline constexpr int coarser_neighbour = -2; ///< the neighbour there is one level coarser

/// Index into Block::neighbour of the face neighbour along `axis` (side 0: lower, 1: upper).
template <int Dim>
constexpr int face_neighbour(int axis, int side) {
  const int power[3] = {1, 3, 9};
  const int centre = Dim == 2 ? 4 : 13;
  return centre + (side == 0 ? -power[axis] : power[axis]);
}

template <int Dim>
struct Block {
  int level = 0;
  IVec<Dim> coord{};  ///< position in blocks of this level, from the tank's lower corner
  int parent = no_block;
  std::array<int, BlockShape<Dim>::children> child{};  ///< child c: bit a set = upper half along axis a
  /// Entry sum_a (offset_a + 1) 3^a for offsets -1, 0, 1: a block of the same level (leaf or parent),
  /// no_block or coarser_neighbour.
  std::array<int, BlockShape<Dim>::neighbours> neighbour{};
  bool leaf = true;
  Vec<Dim> origin;  ///< lower corner [m]
  Vec<Dim> h;       ///< cell edges [m]

  /// Centre of cell (i, j[, k]).
  Vec<Dim> cell_centre(const IVec<Dim>& c) const {
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = origin[a] + (c[a] + 0.5) * h[a];
    return x;
  }
  /// Centre of the face of `axis` on the lower side of cell (i, j[, k]).
  Vec<Dim> face_centre(const IVec<Dim>& c, int axis) const {
    Vec<Dim> x = cell_centre(c);
    x[axis] -= 0.5 * h[axis];
    return x;
  }
  double cell_volume() const { return h.prod(); }
  /// Face neighbour along `axis` (side 0: lower, 1: upper), as in `neighbour`.
  int across(int axis, int side) const { return neighbour[static_cast<std::size_t>(face_neighbour<Dim>(axis, side))]; }
};

}  // namespace seaway::mesh
