// New blocks that need no interpolation: kept leaves are copied bit by bit, leaves that replace finer ones
// get means (cells: of the cells inside, faces: of the faces on them), which conserves volumes and fluxes.
// Loops over leaves run on the new forest's threads; the number of threads changes no bit.
#pragma once

#include "core/field/field.hpp"
#include "core/transfer/mesh_pair.hpp"

namespace seaway::transfer {

using field::CellField;
using field::FaceField;

/// Fills the kept and the coarsened leaves of `out` (a field over `to`) from `in` (over `from`).
template <int Dim>
void copy_or_coarsen(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
                     const CellField<double, Dim>& in, CellField<double, Dim>& out);
template <int Dim>
void copy_or_coarsen(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
                     const FaceField<double, Dim>& in, FaceField<double, Dim>& out);

}  // namespace seaway::transfer
