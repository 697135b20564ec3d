// [cascade_section] The example through its three meshes and on the finest alone; see README.md.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "tests/validation/cascade_section/picture.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/kept_runs.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr const char* example_file = "dtmb5415_section_beam_waves.yaml";

/// A few seconds of the same, to see that it works: no bars.
void shorten(sim::Case& c) {
  c.body.release = sim::Body::Release::at_start;
  for (sim::Stage& s : c.stages) {
    s.end.kind = sim::EndRule::Kind::time;
    s.end.duration = 0.1;
  }
}

/// Periods that the last stage lasts at least where both runs are compared at one time.
constexpr double least_periods = 8;

/// The example, its last stage long enough for the comparison at one time.
sim::Case long_cascade(const sim::Case& example) {
  sim::Case c = example;
  sim::EndRule& end = c.stages.back().end;
  if (end.kind != sim::EndRule::Kind::converged) return c;
  end.min_periods = std::max(end.min_periods, least_periods);
  end.max_periods = std::max(end.max_periods, end.min_periods);
  return c;
}

/// The finest mesh from the start, until the motions have converged by the rule of the example's
/// last stage; then on, so that both runs can be compared at one time.
sim::Case single_mesh(const sim::Case& example) {
  sim::Case c = example;
  sim::Stage answer = example.stages.back();
  answer.name = "answer";
  // It starts from a hull at rest: allow what the cascade allows in all its stages together.
  if (answer.end.kind == sim::EndRule::Kind::converged) {
    answer.end.max_periods = 0;
    for (const sim::Stage& s : example.stages) answer.end.max_periods += s.end.max_periods;
  }
  sim::Stage rest = answer;
  rest.name = "rest";
  rest.end = {};
  rest.end.duration = 1000;  // stopped when the cascade's end is reached
  c.stages = {answer, rest};
  return c;
}

/// A run until its motions have converged: what a user waits for.
struct Answer {
  double time = 0, cpu_s = 0;  ///< [s]
  double roll = 0, heave = 0;  ///< amplitudes [rad], [m]
};

Answer answer_of(const RunRecord& run, double time, double period) {
  return {time, run.cpu_until(time), run.amplitude(run.roll, time, period), run.amplitude(run.heave, time, period)};
}

}  // namespace

void run_cascade_section(const Context& context, Results& results) {
  const KeptRuns runs(context.results, "cascade_section");
  sim::Case c = example_case();
  if (context.quick()) shorten(c);
  const RunRecord cascade = runs.finished("cascade", example_file, long_cascade(c), context.threads, {});
  const double end = cascade.end_time();
  const RunRecord single =
      runs.finished("single", example_file, single_mesh(c), context.threads,
                   [&](double t, int stage) { return stage > 0 && t >= end - 1e-9; });
  if (!context.results.empty()) {
    std::ofstream(runs.file("table.md")) << table_of(cascade, single);
    std::ofstream(runs.file("histories.svg")) << picture_of(cascade, single);
  }

  const double period = c.wave.period, cpu = cascade.total_cpu_s;
  const double saved = 1 - cpu / single.cpu_until(end), mapping = cascade.mapping_cpu_s() / cpu;
  if (context.quick()) {
    results.report("cpu_saved", saved, "1");
    results.report("mapping_share", mapping, "1");
    return;
  }
  const Answer last = answer_of(cascade, end, period), reference = answer_of(single, end, period);
  const Answer fast = answer_of(
      cascade, std::min(end, cascade.converged_at(cascade.stages.back().start, c.stages.back().end, period)), period);
  const Answer slow = answer_of(single, single.stages.front().end, period);
  // 2 %: a tenth of what the mesh changes between the first and the last stage.
  results.expect_below("roll_difference", std::abs(last.roll / reference.roll - 1), "1", 0.02);
  results.expect_below("heave_difference", std::abs(last.heave / reference.heave - 1), "1", 0.02);
  // What the method is for: half of the time at equal physical time, a third to the answer.
  results.expect_above("cpu_saved", saved, "1", 0.5);
  results.expect_above("cpu_saved_to_answer", 1 - fast.cpu_s / slow.cpu_s, "1", 0.3);
  results.expect_below("mapping_share", mapping, "1", 0.02);
  results.report("roll_difference_of_answers", std::abs(fast.roll / slow.roll - 1), "1");
  results.report("heave_difference_of_answers", std::abs(fast.heave / slow.heave - 1), "1");
  results.report("roll_amplitude", last.roll / degree, "deg");
  results.report("heave_amplitude", last.heave, "m");
  results.report("end_time", end, "s");
  results.report("answer_time", fast.time, "s");
  results.report("answer_time_single", slow.time, "s");
  results.report("cpu_cascade", cpu, "s");
  results.report("cpu_cascade_to_answer", fast.cpu_s, "s");
  results.report("cpu_single", single.cpu_until(end), "s");
  results.report("cpu_single_to_answer", slow.cpu_s, "s");
}

}  // namespace seaway::validation
