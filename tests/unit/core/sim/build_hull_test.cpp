#include "core/sim/build_hull.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/unit/core/sim/example_case.hpp"

namespace seaway::sim {
namespace {

TEST(BuildHull, CellsAreHalvedBaseCells) {
  EXPECT_DOUBLE_EQ(actual_cell(0.16, 0.16), 0.16);
  EXPECT_DOUBLE_EQ(actual_cell(0.16, 0.01), 0.01);
  EXPECT_DOUBLE_EQ(actual_cell(0.16, 0.012), 0.01);
  EXPECT_DOUBLE_EQ(actual_cell(0.16, 0.0095), 0.01);  // within what a tank may stretch
  EXPECT_DOUBLE_EQ(actual_cell(0.16, 1.0), 0.16);
}

TEST(BuildHull, ExampleHasItsCompartments) {
  const auto hull = build_section_hull(damaged_section_in_waves());
  ASSERT_NE(hull, nullptr);
  EXPECT_EQ(hull->n_compartments(), 2);
  EXPECT_EQ(hull->compartment_at({0.14, 0.15}), 0);
  EXPECT_EQ(hull->compartment_at({-0.14, 0.15}), 1);
  EXPECT_NEAR(hull->signed_distance({0.0, -0.05}), 0.05 + 0.0188 / 51, 1e-4);
}

TEST(BuildHull, NoShapeMeansNoHull) { EXPECT_EQ(build_section_hull(Case{}), nullptr); }

TEST(BuildHull, StartDraftIsEquilibriumUnlessGiven) {
  Case c = damaged_section_in_waves();
  const hull::Section section = hull::build_section(section_spec(c.hull, c.folder));
  const double draft = start_draft(c, section);
  EXPECT_NEAR(draft, 0.147, 0.001);
  c.body.draft = 0.13;
  EXPECT_EQ(start_draft(c, section), 0.13);
  c.body.draft = 0;
  c.body.mass = 500;
  EXPECT_THROW(start_draft(c, section), Error);
}

TEST(BuildHull, DryCompartmentsKeepTheirBuoyancy) {
  Case c = damaged_section_in_waves();
  for (Compartment& compartment : c.hull.compartments) compartment.flooded = false;
  const hull::Section section = hull::build_section(section_spec(c.hull, c.folder));
  EXPECT_NEAR(start_draft(c, section), 6.15 / 51, 1e-4);
}

}  // namespace
}  // namespace seaway::sim
