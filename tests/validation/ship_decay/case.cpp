// [dtmb5415_decay_intact], [dtmb5415_decay_damaged] Free roll of the DTMB 5415 against the towing tank; see README.md.
#include "core/analysis/decay.hpp"
#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/kept_runs.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

/// The decay of an example's roll [deg], run or read; its cost and what the water did are reported.
analysis::Decay decay_of(const std::string& name, const std::string& example, const Context& context,
                         Results& results) {
  const KeptRuns runs(context.results, name);
  const RunRecord run = runs.finished(name, example, example_case(example), context.threads, {});
  std::vector<double> angle;
  for (const double roll : run.roll) angle.push_back(roll / degree);
  results.report("cells", static_cast<double>(run.stages.back().cells), "1");
  results.report("cpu_s_per_s", run.total_cpu_s / run.end_time(), "1");
  return analysis::analyse_decay({run.t, angle});
}

const analysis::DecayCycle& cycle(const analysis::Decay& decay, std::size_t number) {
  if (decay.cycles.size() < number)
    fail(ErrorCode::failed_precondition, "the run has {} cycles of roll, asked is cycle {}; make it longer",
         decay.cycles.size(), number);
  return decay.cycles[number - 1];
}

void report_peaks(const analysis::Decay& decay, Results& results) {
  for (const analysis::DecayCycle& c : decay.cycles) {
    results.report("peak_" + std::to_string(c.number), c.angle, "deg");
    results.report("period_of_cycle_" + std::to_string(c.number), c.period, "s");
  }
}

}  // namespace

void run_dtmb5415_decay_intact(const Context& context, Results& results) {
  const analysis::Decay decay =
      decay_of("dtmb5415_decay_intact", "dtmb5415_ship_intact_decay_desk.yaml", context, results);
  // Measured in the towing tank: 1.40 s.
  results.expect_near("period", cycle(decay, 1).period, "s", 1.40, 0.03 * 1.40);
  report_peaks(decay, results);
}

void run_dtmb5415_decay_damaged(const Context& context, Results& results) {
  const analysis::Decay decay =
      decay_of("dtmb5415_decay_damaged", "dtmb5415_ship_damaged_decay_desk.yaml", context, results);
  report_peaks(decay, results);
  results.report("period_1", cycle(decay, 1).period, "s");
  // Measured in the towing tank; without a turbulence model the last peak is asked for within 40 %.
  results.expect_near("period_9", cycle(decay, 9).period, "s", 1.515, 0.05 * 1.515);
  results.expect_near("peak_9", cycle(decay, 9).angle, "deg", 1.556, 0.4 * 1.556);
}

}  // namespace seaway::validation
