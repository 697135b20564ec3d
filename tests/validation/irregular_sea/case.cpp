// SPDX-License-Identifier: GPL-3.0-or-later
// [irregular_sea] A JONSWAP sea against the linear sum of its components; see README.md beside this file.
#include <array>
#include <cmath>

#include "core/analysis/wave_gauges.hpp"
#include "core/sim/build_wave.hpp"
#include "core/waves/airy.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double period = 1.4;

sim::Case sea_in_tank(double cell) {
  sim::Case c;
  // Whole blocks of 16 cells, with a row of fine ones about z = 0.
  c.base_cell = 0.08;
  c.tank.lower = {0, -5.12, -1.12};
  c.tank.upper = {0, 5.12, 0.16};
  c.wave.kind = sim::Wave::Kind::irregular;
  c.wave.spectrum.shape = sim::Wave::Spectrum::Shape::jonswap;
  c.wave.spectrum.peak_period = period;
  c.wave.significant_height = 0.06;
  c.zones.generation_length = 3.1;
  c.zones.absorption_length = 3.1;
  sim::Stage stage;
  stage.mesh.surface = {{cell, 0.075}};
  c.stages = {stage};
  return c;
}

}  // namespace

void run_irregular_sea(const Context& context, Results& results) {
  const sim::Case c = sea_in_tank(context.quick() ? 0.04 : 0.02);
  const auto run = start(c, context.threads);
  const waves::WaveField& wave = *run->model().wave;
  // Distances of 0.12 and 0.29 wavelengths at the peak; no two gauges half a wave apart where there is energy.
  const std::array<double, 3> places{0.2, 0.57, 1.09};
  const double water = run->water().visible;
  std::array<Record, 3> found;
  Record asked;
  // Energy goes at half the speed of crests: after ten periods what began in the tank has left it.
  const double settled = 10 * period, end = settled + (context.quick() ? 5 : 100) * period;
  while (run->time() < end - 1e-9) {
    step(*run);
    if (run->time() < settled) continue;
    for (std::size_t g = 0; g < places.size(); ++g) found[g].add(run->time(), run->elevation(0, places[g]));
    asked.add(run->time(), wave.elevation(0, places[0], run->time()));
  }
  // Ten peak periods of both.
  const auto last_part = [&](const Record& r, const char* label, bool reference) {
    Curve curve{label, {}, {}, reference};
    for (std::size_t i = 0; i < r.t.size(); ++i) {
      if (r.t[i] < end - 10 * period || (reference && i % 8 != 0)) continue;
      curve.x.push_back(r.t[i]);
      curve.y.push_back(r.value[i]);
    }
    return curve;
  };
  results.plot({"elevation at the first gauge", "t, s", "m",
                {last_part(found[0], "computed", false), last_part(asked, "linear sum", true)}});
  const auto signal = [](const Record& r) { return analysis::Signal{r.t, r.value}; };
  const auto f = analysis::frequencies_of(asked.t.back() - asked.t.front(), 0.5 / period, 2.5 / period);
  std::vector<double> k;
  for (const double one : f) k.push_back(waves::linear_wave_number(2 * pi * one, wave.depth(), wave.gravity()));
  std::vector<analysis::Gauge> gauges;
  for (std::size_t g = 0; g < places.size(); ++g) gauges.push_back({places[g], analysis::transform(signal(found[g]), f)});
  const double width = 0.05 / period;  // of the smoothing
  const double hs = analysis::significant_height(signal(found[0])), hs_asked = analysis::significant_height(signal(asked));
  const double peak = analysis::peak_period(f, gauges[0].amplitudes, width);
  const double peak_asked = analysis::peak_period(f, analysis::transform(signal(asked), f), width);
  double difference = 0;
  for (std::size_t i = 0; i < asked.t.size(); ++i) difference += std::pow(found[0].value[i] - asked.value[i], 2);
  // The quick form has waves of one and a half cells: it shows that the sea runs, not how well.
  results.expect_below("hs_error", std::abs(hs / hs_asked - 1), "1", context.quick() ? 0.2 : 0.03);
  results.expect_below("peak_error", std::abs(peak / peak_asked - 1), "1", context.quick() ? 0.1 : 0.03);
  if (context.quick())
    results.report("reflection", analysis::separate(gauges, k).reflection, "1");
  else
    results.expect_below("reflection", analysis::separate(gauges, k).reflection, "1", 0.05);
  results.report("hs", hs, "m");
  results.report("peak_period", peak, "s");
  results.report("difference_rms_over_hs", std::sqrt(difference / static_cast<double>(asked.t.size())) / hs_asked, "1");
  results.report("water_drift_over_hs", (run->water().visible - water) / 10.24 / hs_asked, "1");
  results.report("cells", static_cast<double>(run->forest().n_cells()), "1");
}

}  // namespace seaway::validation
