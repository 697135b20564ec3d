// Geometry of the piecewise linear interface (PLIC) inside one cell, in index space: the cell is the unit
// cube, water is where  normal . x <= d  with x in [0, 1]^Dim. Pure functions of numbers, no mesh.
//
// Volume formulas: scardovelli2000. Normals: mixed Youngs / centred columns [youngs1982; aulisa2007].
#pragma once

#include "core/base/vec.hpp"

namespace seaway::flow {

/// Cells with a volume fraction inside (mixed_limit, 1 - mixed_limit) carry an interface.
inline constexpr double mixed_limit = 1e-9;

inline bool is_mixed(double vof) { return vof > mixed_limit && vof < 1 - mixed_limit; }

template <int Dim>
struct Plane {
  std::array<double, Dim> normal{};  ///< points from water to air; sum of |components| is 1; 0: no interface
  double d = 0;
};

/// Part of the unit cube below the plane, 0..1.
template <int Dim>
double plane_fraction(const std::array<double, Dim>& normal, double d);

/// Plane constant for a volume fraction (clamped to [0, 1]); inverse of plane_fraction to 1e-14.
template <int Dim>
double plane_constant(const std::array<double, Dim>& normal, double vof);

/// Normal of the interface in the middle cell of a 3^Dim stencil of volume fractions, axis 0 fastest.
/// Unit in the sum norm; a stencil without gradient gives the last axis (calm water).
template <int Dim>
std::array<double, Dim> interface_normal(const double* stencil);

/// Plane of the same interface in child `child` (bit a: upper half along axis a) in the child's unit cube.
template <int Dim>
Plane<Dim> child_plane(const Plane<Dim>& plane, int child) {
  Plane<Dim> out = plane;
  out.d = 2 * plane.d;
  for (int a = 0; a < Dim; ++a) out.d -= ((child >> a) & 1) * plane.normal[static_cast<std::size_t>(a)];
  return out;
}

/// Water that leaves a cell through its upper (c > 0) or lower (c < 0) face along `axis` when it moves
/// |c| <= 1 cell lengths; as a signed part of the cell's volume. `vof` is used where there is no interface.
template <int Dim>
double swept_water(const Plane<Dim>& plane, double vof, int axis, double c) {
  if (!is_mixed(vof)) return vof * c;
  const auto s = static_cast<std::size_t>(axis);
  const double depth = c < 0 ? -c : c;
  if (depth < 1e-14) return vof * c;
  std::array<double, Dim> n = plane.normal;
  const double d = c > 0 ? plane.d - n[s] * (1 - depth) : plane.d;
  n[s] *= depth;
  return c * plane_fraction<Dim>(n, d);
}

/// Volume fraction below the plane in the sub-box [lower, upper] of the unit cube.
template <int Dim>
double box_fraction(const Plane<Dim>& plane, const std::array<double, Dim>& lower,
                    const std::array<double, Dim>& upper) {
  std::array<double, Dim> n = plane.normal;
  double d = plane.d;
  for (std::size_t a = 0; a < Dim; ++a) {
    d -= n[a] * lower[a];
    n[a] *= upper[a] - lower[a];
  }
  return plane_fraction<Dim>(n, d);
}

}  // namespace seaway::flow
