#include "core/motion/pose.hpp"

#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::motion {

Rotation<2> rotation(const Pose<2>& pose) {
  const double c = std::cos(pose.roll), s = std::sin(pose.roll);
  Rotation<2> r;
  r << c, -s, s, c;
  return r;
}

Rotation<3> rotation(const Pose<3>& pose) { return pose.attitude.toRotationMatrix(); }

template <>
Pose<2> make_pose<2>(const Vec2& cog, const Angles& a) {
  return {cog, a.roll};
}

template <>
Pose<3> make_pose<3>(const Vec3& cog, const Angles& a) {
  using Eigen::AngleAxisd;
  const Eigen::Quaterniond q = AngleAxisd(a.yaw, Vec3::UnitZ()) *
                               AngleAxisd(a.pitch, Vec3::UnitY()) *
                               AngleAxisd(a.roll, Vec3::UnitX());
  return {cog, q.normalized()};
}

Angles angles(const Pose<2>& pose) { return {pose.roll, 0, 0}; }

Angles angles(const Pose<3>& pose) {
  const Rotation<3> r = rotation(pose);
  const double sin_pitch = -r(2, 0), cos_pitch = std::hypot(r(0, 0), r(1, 0));
  Angles a;
  a.pitch = std::atan2(sin_pitch, cos_pitch);
  if (cos_pitch > 1e-9) {
    a.roll = std::atan2(r(2, 1), r(2, 2));
    a.yaw = std::atan2(r(1, 0), r(0, 0));
  } else {  // roll and yaw turn about the same axis: all of it is called roll
    a.roll = std::atan2(-r(1, 2), r(1, 1));
  }
  return a;
}

double unwrapped(double angle, double previous) {
  return angle + 2 * pi * std::round((previous - angle) / (2 * pi));
}

Pose<2> advance(const Pose<2>& pose, const Twist<2>& twist, double dt) {
  return {pose.cog + dt * twist.head<2>(), pose.roll + dt * twist[2]};
}

Pose<3> advance(const Pose<3>& pose, const Twist<3>& twist, double dt) {
  const Vec3 half = 0.5 * dt * twist.tail<3>();
  const double angle = half.norm();
  // sin(a) / a; the series is exact to rounding below the switch.
  const double sinc = angle < 1e-4 ? 1 - angle * angle / 6 : std::sin(angle) / angle;
  const Vec3 v = sinc * half;
  const Eigen::Quaterniond turn(std::cos(angle), v.x(), v.y(), v.z());
  return {pose.cog + dt * twist.head<3>(), (turn * pose.attitude).normalized()};
}

template <>
DofVector<2> displacement<2>(const Pose<2>& pose, const Vec2& rest_cog) {
  DofVector<2> d;
  d << pose.cog - rest_cog, pose.roll;
  return d;
}

template <>
DofVector<3> displacement<3>(const Pose<3>& pose, const Vec3& rest_cog) {
  const Angles a = angles(pose);
  DofVector<3> d;
  d << pose.cog - rest_cog, a.roll, a.pitch, a.yaw;
  return d;
}

}  // namespace seaway::motion
