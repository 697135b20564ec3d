// [wave_train_rans] A regular wave with k-epsilon in a periodic box; see README.md beside this file.
#include <algorithm>
#include <cmath>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/one_fluid.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {
namespace {

using Model = sim::Turbulence::Model;

constexpr double height = WaveBox::height, period = WaveBox::period;

struct Train {
  double loss = 0;           ///< of the crest-to-trough height
  double largest = 0;        ///< nu_t / nu of water below the surface layer
  double largest_start = 0;
};

/// nu_t / nu more than a wave height below z = 0.
double viscosity_ratio(const Section& run) {
  double largest = 0;
  if (!run.turbulence()) return 0;
  each_cell(run, [&](int b, int i, const Vec2& x) {
    if (x[1] < -height) largest = std::max(largest, run.turbulence()->nu_t().block(b)[i]);
  });
  return largest / run.model().fluids.nu_water;
}

double crest_to_trough(const Section& run, int columns) {
  const double lower = run.forest().grid().lower[0];
  const double length = run.forest().grid().upper[0] - lower;
  double low = 1e9, high = -1e9;
  for (int i = 0; i < columns; ++i) {
    const double z = run.elevation(0, lower + length * (i + 0.5) / columns);
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return high - low;
}

Train run_train(Model model, int halvings, double periods, int threads) {
  const int columns = 48 << halvings;
  sim::Case c = WaveBox::with_columns(columns);
  c.turbulence.model = model;
  const auto run = start(c, threads);
  Train out;
  const double first = crest_to_trough(*run, columns);
  out.largest_start = viscosity_ratio(*run);
  while (run->time() < periods * period - 1e-9) {
    step(*run);
    out.largest = std::max(out.largest, viscosity_ratio(*run));
  }
  out.loss = 1 - crest_to_trough(*run, columns) / first;
  return out;
}

}  // namespace

void run_wave_train_rans(const Context& context, Results& results) {
  // 7.6 cells a wave height, the quick suite 3.8.
  const int halvings = context.quick() ? 2 : 3;
  const double periods = context.quick() ? 10 : 20;
  const Train laminar = run_train(Model::laminar, halvings, periods, context.threads);
  const Train stabilised = run_train(Model::stabilised, halvings, periods, context.threads);
  // Bars of the project.
  results.expect_below("height_loss_difference", std::abs(stabilised.loss - laminar.loss), "1", 0.01);
  results.expect_below("nu_t_over_nu", stabilised.largest, "1", 10);
  results.report("height_loss_laminar", laminar.loss, "1");
  results.report("height_loss_stabilised", stabilised.loss, "1");
  results.report("nu_t_over_nu_start", stabilised.largest_start, "1");
  if (context.quick()) return;
  const Train standard = run_train(Model::standard, halvings, periods, context.threads);
  results.report("height_loss_standard", standard.loss, "1");
  // The growth that the limiter removes must be there without it, or this case shows nothing.
  results.expect_above("nu_t_over_nu_standard", standard.largest, "1", 10 * stabilised.largest);
}

}  // namespace seaway::validation
