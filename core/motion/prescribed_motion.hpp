// Motion of one direction given as a function of time.
#pragma once

#include <span>

#include "core/motion/pose.hpp"

namespace seaway::motion {

/// amplitude sin(2 pi t / period), multiplied by a ramp that rises from 0 to 1 in `ramp` seconds
/// with zero first and second derivative at both ends (no jump in velocity or acceleration). Zero
/// for t <= 0; ramp 0: starts at once, with a jump in velocity.
struct PrescribedMotion {
  Dof dof = Dof::roll;
  double amplitude = 0;  ///< [m] or [rad]
  double period = 1;     ///< [s]
  double ramp = 0;       ///< [s]

  double position(double t) const;
  double velocity(double t) const;
  /// (position(t + dt) - position(t)) / dt: the velocity that carries the geometry exactly along
  /// the prescribed positions; the flow must see this one, or water is made at the wall.
  double mean_velocity(double t, double dt) const;
};

/// Sets the prescribed components of `twist` to their mean velocity over [t, t + dt] and leaves the
/// others. In 3-D two prescribed rotations at once are angular velocities about earth axes; their
/// positions are then not Euler angles, but geometry and velocity still agree.
template <int Dim>
void prescribe(std::span<const PrescribedMotion> motions, double t, double dt, Twist<Dim>& twist) {
  for (const PrescribedMotion& motion : motions) {
    const int i = dof_index<Dim>(motion.dof);
    if (i >= 0) twist[i] = motion.mean_velocity(t, dt);
  }
}

}  // namespace seaway::motion
