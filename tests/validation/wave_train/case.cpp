// [wave_train] A regular wave after ten periods in a periodic box; see README.md beside this file.
#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double height = WaveBox::height, period = WaveBox::period;

/// Surface over one wavelength.
struct Profile {
  double crest_to_trough = 0;
  std::complex<double> first_harmonic;
};

Profile profile_of(const Section& run, int columns) {
  const double lower = run.forest().grid().lower[0];
  const double length = run.forest().grid().upper[0] - lower;
  Record space;  // over phase instead of time
  for (int i = 0; i < columns; ++i) {
    const double y = lower + length * (i + 0.5) / columns;
    space.add(2 * pi * (i + 0.5) / columns, run.elevation(0, y));
  }
  Profile out;
  out.first_harmonic = harmonic(space, 1, 0);
  const auto [low, high] = std::minmax_element(space.value.begin(), space.value.end());
  out.crest_to_trough = *high - *low;
  return out;
}

}  // namespace

void run_wave_train(const Context& context, Results& results) {
  // Four halvings give 4.0 mm, 15.3 cells a height (one fewer in the quick suite), coarser than the bars allow.
  const int columns = 48 << (context.quick() ? 3 : 4);
  const sim::Case c = WaveBox::with_columns(columns);
  const auto run = start(c, context.threads);

  const double duration = 10 * period;
  const Profile first = profile_of(*run, columns);
  Record phase;
  phase.add(0, std::arg(first.first_harmonic));
  const double water = run->water().visible;
  while (run->time() < duration - 1e-9) {
    step(*run);
    phase.add(run->time(), std::arg(profile_of(*run, columns).first_harmonic));
  }
  const Profile last = profile_of(*run, columns);
  unwrap(phase.value);
  const double omega = std::abs(slope(phase));  // crests move by one box a period
  const double loss = 1 - last.crest_to_trough / first.crest_to_trough;
  // Bars of the reference set: 80 x 16 cells a wavelength and height, and 40 x 8.
  results.expect_below("height_loss", std::abs(loss), "1", context.quick() ? 0.06 : 0.02);
  results.expect_below("speed_error", std::abs(omega * period / (2 * pi) - 1), "1",
                       context.quick() ? 0.01 : 0.005);
  results.report("first_harmonic_loss",
                 1 - std::abs(last.first_harmonic) / std::abs(first.first_harmonic), "1");
  // The tank is open at the top for air only: water can neither leave nor enter.
  results.expect_below("water_change", std::abs(run->water().visible / water - 1), "1", 1e-6);
  results.report("cells", static_cast<double>(run->forest().n_cells()), "1");
  results.report("start_height_error", std::abs(first.crest_to_trough / height - 1), "1");
}

}  // namespace seaway::validation
