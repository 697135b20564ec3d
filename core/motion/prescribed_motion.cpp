#include "core/motion/prescribed_motion.hpp"

#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::motion {

double PrescribedMotion::position(double t) const {
  if (t <= 0) return 0;
  const double s = t < ramp ? t / ramp : 1;
  const double rise = s * s * s * (10 + s * (6 * s - 15));
  return rise * amplitude * std::sin(2 * pi * t / period);
}

double PrescribedMotion::velocity(double t) const {
  if (t <= 0) return 0;
  const double omega = 2 * pi / period;
  const double steady = amplitude * omega * std::cos(omega * t);
  if (t >= ramp) return steady;
  const double s = t / ramp;
  const double rise = s * s * s * (10 + s * (6 * s - 15));
  const double rate = 30 * s * s * (1 - s) * (1 - s) / ramp;
  return rise * steady + rate * amplitude * std::sin(omega * t);
}

double PrescribedMotion::mean_velocity(double t, double dt) const {
  return (position(t + dt) - position(t)) / dt;
}

}  // namespace seaway::motion
