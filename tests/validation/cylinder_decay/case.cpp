// [cylinder_decay] Heave of a half-submerged cylinder let go above its place on three meshes; see README.md.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/heave_decay.hpp"
#include "tests/validation/support/linear_heave.hpp"

namespace seaway::validation {
namespace {

constexpr double radius = 0.0762;  // half of six inches
constexpr double inch = 0.0254;
constexpr double duration = 1.4;  // [s], four turning points

/// 360 corners outside the circle, with its area.
std::vector<std::array<double, 2>> circle() {
  constexpr int corners = 360;
  const double reach = radius * std::sqrt(2 * pi / corners / std::sin(2 * pi / corners));
  std::vector<std::array<double, 2>> vertices;
  for (int i = 0; i <= corners; ++i) {
    const double angle = 2 * pi * ((i % corners) + 0.5) / corners;
    vertices.push_back({reach * std::sin(angle), radius - reach * std::cos(angle)});
  }
  return vertices;
}

sim::Case cylinder(double release_height, double h) {
  sim::Case c;
  c.title = "half-submerged cylinder";
  c.base_cell = 4 * radius;
  // The surface lies a third up in the blocks of every level. Deep and wide: see README.md.
  const double block = 16 * c.base_cell;
  c.tank.lower = {0, -4 * block, -7.0 / 3 * block};
  c.tank.upper = {0, 4 * block, 2.0 / 3 * block};
  c.hull.shape = sim::Hull::Shape::polygon;
  c.hull.vertices = circle();
  // Afloat half submerged, air on the upper half.
  c.body.mass = 0.5 * (c.fluids.rho_water + c.fluids.rho_air) * pi * radius * radius;
  c.body.cog = {0, 0, radius};
  c.body.gyradii = {0.5 * radius, 0, 0};  // held in roll: not used
  c.body.free = {sim::Dof::heave};
  c.body.draft = radius;
  c.body.offset = {0, 0, release_height};
  c.time.dt = 0.004;
  sim::Stage stage;
  stage.mesh.hull_cell = h;
  stage.mesh.hull_margin = 8 * h;
  stage.mesh.hull_sweep = 0;
  stage.mesh.hull_heave = 1.8 * inch;
  stage.mesh.surface = {{h, 0.03, 0.5}, {2 * h, 0.03, 1.2}, {4 * h, 0.03, 2.4}};
  c.stages = {stage};
  return c;
}

HeaveDecay let_go(double release_height, int cells_a_diameter, int threads) {
  return run_heave_decay(cylinder(release_height, 2 * radius / cells_a_diameter), duration, threads);
}

/// In seconds and metres.
Record linear_decay(double release_height) {
  const double unit = std::sqrt(radius / 9.81);
  Record r = linear_heave_decay(2, duration / unit, 0.05);
  for (double& t : r.t) t *= unit;
  for (double& v : r.value) v *= release_height;
  return r;
}

/// One inch: no exact answer, but one that does not depend on the mesh.
void report_convergence(const Context& context, Results& results) {
  const std::array<int, 3> meshes{32, 64, 128};
  std::array<HeaveDecay, 3> runs;
  for (std::size_t i = 0; i < 3; ++i) runs[i] = let_go(inch, meshes[i], context.threads);
  report_refinement(runs, 2 * radius / meshes[0], inch, 0.005, results);
  const Record linear = linear_decay(inch);
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < runs.size(); ++i)
    curves.push_back({"D/" + std::to_string(meshes[i]), runs[i].heave.t, runs[i].heave.value});
  curves.push_back({"linear theory", linear.t, linear.value});
  results.plot({"half-submerged cylinder let go at one inch", "t, s", "heave, m", curves});
}

/// A tenth of that: linear theory.
void compare_with_linear_theory(const Context& context, Results& results) {
  const double release = 0.1 * inch;
  const HeaveDecay run = let_go(release, 64, context.threads);
  HeaveDecay linear;
  linear.heave = linear_decay(release);
  results.expect_near("small_period", run.period(), "s", linear.period(), 0.005 * linear.period());
  for (std::size_t i = 1; i <= 3; ++i)
    results.expect_near("small_peak_" + std::to_string(i), run.peak(i) / release, "1", linear.peak(i) / release,
                        0.02 * std::abs(linear.peak(i) / release));
}

}  // namespace

void run_cylinder_decay(const Context& context, Results& results) {
  compare_with_linear_theory(context, results);
  report_convergence(context, results);
}

}  // namespace seaway::validation
