// Where a rigid body is and how it moves.
//
// Earth axes x forward, y port, z up. Body axes are parallel to the hull's and have their origin in
// the centre of gravity (cog). Rotations are right-handed: roll turns y towards z (positive:
// starboard down), pitch z towards x (positive: bow down), yaw x towards y (positive: bow to port).
// Dim 2 is the y-z plane: sway, heave, roll.
//
//   x_earth = cog + R x_body
//
// Plain values; nothing here allocates or throws.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/base/vec.hpp"

namespace seaway::motion {

/// Order of the six motions; a section has sway, heave and roll.
enum class Dof { surge = 0, sway, heave, roll, pitch, yaw };
inline constexpr std::array<const char*, 6> dof_names{"surge", "sway", "heave", "roll", "pitch", "yaw"};
constexpr const char* to_string(Dof dof) { return dof_names.at(static_cast<std::size_t>(dof)); }

template <int Dim>
inline constexpr int n_dof = Dim == 2 ? 3 : 6;
template <int Dim>
inline constexpr int n_angular = n_dof<Dim> - Dim;

/// Index of a motion in vectors of n_dof<Dim> entries; -1 if a section does not have it.
template <int Dim>
constexpr int dof_index(Dof dof) {
  if constexpr (Dim == 3) return static_cast<int>(dof);
  switch (dof) {
    case Dof::sway:
      return 0;
    case Dof::heave:
      return 1;
    case Dof::roll:
      return 2;
    default:
      return -1;
  }
}

/// Velocity of the cog and angular velocity, or force and moment about the cog: first the Dim
/// linear components, then the angular ones (2-D: about x), all in EARTH axes.
template <int Dim>
using DofVector = Eigen::Matrix<double, n_dof<Dim>, 1>;
template <int Dim>
using DofMatrix = Eigen::Matrix<double, n_dof<Dim>, n_dof<Dim>>;
template <int Dim>
using Twist = DofVector<Dim>;
template <int Dim>
using Rotation = Eigen::Matrix<double, Dim, Dim>;

/// Yaw, then pitch, then roll about the axes so reached (intrinsic): R = Rz(yaw) Ry(pitch)
/// Rx(roll).
struct Angles {
  double roll = 0, pitch = 0, yaw = 0;  ///< [rad]; of a section only roll
};

template <int Dim>
struct Pose;

/// The angle is kept as a number, so that it may pass half a turn without a jump.
template <>
struct Pose<2> {
  Vec2 cog = Vec2::Zero();  ///< earth (y, z) [m]
  double roll = 0;          ///< [rad]
};

/// The quaternion turns body axes into earth axes and has unit length (`advance` keeps it so).
template <>
struct Pose<3> {
  Vec3 cog = Vec3::Zero();  ///< earth [m]
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
};

template <int Dim>
Pose<Dim> make_pose(const Vec<Dim>& cog, const Angles& angles);
template <>
Pose<2> make_pose<2>(const Vec2& cog, const Angles& angles);
template <>
Pose<3> make_pose<3>(const Vec3& cog, const Angles& angles);

/// R: columns are the body axes in earth axes.
Rotation<2> rotation(const Pose<2>& pose);
Rotation<3> rotation(const Pose<3>& pose);

/// 3-D: roll and yaw in (-pi, pi], pitch in [-pi/2, pi/2]; at pitch +-pi/2 yaw is set to 0.
Angles angles(const Pose<2>& pose);
Angles angles(const Pose<3>& pose);

/// The angle nearest to `previous` that differs from `angle` by whole turns: for histories.
double unwrapped(double angle, double previous);

template <int Dim>
Vec<Dim> to_earth(const Pose<Dim>& pose, const Vec<Dim>& x_body) {
  return pose.cog + rotation(pose) * x_body;
}
template <int Dim>
Vec<Dim> to_body(const Pose<Dim>& pose, const Vec<Dim>& x_earth) {
  return rotation(pose).transpose() * (x_earth - pose.cog);
}
/// Free vectors (velocities, normals, forces) turn with the body but do not shift.
template <int Dim>
Vec<Dim> vector_to_earth(const Pose<Dim>& pose, const Vec<Dim>& v_body) {
  return rotation(pose) * v_body;
}
template <int Dim>
Vec<Dim> vector_to_body(const Pose<Dim>& pose, const Vec<Dim>& v_earth) {
  return rotation(pose).transpose() * v_earth;
}

/// The pose after `dt` of constant twist: exact for it (exponential map), so many small steps of
/// one twist are one large step to rounding, and dt < 0 goes back.
Pose<2> advance(const Pose<2>& pose, const Twist<2>& twist, double dt);
Pose<3> advance(const Pose<3>& pose, const Twist<3>& twist, double dt);

/// Velocity of the body's material at an earth point: v + omega x (x - cog).
template <int Dim>
Vec<Dim> velocity_at(const Twist<Dim>& twist, const Pose<Dim>& pose, const Vec<Dim>& x_earth) {
  const Vec<Dim> r = x_earth - pose.cog;
  if constexpr (Dim == 2) {
    return twist.template head<2>() + twist[2] * Vec2(-r[1], r[0]);
  } else {
    return twist.template head<3>() + twist.template tail<3>().cross(r);
  }
}

/// Moment about the cog of a force at an earth point; same order of axes as the twist's angular
/// part.
template <int Dim>
Eigen::Matrix<double, n_angular<Dim>, 1> moment(const Pose<Dim>& pose, const Vec<Dim>& x_earth,
                                                const Vec<Dim>& force) {
  const Vec<Dim> r = x_earth - pose.cog;
  if constexpr (Dim == 2) {
    return Eigen::Matrix<double, 1, 1>(r[0] * force[1] - r[1] * force[0]);
  } else {
    return r.cross(force);
  }
}

/// Motions as reported: displacement of the cog from `rest_cog`, then the angles.
template <int Dim>
DofVector<Dim> displacement(const Pose<Dim>& pose, const Vec<Dim>& rest_cog);
template <>
DofVector<2> displacement<2>(const Pose<2>& pose, const Vec2& rest_cog);
template <>
DofVector<3> displacement<3>(const Pose<3>& pose, const Vec3& rest_cog);

}  // namespace seaway::motion
