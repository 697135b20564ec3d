// [oblique_wave] A regular wave across the corners of a tank with zones at all four sides; see README.md beside this file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/waves/wave_field.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double period = 1.4, height = 0.16;               // [s], [m]
constexpr double base = 0.2, cell = 0.05;                   // [m]
constexpr double reach = 3.2, depth = 1.6, air = 0.8, zone = 1.6;  // of the tank [m]

sim::Case tank(double heading) {
  sim::Case c;
  c.title = "oblique wave";
  c.dim = 3;
  c.base_cell = base;
  c.tank.lower = {-reach, -reach, -depth};
  c.tank.upper = {reach, reach, air};
  c.wave.kind = sim::Wave::Kind::regular;
  c.wave.theory = sim::Wave::Theory::stream_function;
  c.wave.height = height;
  c.wave.period = period;
  c.wave.heading = heading;
  c.zones.generation_length = zone;
  c.zones.absorption_length = zone;
  c.time.dt = period / 100;
  sim::Stage stage;
  stage.name = "only";
  stage.mesh.surface = {{cell, 0.15}};
  c.stages = {stage};
  return c;
}

struct Seen {
  double height_error = 0, phase_error = 0;  ///< largest of the gauges; [1], [rad]
  double level = 0;                          ///< mean over the last period, largest of the gauges, over the height
  std::int64_t cells = 0;
};

/// Gauges in the free middle of the tank, over the last period of `periods`, against the exact wave there.
Seen run_tank(double heading, int periods, int threads) {
  const sim::Case c = tank(heading);
  const auto model = std::make_shared<const sim::Model<3>>(sim::make_model<3>(c));
  const auto run = start<3>(model, threads);
  const std::vector<Vec2> gauges{{0.013, 0.017}, {-0.9, 0.7}, {0.8, 0.9}, {0.6, -1.1}};
  std::vector<Record> seen(gauges.size()), exact(gauges.size());
  const double from = (periods - 1) * period;
  while (run->time() < periods * period - 1e-9) {
    step<3>(*run);
    if (run->time() <= from + 1e-9) continue;
    for (std::size_t g = 0; g < gauges.size(); ++g) {
      seen[g].add(run->time(), run->elevation(gauges[g].x(), gauges[g].y()));
      exact[g].add(run->time(), model->wave->elevation(gauges[g].x(), gauges[g].y(), run->time()));
    }
  }
  Seen out;
  out.cells = run->forest().n_cells();
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    const double omega = 2 * pi / period;
    const std::complex<double> ratio = harmonic(seen[g], omega, from) / harmonic(exact[g], omega, from);
    out.height_error = std::max(out.height_error, std::abs(std::abs(ratio) - 1));
    out.phase_error = std::max(out.phase_error, std::abs(std::arg(ratio)));
    double mean = 0;
    for (const double v : seen[g].value) mean += v / static_cast<double>(seen[g].value.size());
    out.level = std::max(out.level, std::abs(mean) / height);
  }
  return out;
}

}  // namespace

void run_oblique_wave(const Context& context, Results& results) {
  const int periods = context.quick() ? 2 : 4;
  for (const double heading : context.quick() ? std::vector<double>{30.0} : std::vector<double>{90.0, 30.0, -135.0}) {
    const Seen seen = run_tank(heading * degree, periods, context.threads);
    const std::string suffix = fmt::format("_{:g}deg", heading);
    results.expect_below("height_error" + suffix, seen.height_error, "1", 0.05);
    results.expect_below("phase_error" + suffix, seen.phase_error, "rad", 0.15);
    results.report("mean_level" + suffix, seen.level, "1");
    results.report("cells" + suffix, static_cast<double>(seen.cells), "1");
  }
}

}  // namespace seaway::validation
