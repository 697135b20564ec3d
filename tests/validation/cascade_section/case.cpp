// [cascade_section] The example through its three meshes and on the finest alone; see README.md.
#include <cmath>
#include <fstream>

#include "tests/validation/cascade_section/picture.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/kept_runs.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr const char* example = "dtmb5415_section_beam_waves.yaml";

/// A few seconds of the same, to see that it works: no bars.
void shorten(sim::Case& c) {
  c.body.release = sim::Body::Release::at_start;
  for (sim::Stage& s : c.stages) {
    s.end.kind = sim::EndRule::Kind::time;
    s.end.duration = 0.1;
  }
}

/// The finest mesh from the start, until the motions have converged by the rule of the cascade's
/// last stage; then on, so that both runs can be compared at one time.
sim::Case single_mesh(const sim::Case& cascade) {
  sim::Case c = cascade;
  sim::Stage answer = cascade.stages.back();
  answer.name = "answer";
  // It starts from a hull at rest: allow what the cascade allows in all its stages together.
  if (answer.end.kind == sim::EndRule::Kind::converged) {
    answer.end.max_periods = 0;
    for (const sim::Stage& s : cascade.stages) answer.end.max_periods += s.end.max_periods;
  }
  sim::Stage rest = answer;
  rest.name = "rest";
  rest.end = {};
  rest.end.duration = 1000;  // stopped when the cascade's end is reached
  c.stages = {answer, rest};
  return c;
}

}  // namespace

void run_cascade_section(const Context& context, Results& results) {
  const KeptRuns runs(context.results, "cascade_section");
  sim::Case c = example_case();
  if (context.quick()) shorten(c);
  const RunRecord cascade = runs.finished("cascade", example, c, context.threads, {});
  const double end = cascade.end_time();
  const RunRecord single =
      runs.finished("single", example, single_mesh(c), context.threads,
                   [&](double t, int stage) { return stage > 0 && t >= end - 1e-9; });
  if (!context.results.empty()) {
    std::ofstream(runs.file("table.md")) << table_of(cascade, single);
    std::ofstream(runs.file("histories.svg")) << picture_of(cascade, single);
  }

  const double period = c.wave.period, cpu = cascade.total_cpu_s;
  const auto difference = [&](std::vector<double> RunRecord::*signal) {
    const double reference = single.amplitude(single.*signal, end, period);
    return std::abs(cascade.amplitude(cascade.*signal, end, period) / reference - 1);
  };
  const double roll = difference(&RunRecord::roll), heave = difference(&RunRecord::heave);
  const double saved = 1 - cpu / single.cpu_until(end);
  const double to_answer = 1 - cpu / single.cpu_until(single.stages.front().end);
  const double mapping = cascade.mapping_cpu_s() / cpu;
  if (context.quick()) {
    results.report("cpu_saved", saved, "1");
    results.report("mapping_share", mapping, "1");
    return;
  }
  // 2 %: a tenth of what the mesh changes between the first and the last stage.
  results.expect_below("roll_difference", roll, "1", 0.02);
  results.expect_below("heave_difference", heave, "1", 0.02);
  // What the method is for: half of the time at equal physical time, a third to the answer.
  results.expect_above("cpu_saved", saved, "1", 0.5);
  results.expect_above("cpu_saved_to_answer", to_answer, "1", 0.3);
  results.expect_below("mapping_share", mapping, "1", 0.02);
  results.report("roll_amplitude", cascade.amplitude(cascade.roll, end, period) / degree, "deg");
  results.report("heave_amplitude", cascade.amplitude(cascade.heave, end, period), "m");
  results.report("end_time", end, "s");
  results.report("answer_time_single", single.stages.front().end, "s");
  results.report("cpu_cascade", cpu, "s");
  results.report("cpu_single", single.cpu_until(end), "s");
}

}  // namespace seaway::validation
