// How the transport of a step is divided. A few fast cells (a jet at an opening, air squeezed from a corner) must not make
// the whole mesh take many sub-steps: leaves that are faster than the limit, and those around them, take more of them.
#pragma once

#include "core/mesh/forest_part.hpp"

namespace seaway::flow {

template <int Dim>
struct SubStepPlan {
  int whole = 1;                    ///< sub-steps of the mesh
  int inner = 1;                    ///< of the region, in each of them
  std::vector<int> slow;            ///< leaves that are not too fast for `whole` sub-steps; with inner > 1 only
  std::vector<int> fast;            ///< the others
  mesh::ForestPart<Dim> region;     ///< the fast ones and those around them; empty with inner = 1
  int total() const { return whole * inner; }
};

/// Largest of the leaves' Courant numbers; NaN if one is.
double largest_courant(const std::vector<double>& courant);

/// The plan that advances the fewest leaves. `courant`: of each leaf over the whole step, in the order of Forest::leaves.
/// No leaf exceeds `limit` in a sub-step. `local`: whether a region may take more sub-steps than the rest.
template <int Dim>
SubStepPlan<Dim> plan_sub_steps(const mesh::Forest<Dim>& forest, const std::vector<double>& courant, double limit, bool local);

}  // namespace seaway::flow
