// [pressure_scaling, pressure_scaling_3d] Iterations of the pressure solve in the example cases; see README.md.
#include <algorithm>
#include <string>
#include <utility>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/ship_run.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

struct Iterations {
  double mean = 0;
  int most = 0;
  std::int64_t cells = 0;
};

/// Of `steps` steps, after `settle` others.
template <class Run>
Iterations measure(Run& run, int settle, int steps) {
  Iterations out;
  out.cells = run.forest().n_cells();
  for (int i = 0; i < settle + steps; ++i) {
    const int n = step(run).pressure.iterations;
    if (i < settle) continue;
    out.mean += static_cast<double>(n) / steps;
    out.most = std::max(out.most, n);
  }
  return out;
}

/// The example with its hull free from the start.
Iterations iterations(const sim::MeshRule& mesh, int settle, int steps, int threads) {
  sim::Case c = example_case();
  c.body.release = sim::Body::Release::at_start;
  c.body.angles = {5 * degree, 0, 0};  // it moves from the first step on
  c.stages.resize(1);
  c.stages.front().mesh = mesh;
  return measure(*start(c, threads), settle, steps);
}

Iterations ship_iterations(std::int64_t cells, int settle, int steps, int threads) {
  return measure(*start<3>(ship_model(ship_in_waves(cells)), threads), settle, steps);
}

}  // namespace

void run_pressure_scaling(const Context& context, Results& results) {
  const int steps = context.quick() ? 20 : 60;
  const Iterations few = iterations(example_mesh(20000), 20, steps, context.threads);
  // Ten iterations of a multigrid cycle each cost about as much as the rest of a step.
  results.expect_below("iterations_20k", few.mean, "1", 10);
  results.report("most_iterations_20k", few.most, "1");
  results.report("cells_20k", static_cast<double>(few.cells), "1");
  const Iterations many = iterations(example_mesh(300000), 10, steps, context.threads);
  // Multigrid: hardly any growth with the number of cells.
  results.expect_below("iterations_300k", many.mean, "1", std::min(10.0, few.mean + 2));
  results.report("most_iterations_300k", many.most, "1");
  results.report("cells_300k", static_cast<double>(many.cells), "1");
}

void run_pressure_scaling_3d(const Context& context, Results& results) {
  double fewest = 0;
  for (const auto& [name, cells] : {std::pair{"100k", 100000}, {"1m", 1000000}, {"3500k", 3500000}}) {
    const Iterations it = ship_iterations(cells, 3, 10, context.threads);
    if (fewest == 0) fewest = it.mean;
    const std::string size = name;
    // Multigrid: hardly any growth with the number of cells.
    if (size == "100k") results.report("iterations_100k", it.mean, "1");
    else results.expect_below("iterations_" + size, it.mean, "1", size == "1m" ? std::min(12.0, fewest + 3) : fewest + 3);
    results.report("most_iterations_" + size, it.most, "1");
    results.report("cells_" + size, static_cast<double>(it.cells), "1");
  }
}

}  // namespace seaway::validation
