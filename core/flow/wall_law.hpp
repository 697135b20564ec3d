// The law of the wall: shear stress from the velocity along a smooth wall at a distance from it.
//   u+ = y+                     y+ <= 11.225
//   u+ = ln(E y+) / kappa       beyond [launder1974]
// and its form with the pressure gradient along the wall [kim1995].
#pragma once

namespace seaway::flow::wall_law {

inline constexpr double kappa = 0.4187, smoothness = 9.793;  // launder1974 (E)
inline constexpr double sublayer = 11.225;                   ///< y+ where the two branches meet

/// sqrt(tau_w / rho) [m/s] for speed u >= 0 [m/s] at distance y [m], kinematic viscosity nu [m2/s].
double friction_velocity(double u, double y, double nu);

/// tau_w / rho [m2/s2] of kim1995:  U~ c k^(1/2) / (tau_w / rho) = ln(E y*) / kappa,  c = C_mu^(1/4),  with
///   U~ = u - 1/2 (dp/ds)/rho [ y_v/(kappa k^(1/2)) ln(y/y_v) + (y - y_v)/(kappa k^(1/2)) + y_v^2/nu ],
/// y* = c k^(1/2) y / nu, y_v = 11.225 nu / (c k^(1/2)). `gradient`: dp/ds / rho along u, without the weight
/// [m/s2]. Never negative: where U~ < 0 the flow has separated and there is no stress. Within the sublayer
/// (y* < 11.225) nu u / y.
double sensitised_stress(double u, double y, double nu, double k, double gradient);

/// Of a cell at a wall: epsilon = dissipation k^(3/2) and P = production / k^(1/2).
struct Sources {
  double production = 0;   ///< [m3/s4]
  double dissipation = 0;  ///< [1/m]
};
/// From the log law at the distance y: P = tau^2 / (kappa c k^(1/2) y), epsilon = C_mu^(3/4) k^(3/2) / (kappa y).
Sources equilibrium_sources(double stress, double y, double nu);
/// Means over the cell 0 .. 2 y with its sublayer, k as it is in thickness and sublayer [kim1995].
Sources averaged_sources(double stress, double y, double nu, double k);

}  // namespace seaway::flow::wall_law
