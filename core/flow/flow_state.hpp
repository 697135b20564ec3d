// The unknowns of the flow. Staggered: velocities on faces, the rest in cells.
#pragma once

#include "core/field/gather.hpp"

namespace seaway::flow {

using field::Boundaries;
using field::BoundaryKind;
using field::CellField;
using field::FaceField;
using mesh::BlockShape;
using mesh::Forest;

/// Densities, viscosities, gravity; SI.
struct FluidProperties {
  double rho_water = 1000, rho_air = 1.2;
  double nu_water = 1.0e-6, nu_air = 1.5e-5;
  double gravity = 9.81;
  bool viscous = true;
  double rho(double vof) const { return rho_air + (rho_water - rho_air) * vof; }
};

template <int Dim>
struct FlowState {
  explicit FlowState(const Forest<Dim>& forest) : vof(forest), p(forest), u(forest), w(forest) {}
  CellField<double, Dim> vof;  ///< water volume fraction
  CellField<double, Dim> p;    ///< pressure [Pa], 0 at the lid
  FaceField<double, Dim> u;    ///< fluid velocity normal to the face [m/s], extended into the hull
  FaceField<double, Dim> w;    ///< velocity of fluid and hull through the full face, solenoidal [docs/numerics.md (1)]
  CellField<double, Dim> tke;      ///< turbulent kinetic energy [m2/s2]; empty without a turbulence model
  CellField<double, Dim> epsilon;  ///< its dissipation [m2/s3]; empty without a turbulence model
  bool turbulent() const { return !tke.data().empty(); }
};

}  // namespace seaway::flow
