// How the transport of a step is divided. A few fast cells (a jet at an opening, air squeezed from a corner) must not make
// the whole mesh take many sub-steps: leaves that are faster than the limit, and those whose neighbours are so near the
// common side, take more of them.
#pragma once

#include <array>

#include "core/mesh/forest_part.hpp"

namespace seaway::flow {

/// Cells from a leaf's side that a sweep behind that side looks at.
inline constexpr int courant_margin = 2;

/// Largest Courant numbers sum_d |w_d| dt / h_d in a leaf.
template <int Dim>
struct LeafCourant {
  double largest = 0;                         ///< of all its cells; NaN where w is not finite
  std::array<double, 2 * Dim> near_side{};    ///< of its cells within courant_margin of a side
  double& at_side(int axis, int side) { return near_side[static_cast<std::size_t>(2 * axis + side)]; }
  double at_side(int axis, int side) const { return near_side[static_cast<std::size_t>(2 * axis + side)]; }
};

template <int Dim>
struct SubStepPlan {
  int whole = 1;                    ///< sub-steps of the mesh
  int inner = 1;                    ///< of the region, in each of them
  /// Leaves that are too fast for `whole` sub-steps, and the neighbours behind sides near which they are; empty with inner = 1.
  mesh::ForestPart<Dim> region;
  int total() const { return whole * inner; }
};

/// Largest of the leaves' Courant numbers; NaN if one is.
template <int Dim>
double largest_courant(const std::vector<LeafCourant<Dim>>& courant);

/// The plan that advances the fewest leaves. `courant`: of each leaf over the whole step, in the order of Forest::leaves.
/// No leaf exceeds `limit` in a sub-step. `local`: whether a region may take more sub-steps than the rest.
template <int Dim>
SubStepPlan<Dim> plan_sub_steps(const mesh::Forest<Dim>& forest, const std::vector<LeafCourant<Dim>>& courant, double limit,
                                bool local);

}  // namespace seaway::flow
