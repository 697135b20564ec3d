// The k-epsilon model of turbulence [launder1974]:
//   Dk/Dt = P - epsilon + (1/rho) div( rho (nu + nu_t) grad k ) - B
//   De/Dt = C_1 P_e epsilon/k - C_2 epsilon^2/k + (1/rho) div( rho (nu + nu_t / sigma_e) grad epsilon )
//   nu_t = C_mu k^2 / epsilon~,   P = min(nu_t p_0, 10 epsilon) [menter1994],   p_0 = 2 S:S
// `standard`: epsilon~ = epsilon, P_e = P. Under waves, where the flow is strained but does not rotate, nu_t then
// grows without bound. `stabilised` [larsen2018]: epsilon~ = epsilon max(1, lambda_2 (C_2/C_1) p_0/p_omega),
// p_omega = 2 W:W of the rotation, and P_e = C_mu k^2/epsilon p_0 as before: passive in shear, decay in waves.
// B = alpha nu_t N^2, N^2 = -(g/rho) d(rho)/dz: option, kills turbulence at the free surface [umlauf2003].
//
// k and epsilon live in FlowState and are carried by Advection. Positive by construction: sinks are implicit
// (second order Patankar steps [burchard2003], which leave a steady state where it is), diffusion is done in
// stages that keep the sign (super_steps.hpp). Nothing here limits the time step.
#pragma once

#include <span>

#include "core/flow/flow_state.hpp"

namespace seaway::flow {

namespace k_epsilon {
// launder1974
inline constexpr double c_mu = 0.09, c_1 = 1.44, c_2 = 1.92, sigma_k = 1.0, sigma_epsilon = 1.3;
inline constexpr double lambda_2 = 0.05;       // larsen2018
inline constexpr double buoyancy_alpha = 1.36; // umlauf2003, as used by larsen2018
inline constexpr double production_limit = 10; // menter1994
inline constexpr double largest_ratio = 1e5;   ///< nu_t over nu of water: beyond it something else is wrong
inline constexpr double smallest_tke = 1e-12, smallest_epsilon = 1e-14;  ///< [m2/s2], [m2/s3]
}  // namespace k_epsilon

struct TurbulenceSpec {
  enum class Model { none, standard, stabilised };
  Model model = Model::none;
  bool buoyancy = false;
  double tke = 1e-6;      ///< at the start and where waves come in [m2/s2]
  double epsilon = 1e-6;  ///< [m2/s3]
};

/// A cell next to a wall: there the law of the wall gives production and dissipation (hull_walls.hpp).
struct NearWallCell {
  int block = 0, cell = 0;
  double production = 0;   ///< P sqrt(k) [m3/s4]
  double dissipation = 0;  ///< epsilon / k^(3/2) [1/m]
};

template <int Dim>
class KEpsilon {
 public:
  KEpsilon(const Forest<Dim>& forest, const FluidProperties& fluids, const Boundaries<Dim>& boundaries,
           const TurbulenceSpec& spec);

  /// Sets k and epsilon of the state to the values of the spec everywhere.
  void initialise(FlowState<Dim>& state) const;
  /// Sources and diffusion over dt, for the velocities as they are. Before: parents restricted. After: to be
  /// followed by update_nu_t().
  void advance(FlowState<Dim>& state, double dt, std::span<const NearWallCell> walls);
  /// The eddy viscosity for k and epsilon as they are and the strain of the last advance(). Lifts both to their
  /// smallest values and restricts them.
  void update_nu_t(FlowState<Dim>& state);
  /// The same with the strain of the velocities as they are.
  void find_nu_t(FlowState<Dim>& state);
  const CellField<double, Dim>& nu_t() const { return nu_t_; }  ///< [m2/s]
  const TurbulenceSpec& spec() const { return spec_; }

 private:
  void find_strain(const FlowState<Dim>& state);
  void diffuse(const FlowState<Dim>& state, double dt, double sigma, const CellField<double, Dim>& from,
               CellField<double, Dim>& to);
  double diffusion_limit(const FlowState<Dim>& state) const;
  void add_sources(FlowState<Dim>& state, double dt);
  void add_wall_sources(FlowState<Dim>& state, double dt, std::span<const NearWallCell> walls);

  const Forest<Dim>& forest_;
  FluidProperties fluids_;
  Boundaries<Dim> boundaries_;
  TurbulenceSpec spec_;
  CellField<double, Dim> nu_t_;
  CellField<double, Dim> strain_;      ///< p_0 [1/s2]
  CellField<double, Dim> damping_;     ///< epsilon~ / epsilon
  CellField<double, Dim> buoyancy_;    ///< N^2 [1/s2]; empty without the option
  CellField<double, Dim> diffused_k_, diffused_epsilon_, stage_;
};

extern template class KEpsilon<2>;
extern template class KEpsilon<3>;

}  // namespace seaway::flow
