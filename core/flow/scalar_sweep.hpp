// One directional sweep of a scalar per unit mass (turbulent energy, dissipation) with the mass fluxes that carry
// the momentum in the same sweep (advection.hpp):
//   m' s' = m s - d(F s_upwind) + (m' - m + dF) s0
// s0: before the sub-step. A uniform scalar stays uniform to rounding. Positive by construction: F s_upwind takes
// at most what the donor holds, and where the dilation term (m' - m + dF < 0) would still take too much it acts
// on s' in place of s0. Coarse-fine faces: each side uses its own ghosts, as momentum does (first order).
#pragma once

#include <cmath>

#include "core/flow/flow_state.hpp"

namespace seaway::flow {

/// Second order upwind, van Leer limited [vanleer1979] value at the lower boundary of a control volume: u0 | u1
/// are beside it, um and u2 beyond. Corrected with the Courant number of the donor.
inline double upwind(double um, double u0, double u1, double u2, double flux, double courant) {
  const double middle = u1 - u0;
  const double donor_side = flux > 0 ? u0 - um : u2 - u1;
  const double product = middle * donor_side;
  const double slope = product > 0 ? 2 * product / (middle + donor_side) : 0.0;
  return flux > 0 ? u0 + 0.5 * (1 - courant) * slope : u1 - 0.5 * (1 - courant) * slope;
}

/// Whether fluxes through the lower and the upper side of a volume take more out of it than it has, `before`, or leave other
/// than it has `after`: local sub-steps, which let water pass in equal shares, may. What is carried would be made of mass that is
/// not there, and divided by next to nothing.
inline bool is_overdrawn(double before, double lower, double upper, double after) {
  return std::max(upper, 0.0) - std::min(lower, 0.0) > before || std::abs(after - before + upper - lower) > 0.5 * after;
}

/// `v` kept in the range of the values in a volume, on both sides of it, and at the start.
inline double kept_in_range(double v, double v0, double v1, double v2, double start) {
  return std::min(std::max(std::max(v0, v1), std::max(v2, start)), std::max(std::min(std::min(v0, v1), std::min(v2, start)), v));
}

/// What a sweep knows of one block: gathered faces and cells (core/field/gather.hpp).
template <int Dim>
struct SweepFluxes {
  int axis;
  bool pure;         ///< one fluid in the block and around it: only w counts
  double courant_w;  ///< dt / h: makes w a Courant number
  const field::Scratch<double, Dim>& w;          ///< [m/s]
  const field::Scratch<double, Dim>& mass_flux;  ///< rho times Courant number [kg/m3]; not used if pure
  const field::Scratch<double, Dim>& old_rho;    ///< of the cells before the sweep; not used if pure
  const field::Scratch<double, Dim>& new_rho;    ///< after it; not used if pure
};

/// Writes block b of `out`. Before: parents of `scalar` restricted; sum of Courant numbers <= 1/2.
template <int Dim>
void sweep_scalar(const Forest<Dim>& forest, int b, const SweepFluxes<Dim>& fluxes,
                  const CellField<double, Dim>& scalar, const CellField<double, Dim>& start,
                  CellField<double, Dim>& out);

}  // namespace seaway::flow
