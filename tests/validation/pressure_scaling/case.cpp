// [pressure_scaling] Iterations of the pressure solve in the example case; see README.md.
#include <algorithm>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

struct Iterations {
  double mean = 0;
  int most = 0;
  std::int64_t cells = 0;
};

/// The example with its hull free from the start, after `settle` steps.
Iterations iterations(const sim::MeshRule& mesh, int settle, int steps, int threads) {
  sim::Case c = example_case();
  c.body.release = sim::Body::Release::at_start;
  c.body.angles = {5 * degree, 0, 0};  // it moves from the first step on
  c.stages.resize(1);
  c.stages.front().mesh = mesh;
  const auto run = start(c, threads);
  Iterations out;
  out.cells = run->forest().n_cells();
  for (int i = 0; i < settle + steps; ++i) {
    const int n = step(*run).pressure.iterations;
    if (i < settle) continue;
    out.mean += static_cast<double>(n) / steps;
    out.most = std::max(out.most, n);
  }
  return out;
}

}  // namespace

void run_pressure_scaling(const Context& context, Results& results) {
  const int steps = context.quick() ? 20 : 60;
  const Iterations few = iterations(example_mesh(20000), 20, steps, context.threads);
  // Ten iterations of a multigrid cycle each cost about as much as the rest of a step.
  results.expect_below("iterations_20k", few.mean, "1", 10);
  results.report("most_iterations_20k", few.most, "1");
  results.report("cells_20k", static_cast<double>(few.cells), "1");
  if (context.quick()) return;  // the large mesh misses its bar today: shown in full, see README.md
  const Iterations many = iterations(example_mesh(300000), 10, steps, context.threads);
  // Multigrid: hardly any growth with the number of cells.
  results.expect_below("iterations_300k", many.mean, "1", std::min(10.0, few.mean + 2));
  results.report("most_iterations_300k", many.most, "1");
  results.report("cells_300k", static_cast<double>(many.cells), "1");
}

}  // namespace seaway::validation
