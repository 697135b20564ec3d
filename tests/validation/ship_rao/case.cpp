// [dtmb5415_rao] Roll and heave of the DTMB 5415 over the period of beam waves, damaged and intact; see README.md.
#include <fmt/format.h>

#include "core/base/constants.hpp"
#include "core/waves/airy.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/kept_runs.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

// [s], from the expected peak outwards: what is run first tells most.
constexpr double periods[] = {1.4, 1.3, 1.5, 1.2, 1.7, 1.0, 2.0};
constexpr int steps_per_period = 56;
constexpr double bilge_speed = 0.25;  // where k and epsilon start from [m/s]

/// The desk example in waves of another period: on its first mesh until the motion repeats there, then with the cells that its
/// last mesh has at the hull.
sim::Case case_at(const std::string& example, double period) {
  sim::Case c = example_case(example);
  c.wave.period = period;
  c.time.dt = period / steps_per_period;
  c.turbulence.model = sim::Turbulence::Model::stabilised;
  c.turbulence.walls = sim::Turbulence::Walls::non_equilibrium;
  c.turbulence.velocity = bilge_speed;
  const double finest = c.stages.back().mesh.hull_cell, margin = c.stages.back().mesh.hull_margin;
  c.stages.resize(2);
  c.stages[0].end.tolerance = 0.02;
  c.stages[0].end.min_periods = 4;
  c.stages[0].end.max_periods = 12;
  c.stages[1] = c.stages[0];
  c.stages[1].name = "near";
  c.stages[1].mesh.hull_cell = finest;
  c.stages[1].mesh.hull_margin = margin;
  c.stages[1].end.min_periods = 3;
  c.stages[1].end.max_periods = 4;
  return c;
}

/// Roll over the wave's slope at one period [1]; run or read.
double roll_rao(const std::string& condition, double period, const Context& context, Results& results) {
  const std::string example = "dtmb5415_ship_" + condition + "_beam_waves_desk.yaml";
  const sim::Case c = case_at(example, period);
  const std::string of = fmt::format("_{}_{:.1f}", condition, period);
  const KeptRuns runs(context.results, "dtmb5415_rao");
  const RunRecord run = runs.finished("dtmb5415_rao" + of, example, c, context.threads, {});
  const double amplitude = 0.5 * c.wave.height;
  const double k = waves::linear_wave_number(2 * pi / period, -c.tank.lower.z(), c.fluids.gravity);
  const double roll = run.amplitude(run.roll, run.end_time(), period);
  results.report("roll" + of, roll / degree, "deg");
  results.report("heave_rao" + of, run.amplitude(run.heave, run.end_time(), period) / amplitude, "1");
  for (const StageRecord& stage : run.stages) {
    results.report("roll" + of + "_" + stage.name, run.amplitude(run.roll, stage.end, period) / degree, "deg");
    results.report("settled" + of + "_" + stage.name, stage.converged ? 1 : 0, "1");
  }
  results.report("cpu" + of, run.total_cpu_s, "s");
  results.report("roll_rao" + of, roll / (k * amplitude), "1");
  return roll / (k * amplitude);
}

}  // namespace

void run_dtmb5415_rao(const Context& context, Results& results) {
  for (const char* condition : {"damaged", "intact"}) {
    double highest = 0, peak_period = 0;
    for (const double period : periods) {
      const double rao = roll_rao(condition, period, context, results);
      if (rao <= highest) continue;
      highest = rao;
      peak_period = period;
    }
    results.report(std::string("points_") + condition, static_cast<double>(std::size(periods)), "1");
    // Towing tank and the paper: 1.4 s in both conditions.
    results.expect_near(std::string("peak_period_") + condition, peak_period, "s", 1.4, 0.1);
  }
}

}  // namespace seaway::validation
