// [barge_at_rest] A hull in calm water makes no currents and stays where it floats; see README.md.
#include <algorithm>
#include <cmath>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

double held_velocity(double h, double roll, double duration, int threads) {
  sim::Case c = barge_in_plain_tank(h, roll);
  c.time.dt = 0.004;
  c.numerics.pressure_tolerance = 1e-12;  // balance of forces, not how far the solver goes
  const auto run = start(c, threads);
  double largest = max_velocity(*run);
  while (run->time() < duration) {
    step(*run);
    largest = std::max(largest, max_velocity(*run));
  }
  return largest;
}

}  // namespace

void run_barge_at_rest(const Context& context, Results& results) {
  const double h = 0.01, duration = context.quick() ? 0.5 : 2;
  // Errors of the balance at level jumps and cut cells, a millionth of the velocities of interest.
  results.expect_below("max_velocity_0", held_velocity(h, 0, duration, context.threads), "m/s",
                       1e-6);
  results.expect_below("max_velocity_15", held_velocity(h, 15 * degree, duration, context.threads),
                       "m/s", 1e-6);

  sim::Case c = barge_in_plain_tank(h, 0);
  c.body.free = {sim::Dof::sway, sim::Dof::heave, sim::Dof::roll};
  c.time.dt = 0.008;  // the step recommended for this barge, T/115
  const auto run = start(c, context.threads);
  double heave = 0, roll = 0;
  while (run->time() < 2) {
    step(*run);
    const auto x = displacement(*run);
    heave = std::max(heave, std::abs(x[1]));
    roll = std::max(roll, std::abs(x[2]));
  }
  // The hull's apertures on cells of h know its volume to a small part of a cell.
  results.expect_below("heave_over_h", heave / h, "1", 0.01);
  results.expect_below("roll_deg", roll / degree, "deg", 0.05);
  results.report("final_velocity", max_velocity(*run), "m/s");
}

}  // namespace seaway::validation
