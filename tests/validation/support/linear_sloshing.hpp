// Linear potential theory of water in a rectangular tank that rolls harmonically: what moment it exerts on the tank.
// Plane flow, small angles. Pure functions.
#pragma once

namespace seaway::validation {

/// A tank filled to `depth`; it turns about a point `axis` above its calm surface, midway between its sides.
struct RollingTank {
  double breadth = 0, depth = 0, axis = 0;   ///< [m]
  double rho = 1000, gravity = 9.81;         ///< [kg/m3], [m/s2]

  /// Natural frequency of the first antisymmetric mode [rad/s].
  double first_mode() const;
  /// Moment about the axis over the angle, both from y to z [N m / rad per metre of tank]: > 0 works against the tank's
  /// stability. Real: without damping both are in phase. Modes are summed until they change 1e-7 of it.
  double moment_per_angle(double omega) const;
  /// The same if the surface stays level and the water has no inertia: omega -> 0.
  double moment_per_angle_at_rest() const;
  /// The same if the water were a solid.
  double moment_per_angle_frozen(double omega) const;
};

}  // namespace seaway::validation
