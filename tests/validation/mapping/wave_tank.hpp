// An exact flow for the mapping case: one length of a linear deep-water wave with its air above, a vortex
// beside, and the meshes of two stages around it.
#pragma once

#include "core/mesh/refinement.hpp"
#include "core/transfer/flow_fields.hpp"

namespace seaway::validation {

inline constexpr double wave_length = 3.07;  ///< [m]
inline constexpr double wave_height = 0.061; ///< [m]

/// A tank of one wave length, periodic along it. Cells of `base` [m] refined by `levels` in the band about
/// the surface, one level less in a box on one side.
mesh::Forest<2> coarse_stage(double base, int levels, int threads);
/// The next stage: the band one level finer and narrower, a box about the middle two levels finer than
/// around it, the old box given up.
mesh::Forest<2> fine_stage(double base, int levels, int threads);

/// Velocity component `axis` at a point [m/s]: wave below, its mirror image above, blended over 0.02 lengths.
double wave_velocity(const Vec2& x, int axis);
/// Pressure [Pa] with its kink at the surface.
double wave_pressure(const Vec2& x);
double wave_elevation(double x);

/// All fields exact: vof as cell averages, p, extra (a layer at the bottom) and velocities as point values, w from
/// differences of a stream function, so that it is solenoidal cell by cell.
transfer::FlowFields<2> exact_flow(const mesh::Forest<2>& forest);

}  // namespace seaway::validation
