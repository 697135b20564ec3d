// Volume fractions of newly refined cells: each mixed coarse cell's interface plane is cut by its children
// (core/flow/plic.hpp). Sharper by one to two orders than any interpolation, always in [0, 1], and the
// children's mean is the coarse value to rounding, so the water volume is conserved.
//
// Meant for an interface one cell wide. One that is smeared over several cells is sharpened; use
// interpolation with bounds there (VofMethod::bounded of core/transfer/map_flow.hpp).
#pragma once

#include "core/transfer/refine.hpp"

namespace seaway::transfer {

/// Fills the refined leaves of `out`, at most one level below their source. Parents of `in` must hold
/// restricted values.
template <int Dim>
void split_vof(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
               const CellField<double, Dim>& in, CellField<double, Dim>& out);

/// Fractions of the 2^Dim children of a cell with fraction `vof`, whose neighbourhood (3^Dim fractions, axis
/// 0 fastest) gives the plane's direction. Children are in [0, 1]; their mean is `vof` to rounding.
template <int Dim>
void split_cell(double vof, const double* stencil, double* children);

}  // namespace seaway::transfer
