#include "core/sim/time_step.hpp"

#include <cmath>

namespace seaway::sim {
namespace {

double step_of(double given, double steps_per_period, double shortest_period, double wave_period) {
  if (given > 0) return given;
  const double dt = shortest_period / steps_per_period;
  return wave_period > 0 ? wave_period / std::ceil(wave_period / dt - 1e-9) : dt;
}

}  // namespace

double time_step(const TimeControl& time, const Stage& stage, double shortest_period, double wave_period) {
  const bool own = stage.dt > 0 || stage.steps_per_period > 0;
  return own ? step_of(stage.dt, stage.steps_per_period, shortest_period, wave_period)
             : time_step(time, shortest_period, wave_period);
}

double time_step(const TimeControl& time, double shortest_period, double wave_period) {
  return step_of(time.dt, time.steps_per_period, shortest_period, wave_period);
}

}  // namespace seaway::sim
