#include "core/hull/section_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "tests/unit/core/hull/example_section.hpp"

namespace seaway::hull {
namespace {

using ::testing::HasSubstr;

std::string message_of(const SectionSpec& spec) {
  try {
    (void)build_section(spec);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

double solid_area(const Section& section) {
  double sum = 0;
  for (const WeightedLoop& loop : section.solid) sum += loop.weight * signed_area(loop.points);
  return sum;
}

SectionSpec polygon(Polygon vertices) {
  SectionSpec spec;
  spec.shape = SectionSpec::Shape::polygon;
  spec.vertices = std::move(vertices);
  return spec;
}

SectionSpec barge_with_hold() {
  SectionSpec spec = barge();
  CompartmentSpec c;
  c.name = "hold";
  c.box = {{0.02, 0.02}, {0.2, 0.2}};  // reaches out: the wall thickness cuts it
  c.wall_thickness = 0.01;
  spec.compartments = {c};
  return spec;
}

TEST(SectionShape, BoxKeepsItsNumbers) {
  const Section section = build_section(barge());
  EXPECT_EQ(section.outer.size(), 4u);
  EXPECT_EQ(solid_area(section), 0.3 * 0.1);
}

TEST(SectionShape, RoundedBoxLosesItsLowerCorners) {
  SectionSpec spec = barge();
  spec.shape = SectionSpec::Shape::rounded_box;
  spec.corner_radius = 0.02;
  const Section section = build_section(spec);
  EXPECT_FALSE(first_self_intersection(section.outer));
  // Chords lose 0.16 % of a circle with 64 of them.
  const double half_circle = 0.5 * pi * 0.02 * 0.02;
  EXPECT_NEAR(solid_area(section), 0.03 - (2 * 0.02 * 0.02 - half_circle), 0.002 * half_circle);
  EXPECT_EQ(bounds_of(section.outer).upper, Vec2(0.15, 0.1));
  spec.corner_radius = 0;
  EXPECT_EQ(build_section(spec).outer.size(), 4u);
  spec.corner_radius = 0.1;  // no straight side left
  EXPECT_FALSE(first_self_intersection(build_section(spec).outer));
  spec.corner_radius = 0.11;
  EXPECT_THAT(message_of(spec), HasSubstr("corner radius is 0.11"));
}

TEST(SectionShape, PolygonMayRunEitherWay) {
  const Polygon p = {{-0.1, 0}, {0.1, 0}, {0.15, 0.1}, {-0.15, 0.1}, {-0.1, 0}};
  EXPECT_NEAR(solid_area(build_section(polygon(p))), 0.025, 1e-15);
  EXPECT_NEAR(solid_area(build_section(polygon({p.rbegin(), p.rend()}))), 0.025, 1e-15);
}

TEST(SectionShape, BadPolygonsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of(polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}})), HasSubstr("polygon is open"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {1, 0}, {0, 0}})), HasSubstr("3 corners"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {1, nan}, {1, 1}, {0, 0}})),
              HasSubstr("corner 1 is (1, nan)"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}, {0, 0}})), HasSubstr("crosses"));
  EXPECT_THAT(message_of(polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}, {0, 0}})),
              HasSubstr("same point"));
}

TEST(SectionShape, BadSizesAreRefused) {
  SectionSpec spec = barge();
  spec.beam = -0.3;
  EXPECT_THAT(message_of(spec), HasSubstr("beam is -0.3"));
  spec = barge();
  spec.height = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message_of(spec), HasSubstr("height is inf"));
}

TEST(SectionShape, CompartmentLeavesWalls) {
  const Section section = build_section(barge_with_hold());
  EXPECT_NEAR(section.compartments[0].area, (0.14 - 0.02) * (0.09 - 0.02), 1e-9);
  EXPECT_NEAR(solid_area(section), 0.03 - section.compartments[0].area, 1e-9);
}

TEST(SectionShape, OpeningTakesAwayWallsOnly) {
  SectionSpec spec = barge_with_hold();
  spec.compartments[0].permeability = 0.8;
  spec.compartments[0].openings = {{"hole", {{0.13, 0.04}, {0.2, 0.06}}}};
  const Section section = build_section(spec);
  const double space = section.compartments[0].area;
  EXPECT_NEAR(solid_area(section), 0.03 - space - 0.01 * 0.02 + 0.2 * space, 1e-9);
}

TEST(SectionShape, ClosedCompartmentCountsAsSolidForBuoyancy) {
  SectionSpec spec = barge_with_hold();
  spec.compartments[0].openings = {{"hole", {{0.13, 0.04}, {0.2, 0.06}}}};
  const Section section = build_section(spec);
  const auto loops = buoyant_loops(section, {false});
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(signed_area(loops[0].points), signed_area(section.outer));
}

TEST(SectionShape, UselessOpeningsAreRefused) {
  SectionSpec spec = barge_with_hold();
  auto& openings = spec.compartments[0].openings;
  openings = {{"afar", {{0.5, 0.04}, {0.6, 0.06}}}};
  EXPECT_THAT(message_of(spec), HasSubstr("touches no wall"));
  openings = {{"inside", {{0.05, 0.04}, {0.06, 0.06}}}};
  EXPECT_THAT(message_of(spec), HasSubstr("touches no wall"));
  openings = {{"blind", {{0.13, 0.04}, {0.145, 0.06}}}};
  EXPECT_THAT(message_of(spec), HasSubstr("leads neither out"));
  openings = {{"outside", {{0.145, 0.04}, {0.2, 0.06}}}};
  EXPECT_THAT(message_of(spec), HasSubstr("does not reach compartment"));
  openings = {{"empty", {{0.13, 0.06}, {0.2, 0.04}}}};
  EXPECT_THAT(message_of(spec),
              HasSubstr("openings[0].z: opening 'empty' reaches from 0.06 to 0.04"));
}

TEST(SectionShape, BadCompartmentsAreRefused) {
  SectionSpec spec = barge_with_hold();
  spec.compartments[0].box = {{0.3, 0.02}, {0.4, 0.08}};
  EXPECT_THAT(message_of(spec), HasSubstr("outside the hull"));
  spec = barge_with_hold();
  spec.compartments[0].permeability = 0;
  EXPECT_THAT(message_of(spec), HasSubstr("permeability"));
  spec = barge_with_hold();
  spec.compartments[0].wall_thickness = -0.01;
  EXPECT_THAT(message_of(spec), HasSubstr("wall_thickness"));
  spec = barge_with_hold();
  spec.compartments.push_back(spec.compartments[0]);
  EXPECT_THAT(message_of(spec), HasSubstr("overlaps"));
}

TEST(SectionShape, MidshipSectionHasTabulatedArea) {
  SectionSpec spec = damaged_midship();
  spec.compartments.clear();
  const Polygon outer = outer_polygon(spec);
  EXPECT_NEAR(bounds_of(outer).upper.y(), 0.30, 1e-15);
  EXPECT_NEAR(bounds_of(outer).lower.y(), 0.0188 / 51, 1e-15);
  // Full-scale area below 6.15 m from the reference's hydrostatics, 95.4585 m2 (trapezoid, 0.5 %).
  const double area = signed_area(clip_to_box(outer, {{-1, -1}, {1, 6.15 / 51}})) * 51 * 51;
  EXPECT_NEAR(area, 95.4585, 0.005 * 95.4585);
}

TEST(SectionShape, ExtensionMustRise) {
  SectionSpec spec = damaged_midship();
  spec.extend_to = 0.1;
  EXPECT_THAT(message_of(spec), HasSubstr("extend_to is 0.1"));
}

}  // namespace
}  // namespace seaway::hull
