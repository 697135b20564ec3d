// Molecular stress, explicit:  u += dt / rho_f  div( mu grad u ),  mu = rho nu of the mixture, constant over
// each staggered volume. The hull and the tank's walls slip: the velocity extended into the hull
// carries no shear. Its limit dt < h^2 / (2 Dim nu) lies far above the advective one at model scale and is
// checked by the caller. The eddy viscosity of a turbulence model will be added to nu here.
#pragma once

#include "core/flow/flow_state.hpp"

namespace seaway::flow {

template <int Dim>
class Viscosity {
 public:
  Viscosity(const Forest<Dim>& forest, const FluidProperties& fluids, const Boundaries<Dim>& boundaries)
      : forest_(forest), fluids_(fluids), boundaries_(boundaries), u_new_(forest) {}
  /// Largest stable step on the finest cells [s].
  double step_limit() const;
  void apply(FlowState<Dim>& state, double dt);

 private:
  const Forest<Dim>& forest_;
  FluidProperties fluids_;
  Boundaries<Dim> boundaries_;
  FaceField<double, Dim> u_new_;
};

extern template class Viscosity<2>;
extern template class Viscosity<3>;

}  // namespace seaway::flow
