#include "tests/validation/support/linear_sloshing.hpp"

#include <cmath>

#include "core/base/constants.hpp"

// The velocity potential is phi' P + sum_n q_n f_n: P that of a tank with a lid that turns with it (Joukowski), f_n the sloshing
// modes, n odd, with y = sum_n c_n cos(k_n (y + breadth/2)) between the sides. The elevation is the tilt phi y plus
// sum_n s_n cos(k_n (y + breadth/2)). The moment follows from the water's weight and its change of angular momentum about the
// axis, which needs P at the surface only, and the inertia J of the lidded tank, rho times the contour integral of P dP/dn.
namespace seaway::validation {

namespace {
constexpr int n_modes = 400;
}

double RollingTank::first_mode() const {
  const double k = pi / breadth;
  return std::sqrt(gravity * k * std::tanh(k * depth));
}

double RollingTank::moment_per_angle_at_rest() const {
  return rho * gravity * (breadth * depth * (-0.5 * depth - axis) + std::pow(breadth, 3) / 12);
}

double RollingTank::moment_per_angle_frozen(double omega) const {
  const double area = breadth * depth, arm = 0.5 * depth + axis;
  const double inertia = rho * area * ((breadth * breadth + depth * depth) / 12 + arm * arm);
  return -rho * gravity * area * arm + omega * omega * inertia;
}

double RollingTank::moment_per_angle(double omega) const {
  const double b = breadth, d = depth, bottom = -d - axis;
  // Both sides: P = -y (z - axis) + Q there, dP/dn = -(z - axis) or its opposite.
  double inertia = b * (std::pow(-axis, 3) - std::pow(bottom, 3)) / 3, elevation = 0;
  for (int i = 0; i < n_modes; ++i) {
    const int n = 2 * i + 1;
    const double k = n * pi / b, c = -4 * b / std::pow(n * pi, 2);
    const double half = std::tanh(0.5 * k * d), full = std::tanh(k * d);
    const double on_surface = c * (axis + 2 / k * half);      // of P
    inertia += 0.5 * b * c * on_surface;                      // surface
    inertia -= 0.5 * b * c * c * (d + axis - 2 / k * half);   // bottom
    inertia += 8 * c / (k * k) * (0.5 * d - half / k);        // what Q adds at the sides
    const double s = -k * full * (gravity * c - omega * omega * on_surface) / (gravity * k * full - omega * omega);
    elevation += 0.5 * b * s * (omega * omega * on_surface - gravity * c);
  }
  return rho * (-gravity * b * d * (0.5 * d + axis) + omega * omega * inertia + elevation);
}

}  // namespace seaway::validation
