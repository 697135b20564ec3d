#include "tests/validation/support/closed_tank.hpp"

#include <algorithm>

#include "tests/validation/support/one_fluid.hpp"

namespace seaway::validation {

sim::Case closed_tank_case(const ClosedTank& tank, double axis, double h) {
  const double wall = tank.wall;
  sim::Case c;
  c.hull.shape = sim::Hull::Shape::box;
  c.hull.beam = tank.breadth + 2 * wall;
  c.hull.height = tank.height + 2 * wall;
  sim::Compartment inside;
  inside.name = "tank";
  inside.lower = {0, -0.5 * tank.breadth, wall};
  inside.upper = {0, 0.5 * tank.breadth, wall + tank.height};
  inside.wall_thickness = wall;
  inside.flooded = true;  // to z = 0
  c.hull.compartments = {inside};
  c.body.mass = 100;  // means nothing: the motion is given
  c.body.cog = {0, 0, wall + axis};
  c.body.gyradii = {0.3, 0, 0};
  c.body.draft = wall + tank.fill;
  sim::Stage stage;
  stage.name = "only";
  stage.mesh.hull_cell = h;
  c.stages = {stage};
  return c;
}

void empty_the_sea(Section& run) {
  flow::FlowState<2> state = run.state();
  const auto& hull = run.model().description.hull;
  const motion::RigidBody<2>& body = run.model().body;
  // To the middle of the walls: of cells that a wall cuts each side keeps its own.
  const auto in_compartment = [&](const Vec2& x) {
    const Vec2 at = motion::earth_to_hull<2>(body, run.body().pose, x);
    return std::any_of(hull.compartments.begin(), hull.compartments.end(), [&](const sim::Compartment& c) {
      const double wall = 0.5 * c.wall_thickness;
      return at[0] > c.lower[1] - wall && at[0] < c.upper[1] + wall && at[1] > c.lower[2] - wall && at[1] < c.upper[2] + wall;
    });
  };
  each_cell(run, [&](int b, int i, const Vec2& x) {
    if (!in_compartment(x)) state.vof.block(b)[i] = 0;
  });
  std::fill(state.p.data().begin(), state.p.data().end(), 0.0);
  run.adopt(std::move(state), run.body(), 0, 0, run.dt(), {}, nullptr);
}

}  // namespace seaway::validation
