// [rolling_tank] Water in a rolling tank against linear sloshing: the moment on its walls, thick and thin; see README.md.
#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/closed_tank.hpp"
#include "tests/validation/support/linear_sloshing.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {
namespace {

constexpr double breadth = 0.36, depth = 0.14, height = 0.26;  // [m], about those of the damaged DTMB 5415's compartments
constexpr double amplitude = 1 * degree, period = 1.4;         // [s]
constexpr double ramp = 4 * period;     // slow: the tank's own modes are hardly damped, and must not be excited
constexpr double duration = ramp + 3 * period;

/// The tank as a hull in a space of air; it turns about the middle of its calm surface.
sim::Case rolling_tank(double h, double wall) {
  sim::Case c = closed_tank_case({breadth, height, depth, wall}, depth, h);
  c.title = "rolling tank";
  c.base_cell = 0.04;
  const double shift = 0.37 * h;  // the grid's lines fall anywhere
  c.tank.lower = {0, -0.48 + shift, -0.32 + shift};
  c.tank.upper = {0, 0.48 + shift, 0.32 + shift};
  c.body.prescribed = {{sim::Dof::roll, amplitude, period, ramp}};
  c.time.dt = period / 1400 * (h / 0.001);
  sim::Stage& stage = c.stages.front();
  stage.mesh.hull_sweep = 2 * amplitude;
  stage.mesh.hull_heave = 0.005;
  stage.end.duration = duration;
  return c;
}

struct Response {
  std::complex<double> moment;  ///< over the angle [N m / rad per metre]; imaginary part > 0 drives the roll
  double water_error = 0;
};

/// `in_the_sea`: floats in water as high as its own instead of hanging in the air.
Response roll(double h, double wall, bool in_the_sea, int threads) {
  const auto run = start(rolling_tank(h, wall), threads);
  if (!in_the_sea) empty_the_sea(*run);
  const double water = run->water().visible, omega = 2 * pi / period;
  Record moment, angle;
  Response out;
  while (run->time() < duration) {
    step(*run);
    moment.add(run->time(), run->load()[2]);
    angle.add(run->time(), run->body().pose.roll);
    const sim::WaterBalance balance = run->water();
    out.water_error = std::max(out.water_error, std::abs((balance.visible + balance.reservoir) / water - 1));
  }
  out.moment = harmonic(moment, omega, ramp) / harmonic(angle, omega, ramp);
  return out;
}

/// What the tilting surface takes from the stability of what carries the tank, per metre [N m / rad].
const double free_surface_moment = 1000 * 9.81 * std::pow(breadth, 3) / 12;

void report_run(const std::string& suffix, const Response& got, Results& results) {
  results.report("moment" + suffix, got.moment.real(), "N/rad");
  results.report("moment_out_of_phase" + suffix, got.moment.imag(), "N/rad");
  results.expect_below("water_error" + suffix, got.water_error, "1", 1e-4);
}

/// Walls of two cells, air around: against theory.
void against_theory(const Context& context, Results& results) {
  const double omega = 2 * pi / period;
  const RollingTank theory{breadth, depth, 0};
  const double expected = theory.moment_per_angle(omega);
  results.report("moment_theory", expected, "N/rad");
  results.report("moment_theory_level_surface", theory.moment_per_angle_at_rest(), "N/rad");
  Refinement refinement{"moment_error", "1", {}, {}, 1, 0.0};
  for (const int mm : context.quick() ? std::vector<int>{20} : std::vector<int>{20, 10, 5}) {
    const double h = 1e-3 * mm;
    const Response got = roll(h, 2 * h, false, context.threads);
    const std::string suffix = fmt::format("_{}mm", mm);
    const double error = std::abs(got.moment.real() - expected) / free_surface_moment;
    report_run(suffix, got, results);
    results.expect_below("moment_error" + suffix, error, "1", 0.03);
    refinement.h.push_back(h);
    refinement.value.push_back(error);
  }
  if (!context.quick()) results.refinement(refinement);
}

/// Walls of 10 mm in the sea, which cells of 10 and 20 mm do not resolve: against cells of 5 mm, which do.
void thin_against_resolved(const Context& context, Results& results) {
  constexpr double wall = 0.01;
  const Response resolved = roll(0.005, wall, true, context.threads);
  report_run("_in_the_sea_5mm", resolved, results);
  for (const int mm : {10, 20}) {
    const std::string suffix = fmt::format("_in_the_sea_{}mm", mm);
    const Response thin = roll(1e-3 * mm, wall, true, context.threads);
    report_run(suffix, thin, results);
    results.expect_below("moment_difference" + suffix, std::abs(thin.moment.real() - resolved.moment.real()) / free_surface_moment,
                         "1", 0.05);
  }
  // Known limit: a thin wall with water on one side alone.
  const double expected = RollingTank{breadth, depth, 0}.moment_per_angle(2 * pi / period);
  const Response dry = roll(0.01, wall, false, context.threads);
  report_run("_thin_10mm", dry, results);
  results.report("moment_error_thin_10mm", std::abs(dry.moment.real() - expected) / free_surface_moment, "1");
}

}  // namespace

void run_rolling_tank(const Context& context, Results& results) {
  against_theory(context, results);
  if (!context.quick()) thin_against_resolved(context, results);
}

}  // namespace seaway::validation
