// [rayleigh_taylor] A heavy fluid over a light one: growth against linear theory; see README.md beside this file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/field/restrict.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/one_fluid.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {
namespace {

constexpr double length = 1, k = 2 * pi / length, gravity = 9.81;  // [m], [1/m], [m/s2]
constexpr double rho_heavy = 3, rho_light = 1;
constexpr double start_amplitude = 0.001 * length;
constexpr double growth = 6;  // of the amplitude; k a stays below 0.04

/// Two layers of depth `length` between slip walls, without viscosity [chandrasekhar1961].
double exact_rate() {
  const double atwood = (rho_heavy - rho_light) / (rho_heavy + rho_light);
  return std::sqrt(atwood * gravity * k * std::tanh(k * length));
}

/// Amplitude over its start value, from rest.
double exact_amplitude(double t) { return std::cosh(exact_rate() * t); }

/// Heavy fluid above a cosine of half a wave.
void fill_layers(Section& run, double h) {
  each_cell(run, [&](int b, int i, const Vec2& x) {
    const double mean = std::sin(0.5 * k * h) / (0.5 * k * h) * std::cos(k * x[0]);  // over the cell's breadth
    run.state().vof.block(b)[i] = std::clamp((x[1] - start_amplitude * mean) / h + 0.5, 0.0, 1.0);
  });
  field::restrict_cells<double, 2>(run.forest(), run.state().vof);
}

/// Harmonic of the interface's height, half a wave long.
double amplitude_of(const Section& run, int cells) {
  double harmonic = 0;
  for (int i = 0; i < cells / 2; ++i) {
    const double y = (i + 0.5) * length / cells;
    harmonic -= 4.0 / cells * run.elevation(0, y) * std::cos(k * y);  // the heavy fluid is what is counted
  }
  return harmonic;
}

/// Amplitude over start_amplitude until it should have grown by `growth`; times count from rest.
Record grow(int cells, int threads) {
  const double h = length / cells;
  sim::Case c = one_fluid_tank(0, -length, cells / 2, 2 * cells, h, 1e-6);
  c.fluids.rho_water = rho_heavy;
  c.fluids.rho_air = rho_light;
  c.fluids.gravity = gravity;
  c.fluids.viscous = false;
  c.numerics.pressure_tolerance = 1e-8;
  const double duration = std::acosh(growth) / exact_rate();
  c.time.dt = duration / (2 * cells);
  const auto run = start(c, threads);
  fill_layers(*run, h);
  const double unit = amplitude_of(*run, cells);
  Record out;
  while (run->time() < duration) {
    step(*run);
    out.add(run->time() - 0.5 * run->dt(), amplitude_of(*run, cells) / unit);  // velocities were 0 half a step after the start
  }
  return out;
}

/// Rate with which the last amplitude would have been reached.
double rate_of(const Record& r) { return std::acosh(r.value.back()) / r.t.back(); }

}  // namespace

void run_rayleigh_taylor(const Context& context, Results& results) {
  const std::vector<int> meshes = context.quick() ? std::vector<int>{32, 64} : std::vector<int>{64, 128, 256};
  Refinement rates{"growth_rate", "1/s", {}, {}, 1, exact_rate()};
  Plot plot{"growth of the amplitude", "t, s", "a / a_0", {}};
  std::vector<double> errors;
  for (const int cells : meshes) {
    const Record r = grow(cells, context.threads);
    rates.h.push_back(length / cells);
    rates.value.push_back(rate_of(r));
    errors.push_back(std::abs(rate_of(r) / exact_rate() - 1));
    results.report(fmt::format("growth_error_{}", cells), errors.back(), "1");
    plot.curves.push_back({fmt::format("{} cells", cells), r.t, r.value});
  }
  Curve exact{"linear theory", {}, {}, true};
  const double end = std::acosh(growth) / exact_rate();
  for (int i = 0; i <= 20; ++i) {
    exact.x.push_back(end * i / 20);
    exact.y.push_back(exact_amplitude(end * i / 20));
  }
  plot.curves.push_back(exact);
  results.plot(plot);
  results.refinement(rates);
  results.report("exact_rate", exact_rate(), "1/s");
  const std::size_t n = errors.size();
  results.expect_below("growth_error", errors.back(), "1", context.quick() ? 0.03 : 0.01);
  results.expect_above("order", std::log2(errors[n - 2] / errors[n - 1]), "1", 0.9);
}

}  // namespace seaway::validation
