// [dtmb5415_rao] Roll and heave of the DTMB 5415 over the period of beam waves, damaged and intact; see README.md.
#include <fmt/format.h>

#include <array>
#include <map>

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
  c.stages[1].dt = 0.5 * c.time.dt;  // as the example's last stage has it
  c.stages[1].end.min_periods = 3;
  c.stages[1].end.max_periods = 4;
  return c;
}

/// The run in waves of one period, made or read: at the example's own period that of dtmb5415_beam_waves.
RunRecord run_at(double period, const std::string& condition, const std::string& example, const Context& context) {
  const KeptRuns runs(context.results, "dtmb5415_rao");
  const sim::Case c = example_case(example);
  if (period == c.wave.period) return runs.finished("dtmb5415_beam_waves_" + condition, example, c, context.threads, {});
  return runs.finished(fmt::format("dtmb5415_rao_{}_{:.1f}", condition, period), example, case_at(example, period), context.threads, {});
}

/// Roll over the wave's slope at one period [1].
double roll_rao(const std::string& condition, double period, const Context& context, Results& results) {
  const std::string example = "dtmb5415_ship_" + condition + "_beam_waves_desk.yaml";
  const sim::Case c = case_at(example, period);
  const std::string of = fmt::format("_{}_{:.1f}", condition, period);
  const RunRecord run = run_at(period, condition, example, context);
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
  struct Condition {
    std::string name;
    std::map<double, double> rao;  // by period [s]
  };
  std::array<Condition, 2> conditions{{{"damaged", {}}, {"intact", {}}}};
  for (const double period : periods)
    for (Condition& condition : conditions) condition.rao[period] = roll_rao(condition.name, period, context, results);
  std::vector<Curve> curves;
  for (const Condition& condition : conditions) {
    Curve& curve = curves.emplace_back(Curve{condition.name, {}, {}});
    double highest = 0, peak_period = 0;
    for (const auto& [period, rao] : condition.rao) {
      curve.x.push_back(period);
      curve.y.push_back(rao);
      if (rao <= highest) continue;
      highest = rao;
      peak_period = period;
    }
    results.report("points_" + condition.name, static_cast<double>(condition.rao.size()), "1");
    // Towing tank and the paper: 1.4 s in both conditions.
    results.expect_near("peak_period_" + condition.name, peak_period, "s", 1.4, 0.1);
  }
  results.plot({"roll in beam waves of 0.061 m", "period, s", "roll over wave slope", curves});
}

}  // namespace seaway::validation
