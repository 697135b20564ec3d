// The baseline: multilinear interpolation between the 2^Dim lattice points around each target, with weights
// that are products of (1 - distance). Convex, so bounded by its points. Where a point lies outside the tank
// (targets next to a wall) linear least squares over the points that are there extrapolate.
#pragma once

#include "core/transfer/stencil.hpp"

namespace seaway::transfer {

template <int Dim>
WeightRule<Dim> linear_rule();

}  // namespace seaway::transfer
