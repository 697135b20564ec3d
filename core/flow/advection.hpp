// Interface and momentum carried by the mixture velocity w, together: one set of mass fluxes for both.
//
// Volume fraction: directional sweeps with geometric fluxes and the dilation term of weymouth2010, which keeps
// 0 <= vof <= 1 to rounding for sum_d |w_d| dt / h_d <= 1/2 and solenoidal w. Momentum: the staggered control
// volume takes half of each neighbour cell, its mass fluxes are the means of theirs, so that
//   m' u' = m u - d(F u_upwind) + (m' - m + dF) u0
// with m, m' the averaged cell masses before and after the sweep, F the mass flux, u0 the velocity before the
// sub-step; u_upwind is second order with the van Leer limiter [vanleer1979]. A uniform velocity stays uniform
// exactly. At coarse-fine faces the fine fluxes count and ghosts are interpolated (first order).
// Turbulent energy and dissipation, where the state has them, go with the same mass fluxes (scalar_sweep.hpp).
#pragma once

#include "core/flow/interface_planes.hpp"
#include "core/flow/scalar_sweep.hpp"

namespace seaway::flow {

template <int Dim>
class Advection {
 public:
  Advection(const Forest<Dim>& forest, const FluidProperties& fluids, const Boundaries<Dim>& boundaries);

  /// Largest sum_d |w_d| dt / h_d over all cells.
  double courant_number(const FaceField<double, Dim>& w, double dt) const;

  /// One sub-step of vof and u with frozen w. `step` alternates the order of the sweeps.
  /// Before: parents of vof, u, w restricted; courant_number <= 1/2. After: the same parents restricted.
  void advance(FlowState<Dim>& state, double dt, std::int64_t step);

  /// Called after each sweep with the axis: water swept through its faces in this sweep [m] (volume per
  /// face area, positive along the axis), coarse faces included. For books of water volume.
  using FluxVisitor = std::function<void(int axis, const FaceField<double, Dim>& swept)>;
  void set_flux_visitor(FluxVisitor visitor) { visitor_ = std::move(visitor); }

  InterfacePlanes<Dim>& planes() { return planes_; }

 private:
  void water_fluxes(const FlowState<Dim>& state, int axis, double dt);
  void update_vof(const FlowState<Dim>& state, int axis, double dt);
  void update_momentum(const FlowState<Dim>& state, int axis, double dt);

  const Forest<Dim>& forest_;
  FluidProperties fluids_;
  Boundaries<Dim> boundaries_;
  InterfacePlanes<Dim> planes_;
  FaceField<double, Dim> swept_;
  CellField<double, Dim> vof_new_, vof_start_;
  FaceField<double, Dim> u_start_, u_new_;
  std::array<CellField<double, Dim>, 2> carried_start_, carried_new_;  ///< tke, epsilon; empty without them
  FluxVisitor visitor_;
};

extern template class Advection<2>;
extern template class Advection<3>;

}  // namespace seaway::flow
