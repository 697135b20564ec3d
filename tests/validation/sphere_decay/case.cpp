// [sphere_decay] Heave of the floating sphere of Kramer et al. let go above its place on three meshes; see README.md.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/heave_decay.hpp"
#include "tests/validation/support/linear_heave.hpp"

namespace seaway::validation {
namespace {

constexpr double radius = 0.15, release_height = 0.03;
constexpr double base_cell = 0.36;
constexpr double gravity = 9.82;
constexpr double duration = 1.3;  // [s], three turning points

// Means of four repetitions; see README.md.
constexpr double measured_period = 0.7869;
constexpr double measured_peak_1 = -24.929 / 29.124;

sim::Case sphere(double h) {
  sim::Case c;
  c.title = "floating sphere";
  c.dim = 3;
  c.fluids.rho_water = 998.2;
  c.fluids.gravity = gravity;
  c.base_cell = base_cell;
  // The surface lies a third up in the blocks of every level; 32 cells of the finest mesh hold the radius and a margin.
  const double block = 8 * base_cell;
  c.tank.lower = {-2 * block, -2 * block, -block / 3};
  c.tank.upper = {2 * block, 2 * block, 2 * block / 3};
  c.hull.shape = sim::Hull::Shape::sphere;
  c.hull.radius = radius;
  // Afloat half submerged, air on the upper half.
  c.body.mass = 0.5 * (c.fluids.rho_water + c.fluids.rho_air) * 4 / 3 * pi * std::pow(radius, 3);
  c.body.cog = {0, 0, radius - 0.0348};
  c.body.gyradii = {0.1, 0.1, 0.1};  // held in rotation: not used
  c.body.free = {sim::Dof::heave};
  c.body.draft = radius;
  c.body.offset = {0, 0, release_height};
  c.time.dt = 0.006;
  const double margin = 5 * h, reach = radius + margin, lift = release_height;
  sim::Stage stage;
  stage.mesh.boxes = {{h, {-reach, -reach, -reach - lift}, {reach, reach, reach + lift}}};
  stage.mesh.surface = {{2 * h, 0.015, 0.3}, {4 * h, 0.015, 0.8}, {8 * h, 0.015, 1.5}};
  c.stages = {stage};
  return c;
}

/// In seconds and metres.
Record linear_decay() {
  const double unit = std::sqrt(radius / gravity);
  Record r = linear_heave_decay(3, duration / unit, 0.05);
  for (double& t : r.t) t *= unit;
  for (double& v : r.value) v *= release_height;
  return r;
}

}  // namespace

void run_sphere_decay(const Context& context, Results& results) {
  std::array<HeaveDecay, 3> runs;
  std::vector<Curve> curves;
  double h = base_cell / 16;
  for (HeaveDecay& run : runs) {
    run = run_heave_decay(sphere(h), duration, context.threads);
    curves.push_back({std::to_string(h * 1000).substr(0, 4) + " mm", run.heave.t, run.heave.value});
    h /= 2;
  }
  report_refinement(runs, base_cell / 16, release_height, 0.01, results);
  results.expect_near("period", runs[2].period(), "s", measured_period, 0.01 * measured_period);
  results.expect_near("peak_1", runs[2].peak(1) / release_height, "1", measured_peak_1, 0.02 * std::abs(measured_peak_1));
  HeaveDecay linear;
  linear.heave = linear_decay();
  results.report("linear_period", linear.period(), "s");
  for (std::size_t i = 1; i <= 3; ++i)
    results.report("linear_peak_" + std::to_string(i), linear.peak(i) / release_height, "1");
  curves.push_back({"linear theory", linear.heave.t, linear.heave.value});
  results.plot({"floating sphere let go at 30 mm", "t, s", "heave, m", curves});
}

}  // namespace seaway::validation
