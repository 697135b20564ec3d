// [wave_across_levels] A regular wave over a surface with finer cells along half its length; see README.md.
#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double period = WaveBox::period;

struct WaveRun {
  double amplitude_loss = 0, speed_error = 0, reflection = 0, water_change = 0;
  std::int64_t cells = 0;
};

/// First harmonic in space of the elevation, by the columns of the finest cells.
std::complex<double> first_harmonic(const Section& run, int columns) {
  const auto& grid = run.forest().grid();
  Record space;  // over phase instead of time
  for (int i = 0; i < columns; ++i)
    space.add(2 * pi * (i + 0.5) / columns,
              run.elevation(0, grid.lower[0] + (grid.upper[0] - grid.lower[0]) * (i + 0.5) / columns));
  return harmonic(space, 1, 0);
}

/// Parts that go with and against the wave of the harmonics a(t) = A exp(-i w t) + B exp(i w t): means over whole periods.
double reflection_of(const std::vector<double>& t, const std::vector<std::complex<double>>& a, double omega) {
  std::complex<double> with = 0, against = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const std::complex<double> turn(std::cos(omega * t[i]), std::sin(omega * t[i]));
    with += a[i] * turn;
    against += a[i] * std::conj(turn);
  }
  const double one = std::abs(with), other = std::abs(against);
  return std::min(one, other) / std::max(one, other);
}

WaveRun run_wave(int columns, bool patch, int periods, int threads) {
  sim::Case c = WaveBox::with_columns(columns);
  const double length = c.tank.upper.y() - c.tank.lower.y();
  if (patch) c.stages.front().mesh.boxes = {{0.5 * length / columns, {0, 0, -0.06}, {0, 0.5 * length, 0.06}}};
  const auto run = start(c, threads);
  WaveRun out;
  out.cells = run->forest().n_cells();
  std::vector<double> t;
  std::vector<std::complex<double>> a;
  Record phase;
  const double water = run->water().visible, first = std::abs(first_harmonic(*run, 2 * columns));
  while (run->time() < periods * period - 1e-9) {
    step(*run);
    a.push_back(first_harmonic(*run, 2 * columns));
    t.push_back(run->time());
    phase.add(run->time(), std::arg(a.back()));
  }
  unwrap(phase.value);
  out.amplitude_loss = 1 - std::abs(a.back()) / first;
  out.speed_error = std::abs(slope(phase)) * period / (2 * pi) - 1;
  out.reflection = reflection_of(t, a, 2 * pi / period);
  out.water_change = std::abs(run->water().visible / water - 1);
  return out;
}

}  // namespace

void run_wave_across_levels(const Context& context, Results& results) {
  const int columns = context.quick() ? 192 : 384, periods = context.quick() ? 2 : 5;
  const WaveRun with = run_wave(columns, true, periods, context.threads);
  const WaveRun without = run_wave(columns, false, periods, context.threads);
  results.expect_below("reflection", with.reflection, "1", context.quick() ? 0.02 : 0.01);
  results.expect_below("loss_beyond_uniform", with.amplitude_loss - without.amplitude_loss, "1", 0.01);
  results.expect_below("speed_error", std::abs(with.speed_error), "1", context.quick() ? 0.01 : 0.005);
  results.expect_below("water_change", with.water_change, "1", 1e-6);
  results.report("reflection_uniform", without.reflection, "1");
  results.report("amplitude_loss", with.amplitude_loss, "1");
  results.report("amplitude_loss_uniform", without.amplitude_loss, "1");
  results.report("speed_error_uniform", without.speed_error, "1");
  results.report("cells", static_cast<double>(with.cells), "1");
}

}  // namespace seaway::validation
