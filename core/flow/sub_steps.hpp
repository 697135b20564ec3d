// How the transport of a step is divided. A few fast cells (a jet at an opening, air squeezed from a corner) must not make
// the whole mesh take many sub-steps: leaves that are faster than the limit, and those around them, take more of them.
#pragma once

#include "core/mesh/forest_part.hpp"

namespace seaway::flow {

template <int Dim>
struct SubStepPlan {
  int whole = 1;                    ///< sub-steps of the mesh
  int inner = 1;                    ///< of the region, in each of them
  std::vector<int> fast;            ///< leaves that are too fast for `whole` sub-steps; empty with inner = 1, as the following
  mesh::ForestPart<Dim> rest;       ///< all others
  mesh::ForestPart<Dim> region;     ///< the fast ones and a ring around them
  /// Water swept [m] that the fast leaves show their neighbours while these take the long sub-step, for want of a true one:
  /// the region is so wide that nothing which is kept depends on it, not even if it is no number.
  double unknown_flux = 0;
  int total() const { return whole * inner; }
};

/// Largest of the leaves' Courant numbers; NaN if one is.
double largest_courant(const std::vector<double>& courant);

/// The plan that advances the fewest leaves. `courant`: of each leaf over the whole step, in the order of Forest::leaves.
/// No leaf exceeds `limit` in a sub-step. `local`: whether a region may take more sub-steps than the rest.
template <int Dim>
SubStepPlan<Dim> plan_sub_steps(const mesh::Forest<Dim>& forest, const std::vector<double>& courant, double limit, bool local);

}  // namespace seaway::flow
