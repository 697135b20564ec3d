// [cascade_section] The example through its three meshes and on the finest alone; see README.md.
#include <algorithm>
#include <fstream>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/cascade_comparison.hpp"
#include "tests/validation/support/cascade_picture.hpp"
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
  if (context.quick()) {
    results.report("cpu_saved", 1 - cascade.total_cpu_s / single.cpu_until(end), "1");
    results.report("mapping_share", cascade.mapping_cpu_s() / cascade.total_cpu_s, "1");
    return;
  }
  // 2 % of the amplitudes: a tenth of what the mesh changes between the first and the last stage. What the method is for:
  // half of the time at equal physical time, a third to the answer.
  compare_cascade(c, cascade, single, {.difference = 0.02, .cpu_saved = 0.5, .cpu_saved_to_answer = 0.3}, results);
}

}  // namespace seaway::validation
