// [spheric10] Side impact in a sloshing tank: SPHERIC test 10, water, 93 mm; see README.md beside this file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/closed_tank.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {
namespace {

constexpr double breadth = 0.9, height = 0.508, fill = 0.093, wall = 0.03;  // [m]
constexpr double period = 1.630, amplitude = 4 * degree;
constexpr double mbar = 100;             // [Pa]
constexpr double band_low = 26.8 * mbar, band_high = 54.8 * mbar;  // 2.5 and 97.5 percentiles of 102 first peaks
constexpr double impact_from = 10 * mbar;  // a head of 0.1 m: more than the sensor sees of water that only stands there

/// The tank as a hull of 30 mm walls in an air-filled space; it turns about the middle of its floor.
sim::Case rolling_tank(double h, double base_cell) {
  sim::Case c = closed_tank_case({breadth, height, fill, wall}, 0, h);
  c.title = "SPHERIC test 10";
  c.base_cell = base_cell;
  c.tank.lower = {0, -0.64, -0.40};
  c.tank.upper = {0, 0.64, 0.88};
  c.fluids.rho_water = 998;
  c.fluids.nu_water = 8.94e-4 / 998;
  // Ramped over a quarter of the period: the first swing is the first one of full size.
  c.body.prescribed = {{sim::Dof::roll, amplitude, period, period / 4}};
  c.time.dt = 0.2 * h;  // [s]: waves and jets of 1 m/s cross a fifth of a cell
  // Sensors at the calm level in both side walls, and in the air under the lid, against which pressures are given.
  c.outputs.probes = {{"starboard", true, {0, -0.5 * breadth, wall + fill}},
                      {"port", true, {0, 0.5 * breadth, wall + fill}},
                      {"air", true, {0, 0, wall + height - 0.02}}};
  sim::Stage& stage = c.stages.front();
  stage.mesh.hull_sweep = 6 * degree;
  stage.mesh.hull_heave = 0.01;
  stage.end.duration = 1;
  return c;
}

struct Impact {
  double time = std::nan(""), peak = std::nan(""), impulse = 0;  ///< [s], [Pa], [Pa s]
};
/// The largest pressure in the half period after it first exceeds impact_from, and its integral over the 10 ms about it.
Impact first_impact(const Record& r) {
  Impact out;
  double begin = 1e300;
  for (std::size_t i = 0; i < r.t.size(); ++i) {
    if (r.value[i] > impact_from) begin = std::min(begin, r.t[i]);
    if (r.t[i] < begin || r.t[i] > begin + 0.5 * period || r.value[i] <= out.peak) continue;
    out.time = r.t[i];
    out.peak = r.value[i];
  }
  for (std::size_t i = 1; i < r.t.size(); ++i)
    if (std::abs(r.t[i] - out.time) <= 0.005) out.impulse += r.value[i] * (r.t[i] - r.t[i - 1]);
  return out;
}

struct Sloshing {
  Record starboard, port;  ///< pressures less that of the air [Pa]
  std::int64_t cells = 0;
  double water_error = 0;
};

Sloshing slosh(double h, double base_cell, double duration, int threads) {
  const auto run = start(rolling_tank(h, base_cell), threads);
  empty_the_sea(*run);
  const auto& probes = run->model().description.outputs.probes;
  const double water = run->water().visible;
  Sloshing out;
  out.cells = run->forest().n_cells();
  while (run->time() < duration) {
    step(*run);
    const double air = run->pressure(probes[2]);
    out.starboard.add(run->time(), run->pressure(probes[0]) - air);
    out.port.add(run->time(), run->pressure(probes[1]) - air);
    const sim::WaterBalance balance = run->water();
    out.water_error = std::max(out.water_error, std::abs((balance.visible + balance.reservoir) / water - 1));
  }
  return out;
}

void report_side(const std::string& suffix, const Impact& impact, Results& results) {
  results.report("water_peak_1_mbar" + suffix, impact.peak / mbar, "mbar");
  results.report("time_of_peak_1" + suffix, impact.time, "s");
  results.report("impulse_of_peak_1" + suffix, impact.impulse, "Pa s");
}

}  // namespace

void run_spheric10(const Context& context, Results& results) {
  struct Mesh {
    const char* name;
    double h, base;
  };
  std::vector<Mesh> meshes{{"10mm", 0.010, 0.040}, {"6.7mm", 0.02 / 3, 0.08 / 3}, {"5mm", 0.005, 0.040}};
  if (context.quick()) meshes.resize(1);
  int inside = 0;
  for (const Mesh& mesh : meshes) {
    const Sloshing run = slosh(mesh.h, mesh.base, context.quick() ? 2.4 : 3.4, context.threads);
    const std::string suffix = std::string("_") + mesh.name;
    const Impact first = first_impact(run.starboard);
    inside += first.peak >= band_low && first.peak <= band_high ? 1 : 0;
    report_side(suffix, first, results);
    if (!context.quick()) report_side(suffix + ".other_side", first_impact(run.port), results);
    // What the pressure solve leaves in a step, some thousand times.
    results.expect_below("water_error" + suffix, run.water_error, "1", 1e-3);
    results.report("cells" + suffix, static_cast<double>(run.cells), "1");
    Curve band_of_runs{"measured band of the first peak", {first.time, first.time}, {band_low, band_high}, true};
    results.plot({fmt::format("pressure at the walls, {}", mesh.name), "t, s", "Pa",
                  {{"first wall", run.starboard.t, run.starboard.value}, {"other wall", run.port.t, run.port.value}, band_of_runs}});
  }
  if (context.quick()) return;
  // Bar of the project.
  results.expect_above("water_peak_1_mbar.meshes_inside", inside, "1", 2);
}

}  // namespace seaway::validation
