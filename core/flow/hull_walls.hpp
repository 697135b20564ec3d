// Friction at the hull. Each cell that holds a piece of wall looks at the velocity along the wall at an image
// point, 1.5 cells away from it, and takes the wall's stress from
//   no_slip          the slope at the wall of the parabola through the wall and two image points (1.5, 2.5 cells)
//   wall_function    the law of the wall [launder1974]
//   non_equilibrium  the law with the pressure gradient along the wall [kim1995]
// Stress times area is taken from the momentum of the open faces around the wall (linear weights, by aperture),
// each by at most its velocity relative to the hull: no limit on the time step. What the water and the air lose the
// hull gets, as force and moment. The cells next to walls get production and dissipation of turbulence from the
// same law. All at the half-step geometry, where the velocities are.
#pragma once

#include <map>

#include "core/flow/hull_mask.hpp"
#include "core/flow/k_epsilon.hpp"

namespace seaway::flow {

enum class WallModel { slip, no_slip, wall_function, non_equilibrium };

/// y+ of image points at wetted walls: smallest, largest, and sums for the mean over area and time.
struct YPlusRange {
  double smallest = 1e300, largest = 0, weighted = 0, weight = 0;
  double mean() const { return weight > 0 ? weighted / weight : 0; }
};

template <int Dim>
class HullWalls {
 public:
  HullWalls(WallModel model, const FluidProperties& fluids) : model_(model), fluids_(fluids) {}

  /// The walls' stress for the velocities as they are.
  void find_stress(const HullMask<Dim>& mask, const FlowState<Dim>& state, const motion::Twist<Dim>& twist);
  /// Cells at walls, for KEpsilon; of the last find_stress.
  std::span<const NearWallCell> near_cells() const { return near_; }
  /// Takes the stress over dt from u; returns force and moment about the cog on the hull [N, N m; 2-D per metre].
  /// Parents of u restricted after.
  motion::DofVector<Dim> apply(const HullMask<Dim>& mask, FlowState<Dim>& state, const motion::Twist<Dim>& twist,
                               double dt);
  /// By connected space: 0 the hull's outside, 1 + i compartment i. Collected by apply().
  std::map<int, YPlusRange>& y_plus() { return y_plus_; }
  const std::map<int, YPlusRange>& y_plus() const { return y_plus_; }

 private:
  /// A piece of wall in one cell.
  struct Piece {
    Vec<Dim> force_point;  ///< about which the faces feel it
    Vec<Dim> traction;     ///< stress times area over density, along the flow [m3/s2, 2-D m2/s2]
    double rho = 0, area = 0, y_plus = 0;
    int space = 0;
    bool wet = false;
  };
  struct Look;
  Look look(const HullMask<Dim>& mask, const IVec<Dim>& cell, const motion::Twist<Dim>& twist) const;
  Vec<Dim> velocity_at(const HullWindow<Dim>& window, const Vec<Dim>& x) const;
  double stress_of(const HullMask<Dim>& mask, const Look& at) const;
  void spread(const HullMask<Dim>& mask, const Piece& piece, int axis, std::vector<double>& sink) const;

  WallModel model_;
  FluidProperties fluids_;
  std::array<std::vector<double>, Dim> u_;  ///< window arrays
  std::vector<double> vof_, k_, p_;
  std::vector<Piece> pieces_;
  std::vector<NearWallCell> near_;
  std::map<int, YPlusRange> y_plus_;
};

extern template class HullWalls<2>;
extern template class HullWalls<3>;

}  // namespace seaway::flow
