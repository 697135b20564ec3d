// The estimate of a case's cost against the mesh that it gets.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/constants.hpp"
#include "core/sim/check_case.hpp"
#include "core/sim/simulation.hpp"
#include "tests/unit/core/sim/example_case.hpp"

namespace seaway::sim {
namespace {

template <int Dim>
void expect_cells_of_the_mesh(const Case& c) {
  const CaseReport report = check_case(c);
  ASSERT_TRUE(report.ok());
  const Model<Dim> model = make_model<Dim>(c);
  for (std::size_t i = 0; i < c.stages.size(); ++i) {
    const auto forest = make_forest<Dim>(model, c.stages[i].mesh, 1);
    EXPECT_EQ(report.stages[i].cells, static_cast<std::int64_t>(forest->n_cells())) << c.stages[i].name;
  }
}

TEST(EstimateCost, CountsTheCellsOfTheExample) { expect_cells_of_the_mesh<2>(damaged_section_in_waves()); }

TEST(EstimateCost, TakesTheStepsOfEachStage) {
  Case c = damaged_section_in_waves();
  for (Stage& stage : c.stages) stage.dt = stage.steps_per_period = 0;
  const CaseReport alike = check_case(c);
  c.stages[0].steps_per_period = 0.5 * c.time.steps_per_period;
  c.stages[1].dt = 0.25 * alike.stages[1].dt;
  const CaseReport own = check_case(c);
  ASSERT_TRUE(own.ok());
  // Twice as long, but for a whole number of steps in a wave period.
  const double steps = c.wave.period / own.stages[0].dt;
  EXPECT_NEAR(steps, std::round(steps), 1e-9);
  EXPECT_NEAR(own.stages[0].dt, 2 * alike.stages[0].dt, 0.02 * alike.stages[0].dt);
  EXPECT_NEAR(own.stages[0].cpu_s, 0.5 * alike.stages[0].cpu_s, 0.01 * alike.stages[0].cpu_s);
  EXPECT_NEAR(own.stages[1].cpu_s, 4 * alike.stages[1].cpu_s, 0.01 * alike.stages[1].cpu_s);
  EXPECT_EQ(own.stages[2].cpu_s, alike.stages[2].cpu_s);
}

// Fine cells at the hull inside coarse ones: most blocks are there for the balance alone.
TEST(EstimateCost, CountsTheCellsOfABoxInThreeDimensions) {
  Case c;
  c.dim = 3;
  c.tank.lower = {-2.56, -2.56, -1.28};
  c.tank.upper = {2.56, 2.56, 1.28};
  c.base_cell = 0.16;
  c.hull.shape = Hull::Shape::box;
  c.hull.length = 0.6;
  c.hull.beam = 0.3;
  c.hull.height = 0.2;
  c.body.mass = 18;
  c.body.cog = {0, 0, 0.08};
  c.body.gyradii = {0.1, 0.17, 0.17};
  c.body.free = {Dof::heave, Dof::roll};
  c.body.angles = {5 * degree, 0, 0};
  c.time.dt = 0.005;
  Stage s;
  s.name = "only";
  s.mesh.hull_cell = 0.02;
  s.mesh.surface = {{0.04, 0.04, 0.6}};
  s.end.duration = 1;
  c.stages = {s};
  expect_cells_of_the_mesh<3>(c);
}

}  // namespace
}  // namespace seaway::sim
