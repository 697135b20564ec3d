// [dtmb5415_decay_intact], [dtmb5415_decay_damaged], [dtmb5415_decay_meshes] Free roll of the DTMB 5415 against the towing tank; see README.md.
#include <fmt/format.h>

#include <cmath>

#include "core/base/constants.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/kept_runs.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double measured_period = 1.40;  // intact, towing tank

/// The decay of an example's roll [deg], run or read; its cost and what the water lost are reported.
analysis::Decay decay_of(const std::string& name, const std::string& example, const Context& context,
                         Results& results) {
  const KeptRuns runs(context.results, name);
  const RunRecord run = runs.finished(name, example, example_case(example), context.threads, {});
  results.report("cells", static_cast<double>(run.stages.back().cells), "1");
  results.report("cpu_s_per_s", run.total_cpu_s / run.end_time(), "1");
  if (std::isfinite(run.stages.back().volume_drift))
    results.expect_below("volume_drift", std::abs(run.stages.back().volume_drift), "1", 1e-3);
  return run.roll_decay();
}

void report_peaks(const analysis::Decay& decay, Results& results) {
  for (const analysis::DecayCycle& c : decay.cycles) {
    results.report("peak_" + std::to_string(c.number), c.angle, "deg");
    results.report("period_of_cycle_" + std::to_string(c.number), c.period, "s");
  }
}

/// Two cycles of the intact ship from 4 degrees: what the dry gyradius of the examples was calibrated on.
void report_calibration(const Context& context, Results& results) {
  constexpr const char* example = "dtmb5415_ship_intact_decay_desk.yaml";
  sim::Case c = example_case(example);
  c.body.angles[0] = 4 * degree;
  const KeptRuns runs(context.results, "dtmb5415_decay_intact");
  constexpr double two_cycles = 3.4;
  const RunRecord run = runs.finished("dtmb5415_decay_from_4_degrees", example, c, context.threads,
                                      [](double time, int) { return time > two_cycles; });
  const analysis::Decay decay = run.roll_decay();
  const double period = 0.5 * (cycle(decay, 1).period + cycle(decay, 2).period);
  results.expect_near("period_from_4_deg", period, "s", measured_period, 0.01 * measured_period);
}

}  // namespace

void run_dtmb5415_decay_intact(const Context& context, Results& results) {
  report_calibration(context, results);
  const analysis::Decay decay =
      decay_of("dtmb5415_decay_intact", "dtmb5415_ship_intact_decay_desk.yaml", context, results);
  results.expect_near("period", cycle(decay, 1).period, "s", measured_period, 0.03 * measured_period);
  report_peaks(decay, results);
}

void run_dtmb5415_decay_damaged(const Context& context, Results& results) {
  const analysis::Decay decay =
      decay_of("dtmb5415_decay_damaged", "dtmb5415_ship_damaged_decay_desk.yaml", context, results);
  report_peaks(decay, results);
  results.report("period_1", cycle(decay, 1).period, "s");
  // Measured in the towing tank.
  results.expect_near("period_9", cycle(decay, 9).period, "s", 1.515, 0.05 * 1.515);
  results.expect_near("peak_9", cycle(decay, 9).angle, "deg", 1.556, 0.2 * 1.556);
}

void run_dtmb5415_decay_meshes(const Context& context, Results& results) {
  const KeptRuns runs(context.results, "dtmb5415_decay_meshes");
  std::vector<Curve> damaged_curves, ship_curves;
  for (const std::string condition : {"damaged", "intact"}) {
    const std::string example = "dtmb5415_ship_" + condition + "_decay_desk.yaml";
    const sim::Case waves = example_case("dtmb5415_ship_" + condition + "_beam_waves_desk.yaml");
    for (const std::string mesh : {"A", "B", "C"}) {
      sim::Case c = example_case(example);
      std::string name = "dtmb5415_decay_" + condition;  // C is the example's own
      if (mesh != "C") {
        c.stages[0].mesh = waves.stages[mesh == "A" ? 0 : 1].mesh;
        name += "_" + mesh;
      }
      const RunRecord run = runs.finished(name, example, c, context.threads, {});
      const std::string of = "_" + condition + "_" + mesh;
      results.report("cells" + of, static_cast<double>(run.stages.back().cells), "1");
      results.report("cpu" + of, run.total_cpu_s, "s");
      const analysis::Decay decay = run.roll_decay();
      for (const analysis::DecayCycle& at : decay.cycles) {
        results.report(fmt::format("period_{}{}", at.number, of), at.period, "s");
        results.report(fmt::format("peak_{}{}", at.number, of), at.angle, "deg");
      }
      Curve curve{condition + ", mesh " + mesh, run.t, {}};
      for (const double roll : run.roll) curve.y.push_back(roll / degree);
      if (condition == "damaged") damaged_curves.push_back(curve);
      if (mesh == "C") ship_curves.push_back(curve);
    }
  }
  results.plot({"free roll of the damaged ship on three meshes", "t, s", "roll, deg", damaged_curves});
  results.plot({"free roll of both ships on the finest mesh", "t, s", "roll, deg", ship_curves});
}

}  // namespace seaway::validation
