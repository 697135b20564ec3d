// Interface and momentum carried by the mixture velocity w, together: one set of mass fluxes for both.
//
// Volume fraction: directional sweeps with geometric fluxes and the dilation term of weymouth2010, which keeps
// 0 <= vof <= 1 to rounding for sum_d |w_d| dt / h_d <= 1/2 and solenoidal w. Momentum: the staggered control
// volume takes half of each neighbour cell, its mass fluxes are the means of theirs, so that
//   m' u' = m u - d(F u_upwind) + (m' - m + dF) u0
// with m, m' the averaged cell masses before and after the sweep, F the mass flux, u0 the velocity before the
// sub-step; u_upwind is second order with the van Leer limiter [vanleer1979]. A uniform velocity stays uniform
// exactly. Where local sub-steps overdraw a volume, u' is kept in its neighbours' range (scalar_sweep.hpp). At coarse-fine faces the fine fluxes count and ghosts are interpolated (first order).
// Turbulent energy and dissipation, where the state has them, go with the same mass fluxes (scalar_sweep.hpp).
#pragma once

#include "core/flow/interface_planes.hpp"
#include "core/flow/scalar_sweep.hpp"
#include "core/flow/sub_steps.hpp"

namespace seaway::flow {

template <int Dim>
class Advection {
 public:
  Advection(const Forest<Dim>& forest, const FluidProperties& fluids, const Boundaries<Dim>& boundaries);

  /// Of each leaf, in the order of Forest::leaves.
  std::vector<LeafCourant<Dim>> courant_numbers(const FaceField<double, Dim>& w, double dt) const;
  /// Over all cells.
  double courant_number(const FaceField<double, Dim>& w, double dt) const;

  /// One sub-step of vof and u with frozen w. `step` alternates the order of the sweeps.
  /// Before: parents of vof, u, w restricted; courant_number <= 1/2. After: the same parents restricted.
  void advance(FlowState<Dim>& state, double dt, std::int64_t step);
  /// A volume fraction beyond [0, 1] that was cut: volume is what the mesh has less since [m^Dim].
  struct Clip {
    std::int64_t cell = 0;  ///< block * cells + cell
    Vec<Dim> centre;
    double volume = 0;
  };
  /// One sub-step of `plan` (plan.whole of them make the step): the leaves of plan.region take plan.inner shorter ones.
  /// What passes the region's sides is the water that the rest of the mesh saw pass, in equal shares; the difference in
  /// time may push volume fractions there out of [0, 1], which is cut and returned. Momentum is conserved to first order in dt.
  std::vector<Clip> advance(FlowState<Dim>& state, double dt, std::int64_t step, const SubStepPlan<Dim>& plan);

  /// Called after each sweep, or sub-step, with the axis: water swept through its faces in it [m] (volume per face
  /// area, positive along the axis), coarse faces included. For books of water volume.
  using FluxVisitor = std::function<void(int axis, const FaceField<double, Dim>& swept)>;
  void set_flux_visitor(FluxVisitor visitor) { visitor_ = std::move(visitor); }

  InterfacePlanes<Dim>& planes() { return planes_; }

 private:
  /// The leaves that a sweep advances: all of them, or those of a part, through whose cut sides goes a share of recorded_.
  struct Scope {
    const std::vector<int>& leaves;
    const mesh::ForestPart<Dim>* part = nullptr;
    double share = 0;
    bool is_closed(int b, int axis, int side) const { return part && part->is_cut(b, axis, side); }
    bool has_closed_sides(int b) const { return part && part->cut_sides[static_cast<std::size_t>(b)] != 0; }
  };
  /// Wholly water or air, like all around it: nothing to reconstruct.
  bool is_pure(const Scope& scope, int b) const {
    return planes_.surroundings(b) != BlockPhase::mixed && !scope.has_closed_sides(b);
  }
  void water_fluxes(const Scope& scope, const FlowState<Dim>& state, int axis, double dt);
  void update_vof(const Scope& scope, const FlowState<Dim>& state, int axis, double dt);
  void update_momentum(const Scope& scope, const FlowState<Dim>& state, int axis, double dt);
  void start_from(const FlowState<Dim>& state);
  /// All leaves; those of a region that is to be advanced again are held (bound_region, stop_region).
  void sweep(const FlowState<Dim>& state, int axis, double dt, const mesh::ForestPart<Dim>* region = nullptr);
  void take_new(FlowState<Dim>& state);
  // Local sub-steps (local_advection.cpp).
  void advance_around(FlowState<Dim>& state, double dt, std::int64_t step, const mesh::ForestPart<Dim>& region);
  void bound_region(const mesh::ForestPart<Dim>& region);
  void stop_region(const FlowState<Dim>& state, const mesh::ForestPart<Dim>& region);
  void sweep_region(FlowState<Dim>& state, int axis, double dt, const SubStepPlan<Dim>& plan);
  void approach_sides(FlowState<Dim>& state, int steps_left, const mesh::ForestPart<Dim>& region) const;
  void record(int axis, const mesh::ForestPart<Dim>& region);
  std::vector<Clip> clip(FlowState<Dim>& state, const std::vector<int>& leaves) const;
  void hold(FlowState<Dim>& state);

  const Forest<Dim>& forest_;
  FluidProperties fluids_;
  Boundaries<Dim> boundaries_;
  InterfacePlanes<Dim> planes_;
  FaceField<double, Dim> swept_;
  CellField<double, Dim> vof_new_, vof_start_;
  FaceField<double, Dim> u_start_, u_new_;
  std::array<CellField<double, Dim>, 2> carried_start_, carried_new_;  ///< tke, epsilon; empty without them
  FluxVisitor visitor_;
  FaceField<double, Dim> recorded_;  ///< water swept in the sub-step of the whole mesh; empty until one is divided
  CellField<double, Dim> held_vof_;  ///< at its end, likewise
  FaceField<double, Dim> held_u_;
  std::array<CellField<double, Dim>, 2> held_carried_;
};

extern template class Advection<2>;
extern template class Advection<3>;

}  // namespace seaway::flow
