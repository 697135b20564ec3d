// Makes the mixture velocity solenoidal and finds pressure and hull velocity together:
//
//   [ A + J M^-1 J^T ] p = -(1/dt) ( sum_f s_f A_f w*_f ),    u_f = u*_f - dt (p_R - p_L) / (rho_f d_f),
//   V = V* + dt M^-1 sum_c J_c p_c
//
// (docs/numerics.md). The same J carries the hull's velocity into the flow and the pressure onto the hull, so
// the coupling conserves energy and has no added-mass limit.
#pragma once

#include "core/flow/flow_state.hpp"
#include "core/flow/hull_mask.hpp"
#include "core/flow/slip_flux.hpp"
#include "core/linear/conjugate_gradient.hpp"

namespace seaway::flow {

struct ProjectionOptions {
  double tolerance = 1e-5;   ///< largest dt |div w|
  int max_iterations = 200;
};

template <int Dim>
class Projection {
 public:
  Projection(const Forest<Dim>& forest, const FluidProperties& fluids, const Boundaries<Dim>& boundaries);

  /// u += dt g. On faces between equal cells the weight of the column; on coarse-fine faces the force that
  /// balances a surface at rest exactly, whatever the offset of the two centres.
  void apply_gravity(FlowState<Dim>& state, double dt) const;

  /// Coefficients for the density and the apertures of the half-step geometry (no mask: all open).
  /// `free_cells` (by global cell, optional): only faces between two marked cells may change.
  void prepare(const FlowState<Dim>& state, const HullMask<Dim>* mask,
               const std::vector<char>* free_cells = nullptr);

  /// Rows of the hull in the half-step geometry of the last prepare; empty without a mask.
  const linear::RigidRows<Dim>& rigid_rows() const { return operator_.rigid(); }

  /// After prepare: projects state.u with the hull's twist (both changed), sets state.p and state.w. `slip` (optional)
  /// is part of w.
  /// Boundary values of u on fixed sides are kept. Parents of u, w, p restricted on return.
  linear::SolveReport project(FlowState<Dim>& state, const HullMask<Dim>* mask, motion::Twist<Dim>& twist,
                              const motion::DofMatrix<Dim>& inverse_mass, double dt,
                              const ProjectionOptions& options, const SlipFlux<Dim>* slip = nullptr);

  /// After prepare with the same free_cells (null: all free): makes state.w solenoidal by changing only what
  /// may change, u along with it; the pressure is left alone. What a closed set of free cells had in sum
  /// stays, spread evenly. On closed faces of free cells w becomes the hull's own velocity first.
  linear::SolveReport repair(FlowState<Dim>& state, const HullMask<Dim>* mask, const motion::Twist<Dim>& twist,
                             const std::vector<char>* free_cells, double dt, const ProjectionOptions& options);

  /// w of (u, twist) on all faces, parents restricted.
  void mixture_velocity(FlowState<Dim>& state, const HullMask<Dim>* mask, const motion::Twist<Dim>& twist,
                        const SlipFlux<Dim>* slip = nullptr) const;
  /// Largest dt |div w|.
  double divergence(const FlowState<Dim>& state, double dt) const;

 private:
  void close_kept_faces(const std::vector<char>& free_cells);
  void remove_region_means();
  void right_side(const FlowState<Dim>& state, double dt, CellField<double, Dim>& b) const;
  void correct(FlowState<Dim>& state, const CellField<double, Dim>& p, double dt, bool mixture_too) const;
  const Forest<Dim>& forest_;
  FluidProperties fluids_;
  Boundaries<Dim> boundaries_;
  linear::PoissonOperator<Dim> operator_;
  linear::Multigrid<Dim> multigrid_;
  linear::ConjugateGradient<Dim> cg_;
  CellField<double, Dim> rhs_;
  FaceField<float, Dim> aperture_;
  std::vector<int> masked_blocks_;  ///< where aperture_ may differ from 1
  bool closed_ = true;              ///< no open side: the pressure is known up to a constant
};

extern template class Projection<2>;
extern template class Projection<3>;

}  // namespace seaway::flow
