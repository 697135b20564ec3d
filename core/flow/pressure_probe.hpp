// Pressure at a point: what a sensor in a wall or in the fluid reads.
//
// Linear between the centres of the cells around the point, of which only those count that the pressure is solved in
// (a face open at the half-step geometry, the point's own side of a thin wall). Each is brought to the point's
// height by its own weight, so that still water is exact beside any wall. Thread-safe: reads only.
#pragma once

#include <optional>

#include "core/flow/hull_mask.hpp"

namespace seaway::flow {

/// [Pa] above the pressure at the tank's open top. `mask` may be null; `x` in earth axes [m]. Next to level jumps first
/// order. Nothing if no such cell is around: the point lies in solid.
template <int Dim>
std::optional<double> pressure_at(const Forest<Dim>& forest, const FlowState<Dim>& state, const FluidProperties& fluids,
                                  const HullMask<Dim>* mask, const Vec<Dim>& x);

extern template std::optional<double> pressure_at(const Forest<2>&, const FlowState<2>&, const FluidProperties&,
                                                  const HullMask<2>*, const Vec2&);
extern template std::optional<double> pressure_at(const Forest<3>&, const FlowState<3>&, const FluidProperties&,
                                                  const HullMask<3>*, const Vec3&);

}  // namespace seaway::flow
