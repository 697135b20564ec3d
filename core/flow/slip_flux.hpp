// What apertures get wrong along oblique walls. Apertures are volumes of staggered control volumes, what flows
// through a face is its open part: along a wall that is oblique to the grid they differ, and a flow that only slides
// along the wall would not be solenoidal in w = a u. The pressure would drive a tenth of it across the wall, and
// transport would turn that into drag: 0.016 rho U^2, several times the friction of the law of the wall
// (docs/numerics.md, section "Hull"). The slip flux (open part - a) (velocity along the wall) makes up for it.
#pragma once

#include "core/flow/hull_mask.hpp"

namespace seaway::flow {

template <int Dim>
class SlipFlux {
 public:
  explicit SlipFlux(const FluidProperties& fluids) : fluids_(fluids) {}

  /// For the half-step geometry of the mask, from state.u with all forces but the pressure over dt, which is
  /// predicted by the last pressure, and the hull's predicted twist.
  void find(const HullMask<Dim>& mask, const FlowState<Dim>& state, const motion::Twist<Dim>& twist, double dt);

  /// [m/s] by entry of the mask's window, to be added to w; empty before the first find().
  const std::vector<double>& through(int axis) const { return flux_[static_cast<std::size_t>(axis)]; }

 private:
  struct Wall {
    Vec<Dim> normal = Vec<Dim>::Zero();
    double flatness = 0;  ///< 1 plane, 0 at an edge
  };
  Wall wall_at(const HullMask<Dim>& mask, const IVec<Dim>& face, int axis) const;
  bool velocity_at(const HullMask<Dim>& mask, const IVec<Dim>& face, int axis, double dt, Vec<Dim>& velocity) const;

  FluidProperties fluids_;
  std::array<std::vector<double>, Dim> flux_, u_;
  std::vector<double> p_, vof_;
};

extern template class SlipFlux<2>;
extern template class SlipFlux<3>;

}  // namespace seaway::flow
