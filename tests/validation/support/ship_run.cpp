#include "tests/validation/support/ship_run.hpp"

#include <algorithm>
#include <cmath>

#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

/// The kind of the examples of size `desk`, with tank and cells of the tank multiplied by `size` (0.75 to 1.5) and the
/// hull's cells `halvings` times finer than the base cells (desk: 5). Regions for roll angles of 15 degrees.
sim::Case on_mesh(int halvings, double size) {
  sim::Case c = example_case("dtmb5415_ship_damaged_beam_waves_demo.yaml");
  c.base_cell = 0.32 * size;
  c.tank.lower = size * Vec3(-2.56, -3.84, -1.7067);
  c.tank.upper = size * Vec3(2.56, 3.84, 0.8533);
  c.zones.generation_length = c.zones.absorption_length = 1.5 * size;
  c.wave.height = 0.061;  // the paper's: the example's is made for coarser cells
  c.body.release = sim::Body::Release::at_start;
  c.body.angles = {5 * degree, 0, 0};
  const double cell = std::ldexp(c.base_cell, -halvings);
  c.time.dt = 0.0125 * cell / 0.015;  // the examples' step on cells of 15 mm; the same Courant numbers on all meshes
  sim::MeshRule rule;
  rule.hull_cell = cell;
  rule.hull_margin = std::max(0.04, 5 * cell);
  rule.hull_heave = 0.03;
  rule.hull_sweep = 15 * degree;
  rule.surface = {{2 * cell, 0.06, 0.3}, {4 * cell, 0.06}};
  c.stages.resize(1);
  c.stages.front().mesh = rule;
  return c;
}

}  // namespace

sim::Case ship_in_waves(std::int64_t cells) {
  // Counts need the hull's place, not its fine table: a model of coarse cells does.
  const auto rough = ship_model(on_mesh(3, 1));
  const auto count = [&](int halvings, double size) {
    sim::Model<3> model = *rough;
    const sim::Case c = on_mesh(halvings, size);
    model.description = c;
    for (int a = 0; a < 3; ++a) {
      model.grid.lower[a] = c.tank.lower[a];
      model.grid.upper[a] = c.tank.upper[a];
    }
    return sim::make_forest<3>(model, c.stages.front().mesh, 1)->n_cells();
  };
  constexpr double smallest = 0.75, largest = 1.5;
  int halvings = 3;
  while (halvings < 7 && count(halvings, smallest) < cells) ++halvings;
  double low = smallest, high = largest;
  while (high - low > 0.01) {
    const double middle = 0.5 * (low + high);
    (count(halvings, middle) > cells ? low : high) = middle;
  }
  const auto miss = [&](double size) { return std::abs(count(halvings, size) - cells); };
  return on_mesh(halvings, miss(low) < miss(high) ? low : high);
}

std::shared_ptr<const sim::Model<3>> ship_model(const sim::Case& c) {
  return std::make_shared<const sim::Model<3>>(sim::make_model<3>(c));
}

}  // namespace seaway::validation
