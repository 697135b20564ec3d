// A tank with water as a hull with one closed compartment, hung in air: how a rolling tank is computed.
#pragma once

#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {

/// A rectangle inside walls of `wall`, filled to z = 0 [m].
struct ClosedTank {
  double breadth = 0, height = 0, fill = 0, wall = 0;
};

/// The tank's hull with cells of `h`, floating where its water is level with z = 0; it turns about a point `axis` above its
/// floor [m]. What is around it, time step and motion are the caller's.
sim::Case closed_tank_case(const ClosedTank& tank, double axis, double h);

/// Takes away the water outside the hull's compartments and starts again, at rest, with what is left in them.
void empty_the_sea(Section& run);

}  // namespace seaway::validation
