// The ghost exchange: copies a block and `layers` (1 or 2) layers around it into a Scratch.
//   same level        copied (parents must hold restricted values, core/field/restrict.hpp)
//   coarser           linear interpolation from the coarse level with limited (minmod) slopes
//   outside the tank  mirrored; face values normal to the boundary as `BoundaryKind` says, those along it odd
//                     about the wall's velocity where the fluid sticks to it
// A kernel that needs less than the whole surroundings says so by a Neighbourhood: what it leaves out is
// not filled. Thread-safe: reads fields, writes its own scratch.
#pragma once

#include <cstdint>

#include "core/field/scratch.hpp"

namespace seaway::field {

/// What the normal velocity does outside a side of the tank.
enum class BoundaryKind {
  fixed,  ///< wall or prescribed: odd about the face's value
  open,   ///< pressure boundary: zero gradient
};

/// What the velocity along a side of the tank does there.
template <int Dim>
struct SideWall {
  bool no_slip = false;                    ///< false: zero gradient
  Vec<Dim> velocity = Vec<Dim>::Zero();    ///< no_slip: of the wall along itself [m/s]
};

template <int Dim>
struct Boundaries {
  std::array<std::array<BoundaryKind, 2>, Dim> kind{};  ///< [axis][side], default fixed
  std::array<std::array<SideWall<Dim>, 2>, Dim> wall{};
};

/// Neighbours to gather from, one bit an entry of Block::neighbour (the block itself always counts).
using Neighbourhood = std::uint32_t;
inline constexpr Neighbourhood all_neighbours = ~Neighbourhood{0};

/// The two beside the block along an axis.
template <int Dim>
constexpr Neighbourhood beside(int axis) {
  return Neighbourhood{1} << mesh::face_neighbour<Dim>(axis, 0) |
         Neighbourhood{1} << mesh::face_neighbour<Dim>(axis, 1);
}
/// All that share a face with the block.
template <int Dim>
constexpr Neighbourhood face_neighbours() {
  Neighbourhood set = 0;
  for (int a = 0; a < Dim; ++a) set |= beside<Dim>(a);
  return set;
}
/// Those that share a face with the block, or an edge with an offset along `axis` (2-D: a corner).
template <int Dim>
constexpr Neighbourhood around_axis(int axis) {
  Neighbourhood set = face_neighbours<Dim>();
  constexpr std::array<int, 3> power{1, 3, 9};
  constexpr int centre = BlockShape<Dim>::neighbours / 2;
  for (int a = 0; a < Dim; ++a) {
    if (a == axis) continue;
    const int along = power[static_cast<std::size_t>(axis)], across = power[static_cast<std::size_t>(a)];
    for (const int e : {along + across, along - across, -along + across, -along - across})
      set |= Neighbourhood{1} << (centre + e);
  }
  return set;
}

template <class T, int Dim>
void gather_cells(const Forest<Dim>& forest, const CellField<T, Dim>& f, int b, int layers,
                  Scratch<T, Dim>& out, Neighbourhood from = all_neighbours);

template <class T, int Dim>
void gather_faces(const Forest<Dim>& forest, const FaceField<T, Dim>& f, int axis, int b, int layers,
                  const Boundaries<Dim>& boundaries, Scratch<T, Dim>& out, Neighbourhood from = all_neighbours);

}  // namespace seaway::field
