// [dtmb5415_beam_waves] The DTMB 5415, damaged and intact, in the paper's regular beam waves; see README.md.
#include "core/base/constants.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/kept_runs.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

struct Amplitudes {
  double roll = 0;   ///< [deg]
  double heave = 0;  ///< [m]
};

/// Amplitudes at the end of the last stage; those at the ends of the stages before and the costs are reported.
Amplitudes amplitudes_of(const std::string& condition, const Context& context, Results& results) {
  const std::string example = "dtmb5415_ship_" + condition + "_beam_waves_desk.yaml";
  const KeptRuns runs(context.results, "dtmb5415_beam_waves");
  const sim::Case c = example_case(example);
  const RunRecord run = runs.finished("dtmb5415_beam_waves_" + condition, example, c, context.threads, {});
  for (const StageRecord& stage : run.stages) {
    const std::string of = "_" + condition + "_" + stage.name;
    results.report("cells" + of, static_cast<double>(stage.cells), "1");
    results.report("roll" + of, run.amplitude(run.roll, stage.end, c.wave.period) / degree, "deg");
    results.report("cpu" + of, stage.cpu_s, "s");
  }
  results.report("mapping_share_" + condition, run.mapping_cpu_s() / run.total_cpu_s, "1");
  return {run.amplitude(run.roll, run.end_time(), c.wave.period) / degree, run.amplitude(run.heave, run.end_time(), c.wave.period)};
}

}  // namespace

void run_dtmb5415_beam_waves(const Context& context, Results& results) {
  const Amplitudes damaged = amplitudes_of("damaged", context, results);
  // Towing tank; k-epsilon with walls.
  results.expect_near("roll_damaged", damaged.roll, "deg", 17.4, 0.15 * 17.4);
  results.report("heave_damaged", damaged.heave, "m");
  const Amplitudes intact = amplitudes_of("intact", context, results);
  results.report("roll_intact", intact.roll, "deg");
  results.report("heave_intact", intact.heave, "m");
  results.expect_near("roll_damaged_over_intact", damaged.roll / intact.roll, "1", 0.7, 0.1);
}

}  // namespace seaway::validation
