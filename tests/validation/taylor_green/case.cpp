// [taylor_green] A decaying vortex in a periodic box against its exact solution; see README.md beside this file.
#include <cmath>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/one_fluid.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {
namespace {

constexpr double nu = 0.01, duration = 0.25;

/// Relative error of the velocity after `duration` on cells x cells.
double error_on(int cells, int threads) {
  const double h = 1.0 / cells, k = 2 * pi;
  sim::Case c = one_fluid_tank(0, -1, cells, cells, h, nu);
  c.tank.periodic = {false, true, true};
  c.fluids.gravity = 0;  // periodic upwards as well
  c.numerics.pressure_tolerance = 1e-8;
  const int steps = cells * cells / 16;  // with the square of the cell: the step's error, first order, goes along
  c.time.dt = duration / steps;
  const auto run = start(c, threads);
  const auto exact = [k](double t) {
    return [k, t](const Vec2& x, int axis) {
      const double decay = std::exp(-2 * nu * k * k * t);
      return axis == 0 ? decay * std::sin(k * x[0]) * std::cos(k * x[1])
                       : -decay * std::cos(k * x[0]) * std::sin(k * x[1]);
    };
  };
  set_velocity(*run, exact(0));
  for (int i = 0; i < steps; ++i) step(*run);
  return relative_velocity_error(*run, exact(duration));
}

}  // namespace

void run_taylor_green(const Context& context, Results& results) {
  const double coarse = error_on(16, context.threads), medium = error_on(32, context.threads);
  results.report("error_16", coarse, "1");
  results.report("error_32", medium, "1");
  if (context.quick()) {
    results.expect_above("order", std::log2(coarse / medium), "1", 1.9);
    results.refinement({"velocity_error", "1", {1.0 / 16, 1.0 / 32}, {coarse, medium}, 2, 0.0});
    return;
  }
  const double fine = error_on(64, context.threads);
  results.report("error_64", fine, "1");
  results.report("order_coarse", std::log2(coarse / medium), "1");
  results.expect_above("order", std::log2(medium / fine), "1", 1.9);
  results.refinement({"velocity_error", "1", {1.0 / 16, 1.0 / 32, 1.0 / 64}, {coarse, medium, fine}, 2, 0.0});
}

}  // namespace seaway::validation
