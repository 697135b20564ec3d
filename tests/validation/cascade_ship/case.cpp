// [cascade_ship] The damaged DTMB 5415 in beam waves through three meshes and on the finest alone; see README.md.
#include <fstream>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/cascade_comparison.hpp"
#include "tests/validation/support/cascade_picture.hpp"
#include "tests/validation/support/kept_runs.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {

void run_cascade_ship(const Context& context, Results& results) {
  constexpr const char* example = "dtmb5415_ship_damaged_beam_waves_desk.yaml";
  const KeptRuns runs(context.results, "cascade_ship");
  const sim::Case c = example_case(example);
  // The very run of dtmb5415_beam_waves.
  const RunRecord cascade = runs.finished("dtmb5415_beam_waves_damaged", example, c, context.threads, {});
  const double end = cascade.end_time();
  const RunRecord single = runs.finished("cascade_ship_single", example, single_mesh(c), context.threads,
                                         [&](double t, int) { return t >= end - 1e-9; });
  if (!context.results.empty()) {
    std::ofstream(runs.file("cascade_ship_table.md")) << table_of(cascade, single);
    std::ofstream(runs.file("cascade_ship_histories.svg")) << picture_of(cascade, single);
  }
  compare_cascade(c, cascade, single, {.difference = 0.02, .cpu_saved = 0.55}, results);
  for (const StageRecord& stage : cascade.stages) {
    results.report("cells_" + stage.name, static_cast<double>(stage.cells), "1");
    results.report("cpu_" + stage.name, stage.cpu_s, "s");
    results.report("cpu_mapping_to_" + stage.name, stage.mapping_cpu_s, "s");
  }
}

}  // namespace seaway::validation
