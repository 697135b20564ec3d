// Fine to coarse: parents get means of their children, and a coarse leaf's face towards finer blocks gets
// the mean of the fine faces on it, so that what leaves one side enters the other.
#pragma once

#include "core/field/field.hpp"
#include "core/mesh/forest_part.hpp"

namespace seaway::field {

/// Parents that a leaf or its ghosts may read (Forest::interface_parents).
template <class T, int Dim>
void restrict_cells(const Forest<Dim>& forest, CellField<T, Dim>& f);

/// Those above the leaves of a part alone.
template <class T, int Dim>
void restrict_cells(const Forest<Dim>& forest, const mesh::ForestPart<Dim>& part, CellField<T, Dim>& f);

/// The same for faces of one axis, then the coarse leaves' faces at level jumps.
template <class T, int Dim>
void restrict_faces(const Forest<Dim>& forest, FaceField<T, Dim>& f, int axis);
template <class T, int Dim>
void restrict_faces(const Forest<Dim>& forest, const mesh::ForestPart<Dim>& part, FaceField<T, Dim>& f, int axis);
template <class T, int Dim>
void restrict_faces(const Forest<Dim>& forest, FaceField<T, Dim>& f) {
  for (int axis = 0; axis < Dim; ++axis) restrict_faces(forest, f, axis);
}

}  // namespace seaway::field
