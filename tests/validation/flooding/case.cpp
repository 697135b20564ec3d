// [flooding] A dry compartment fills through a hole, the one beside it stays dry; see README.md.
#include <algorithm>
#include <cmath>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

/// Outer wall and bulkhead of two cells. The hole, 40 mm high, is in the port side; the sealed
/// compartment lies inboard of the flooding one.
sim::Case damaged_barge(double h, bool vent) {
  sim::Case c = barge_in_plain_tank(h, 0);
  const double wall = 2 * h;
  sim::Compartment flooding;
  flooding.name = "flooding";
  flooding.lower = {0, 0.06, 0.02};
  flooding.upper = {0, 0.15 - wall, 0.1 - wall};
  flooding.wall_thickness = wall;
  flooding.flooded = false;
  flooding.openings.push_back({"hole", {0, 0.13, 0.02}, {0, 0.16, 0.06}});
  if (vent) flooding.openings.push_back({"vent", {0, 0.08, 0.07}, {0, 0.11, 0.11}});
  sim::Compartment sealed;
  sealed.name = "sealed";
  sealed.lower = {0, -0.04, 0.02};
  sealed.upper = {0, 0.06 - wall, 0.1 - wall};
  sealed.wall_thickness = wall;
  sealed.flooded = false;
  c.hull.compartments = {flooding, sealed};
  c.body.free = {sim::Dof::sway, sim::Dof::heave, sim::Dof::roll};
  c.time.dt = 0.004;  // of the order of the time in which water crosses the hole
  return c;
}

}  // namespace

void run_flooding(const Context& context, Results& results) {
  const double h = 0.005, duration = context.quick() ? 0.6 : 1.5;
  for (const bool vent : {true, false}) {
    const std::string suffix = vent ? "" : ".trapped_air";
    const auto run = start(damaged_barge(h, vent), context.threads);
    const WaterBook book(*run);
    double worst = 0, leak = 0, most = 0;
    while (run->time() < duration) {
      step(*run);
      worst = std::max(worst, std::abs(book.error(*run)));
      leak = std::max(leak, run->compartment_volumes()[1]);
      most = std::max(most, run->compartment_volumes()[0]);
    }
    // Of what flooded in; the aim is 1e-3. Without a vent little can flood in, so the run counts
    // by getting to its end.
    if (vent)
      results.expect_below("water_error", worst / most, "1", 1e-2);
    else
      results.report("water_error" + suffix, worst / most, "1");
    // 1e-6 m2: a twenty-fifth of one cell.
    results.expect_below("sealed_leak_m2" + suffix, leak, "m2", 1e-6);
    results.report("flooded" + suffix, most, "m2");
    results.report("roll" + suffix, displacement(*run)[2] / degree, "deg");
  }
}

}  // namespace seaway::validation
