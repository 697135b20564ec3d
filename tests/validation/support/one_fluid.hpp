// Tanks of one fluid, for flows with exact solutions: air and water have the same density and viscosity.
#pragma once

#include <functional>

#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {

/// Square or box of `cells` x `cells_up` cells of edge h, its lower corner at (y, z) = lower; closed on top. The
/// level z = 0 may lie anywhere: it means nothing.
sim::Case one_fluid_tank(double y_lower, double z_lower, int cells, int cells_up, double h, double nu);

/// Sets u and w to f(x, axis) on all faces. The next step goes on from there.
void set_velocity(Section& run, const std::function<double(const Vec2& x, int axis)>& f);

/// Rms of (u - f) over all faces, over rms of f.
double relative_velocity_error(const Section& run, const std::function<double(const Vec2& x, int axis)>& f);

/// Calls f(block, index, position) for all faces of an axis; those between two blocks come twice.
void each_face(const Section& run, int axis, const std::function<void(int b, int entry, const Vec2& x)>& f);
/// The same for cells.
void each_cell(const Section& run, const std::function<void(int b, int entry, const Vec2& x)>& f);

/// Velocity along an axis at a point, linear between faces of a tank of one level.
double velocity_at(const Section& run, int axis, const Vec2& x);

}  // namespace seaway::validation
