// [ship_held] A held ship in calm water makes no currents and feels its hydrostatics; see README.md beside this file.
#include <cmath>

#include "core/hull/ship_hydrostatics.hpp"
#include "core/hull/surface_hull.hpp"
#include "core/sim/simulation.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double cell = 0.01;
constexpr double heel = 15 * degree;

sim::Case held_ship() {
  sim::Case c;
  c.dim = 3;
  c.title = "DTMB 5415 held at 15 degrees";
  c.folder = SEAWAY_EXAMPLES;
  c.tank.lower = {-2.56, -1.28, -1.7067};
  c.tank.upper = {2.56, 1.28, 0.8533};
  c.base_cell = 0.32;
  c.stretch_x = 2;
  c.hull.shape = sim::Hull::Shape::offsets_hull;
  c.hull.offsets_file = "dtmb5415_offsets.csv";
  c.hull.station = 71;
  c.hull.scale = 51;
  c.body.mass = 63.5;
  c.body.cog = {-0.0142, 0, 0.148};
  c.body.gyradii = {0.13, 0.7, 0.7};
  c.body.draft = 0.1206;
  c.body.angles = {heel, 0, 0};
  c.time.dt = 0.0125;
  // What is asked is whether forces balance, not how far the solver goes.
  c.numerics.pressure_tolerance = 1e-9;
  sim::Stage stage;
  stage.mesh.hull_cell = cell;
  stage.mesh.hull_sweep = 16 * degree;
  stage.mesh.hull_margin = 4 * cell;
  stage.mesh.hull_heave = 0.01;
  stage.mesh.surface = {{0.08, 0.04}};
  c.stages = {stage};
  return c;
}

}  // namespace

void run_ship_held(const Context& context, Results& results) {
  const sim::Case c = held_ship();
  const auto model = std::make_shared<sim::Model<3>>(sim::make_model<3>(c));
  const auto started = start<3>(model, context.threads);
  sim::Simulation<3>& run = *started;
  double largest = 0;
  for (int i = 0; i < 40; ++i) {
    step(run);
    largest = std::max(largest, max_velocity(run));
  }
  // The polyhedron's own hydrostatics, air's buoyancy included.
  const auto& ship = dynamic_cast<const hull::SurfaceHull&>(*model->hull).ship();
  // The calm level over the hull's origin, measured vertically.
  const double waterline = std::cos(heel) * c.body.cog.z() - run.body().pose.cog.z();
  const auto water = hull::hydrostatics(ship.solid, {waterline, heel, 0});
  const double jump = c.fluids.rho_water - c.fluids.rho_air, g = c.fluids.gravity;
  const double whole = hull::enclosed_volume(ship.outer);
  const double buoyancy = g * (jump * water.volume + c.fluids.rho_air * whole);
  results.expect_below("max_velocity", largest, "m/s", 1e-5);
  results.expect_below("buoyancy_error", std::abs(run.load()[2] / buoyancy - 1), "1", 2e-3);
  // Lever of the roll moment about the cog against the centre of buoyancy's, over the beam.
  const Vec3 lever = hull::levers(water, {waterline, heel, 0}, c.body.cog);
  const double centre = run.load()[3] / run.load()[2] - lever.y();
  results.expect_below("centre_error", std::abs(centre) / 0.374, "1", 2e-3);
  results.report("cells", static_cast<double>(run.forest().n_cells()), "1");
}

}  // namespace seaway::validation
