// Viscous stress:
//   u += dt / rho_f  div( mu_e (grad u + grad u^T) ),   mu_e = rho (nu + nu_t),
// on edges the harmonic mean of rho of the cells around times the mean of their nu + nu_t: no light volume feels
// the viscosity of the water beside it, and what one volume loses its neighbour gains. No limit on the step: one
// longer than the explicit limit is taken in stages (super_steps.hpp). The hull slips here (the velocity extended
// into it carries no shear; its friction is hull_walls.hpp), the tank's sides as Boundaries say.
#pragma once

#include "core/flow/flow_state.hpp"

namespace seaway::flow {

template <int Dim>
class Viscosity {
 public:
  Viscosity(const Forest<Dim>& forest, const FluidProperties& fluids, const Boundaries<Dim>& boundaries)
      : forest_(forest), fluids_(fluids), boundaries_(boundaries), u_new_(forest) {}
  /// Largest step that one stage takes with molecular viscosity alone, beside a surface too [s].
  double step_limit() const;
  /// `nu_t`: eddy viscosity [m2/s], parents restricted; null: none. Returns the number of stages.
  int apply(FlowState<Dim>& state, double dt, const CellField<double, Dim>* nu_t = nullptr);

 private:
  struct Stage {
    double dt, previous, before;
    bool first;
  };
  double explicit_limit(const FlowState<Dim>& state, const CellField<double, Dim>& nu_t) const;
  void take_stage(const FlowState<Dim>& state, const Stage& stage, const CellField<double, Dim>* nu_t);
  void stress_in(int b, const Stage& stage, const std::array<field::Scratch<double, Dim>, Dim>& u, field::Scratch<double, Dim>& rho,
                 field::Scratch<double, Dim>& nu);
  void uniform_stress_in(int b, const Stage& stage, const std::array<field::Scratch<double, Dim>, Dim>& u, double nu);
  void keep_fixed_sides(const FlowState<Dim>& state, int axis, int b);

  const Forest<Dim>& forest_;
  FluidProperties fluids_;
  Boundaries<Dim> boundaries_;
  FaceField<double, Dim> u_new_;
};

extern template class Viscosity<2>;
extern template class Viscosity<3>;

}  // namespace seaway::flow
