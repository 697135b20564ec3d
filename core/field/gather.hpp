// The ghost exchange: copies a block and `layers` (1 or 2) layers around it into a Scratch.
//   same level        copied (parents must hold restricted values, core/field/restrict.hpp)
//   coarser           linear interpolation from the coarse level with limited (minmod) slopes
//   outside the tank  mirrored; face values normal to the boundary as `BoundaryKind` says
// Thread-safe: reads fields, writes its own scratch.
#pragma once

#include "core/field/scratch.hpp"

namespace seaway::field {

/// What the normal velocity does outside a side of the tank.
enum class BoundaryKind {
  fixed,  ///< wall or prescribed: odd about the face's value
  open,   ///< pressure boundary: zero gradient
};

template <int Dim>
struct Boundaries {
  std::array<std::array<BoundaryKind, 2>, Dim> kind{};  ///< [axis][side], default fixed
};

template <class T, int Dim>
void gather_cells(const Forest<Dim>& forest, const CellField<T, Dim>& f, int b, int layers,
                  Scratch<T, Dim>& out);

template <class T, int Dim>
void gather_faces(const Forest<Dim>& forest, const FaceField<T, Dim>& f, int axis, int b, int layers,
                  const Boundaries<Dim>& boundaries, Scratch<T, Dim>& out);

}  // namespace seaway::field
