// The published interpolation (core/transfer/prbf.hpp) between two forests. The centres of all old leaf cells
// are one set of points, the faces of each axis another (each face once, the finer ones where sizes meet), in
// physical coordinates.
#pragma once

#include "core/transfer/flow_fields.hpp"
#include "core/transfer/mesh_pair.hpp"
#include "core/transfer/prbf.hpp"

namespace seaway::transfer {

/// Overwrites values of `out`, which a local method has filled, with interpolants of `in`: with
/// options.evaluate_all in all leaves, as published, else only in leaves that are not kept. The volume
/// fraction only if `with_vof`, clipped to 0..1, which does not conserve the water.
///
/// Not overwritten: faces on the tank's sides and, when only new leaves are evaluated, faces shared with kept
/// ones, so that the net flux through the tank, or through the new cells, stays what it was and a projection
/// can make w solenoidal. Two blocks that share a face hold the same bits; parents are not restricted.
template <int Dim>
PrbfReport prbf_flow(const PrbfOptions& options, const Forest<Dim>& from, const Forest<Dim>& to,
                     const MeshPair<Dim>& pair, bool with_vof, const FlowFields<Dim>& in,
                     FlowFields<Dim>& out);

}  // namespace seaway::transfer
