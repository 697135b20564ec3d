// [still_water] Calm water in a closed tank stays calm; see README.md beside this file.
#include "tests/validation/cases.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double fine_cell = 1.0 / 128;

/// Fine cells in a box of this half-width about the level, which lies 0.37 fine cells above a grid
/// line of every size of cell.
double largest_velocity(double half_width, int threads) {
  sim::Case c;
  c.base_cell = 1.0 / 32;
  const double shift = 0.37 * fine_cell;
  c.tank.lower = {0, -1, -1 - shift};
  c.tank.upper = {0, 1, 1 - shift};
  c.tank.open_top = false;
  c.time.dt = 0.004;
  // What is asked is whether forces balance, not how far the solver goes: solve to rounding.
  c.numerics.pressure_tolerance = 1e-12;
  sim::Stage stage;
  stage.mesh.boxes = {{fine_cell, {0, -half_width, -0.2}, {0, half_width, 0.2}}};
  c.stages = {stage};
  const auto run = start(c, threads);
  double largest = max_velocity(*run);
  for (int i = 0; i < 1000; ++i) {
    step(*run);
    largest = std::max(largest, max_velocity(*run));
  }
  return largest;
}

}  // namespace

void run_still_water(const Context& context, Results& results) {
  // Rounding of 1e4 Pa of pressure, 1e-12 Pa, over 1e-2 m of water and 4 s: 1e-12 m/s; four digits
  // of room.
  results.expect_below("max_velocity", largest_velocity(2, context.threads), "m/s", 1e-8);
  // A coarse cell cut by the surface beside two fine ones cannot hold the same pressure gradient to
  // rounding; 1e-4 m/s is a thousandth of the velocities in the waves of interest.
  results.expect_below("max_velocity_crossing", largest_velocity(0.3, context.threads), "m/s",
                       1e-4);
}

}  // namespace seaway::validation
