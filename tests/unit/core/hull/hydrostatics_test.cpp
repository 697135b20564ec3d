#include "core/hull/hydrostatics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "tests/unit/core/hull/example_section.hpp"

namespace seaway::hull {
namespace {

std::vector<WeightedLoop> box(double beam, double height) {
  return {{box_polygon({{-0.5 * beam, 0}, {0.5 * beam, height}}), 1.0}};
}

TEST(Hydrostatics, BargeMatchesFormulas) {
  const auto solid = box(0.3, 0.1);
  const Hydrostatics h = hydrostatics(solid, {0.05, 0});
  EXPECT_NEAR(h.area, 0.015, 1e-16);
  EXPECT_NEAR(h.buoyancy_centre.x(), 0, 1e-15);
  EXPECT_NEAR(h.buoyancy_centre.y(), 0.025, 1e-15);
  EXPECT_NEAR(h.waterplane_breadth, 0.3, 1e-15);
  EXPECT_NEAR(h.waterplane_inertia, 0.3 * 0.3 * 0.3 / 12, 1e-16);
  EXPECT_NEAR(h.bm, 0.15, 1e-14);
  EXPECT_NEAR(metacentric_height(solid, {0.05, 0}, {0, 0.05}), 0.125, 1e-14);
}

TEST(Hydrostatics, HeeledBargeMatchesWallSidedFormula) {
  // GZ = sin(heel) (GM + BM tan^2(heel) / 2) while no corner leaves or enters the water.
  const auto solid = box(0.3, 0.1);
  for (const double heel : {-0.25, 0.1, 0.3}) {
    const double gz = righting_curve(solid, 0.015, {0, 0.05}, {heel})[0].second;
    const double tan2 = std::tan(heel) * std::tan(heel);
    EXPECT_NEAR(gz, std::sin(heel) * (0.125 + 0.075 * tan2), 1e-13);
  }
}

TEST(Hydrostatics, MetacentricHeightIsSlopeOfRightingArm) {
  const Section section = build_section(damaged_midship());
  const double area = 0.03, step = 1e-5;
  const Vec2 cog(0.003, 0.09);
  for (const double heel : {0.0, 0.15, -0.4}) {
    const auto curve = righting_curve(section.solid, area, cog, {heel - step, heel + step});
    const double slope = (curve[1].second - curve[0].second) / (2 * step);
    const Attitude at{find_waterline(section.solid, heel, area).value(), heel};
    EXPECT_NEAR(metacentric_height(section.solid, at, cog), slope, 1e-6);  // step^2 and rounding
  }
}

TEST(Hydrostatics, WaterlineGivesAskedArea) {
  const Section section = build_section(damaged_midship());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> heel(-1.5, 1.5), part(0.01, 0.99);
  const double whole = hydrostatics(section.solid, {1.0, 0}).area;
  for (int i = 0; i < 300; ++i) {
    const double phi = heel(random), area = part(random) * whole;
    const auto w = find_waterline(section.solid, phi, area);
    ASSERT_TRUE(w);
    EXPECT_NEAR(hydrostatics(section.solid, {*w, phi}).area, area, 1e-13);
  }
  EXPECT_FALSE(find_waterline(section.solid, 0.0, 1.01 * whole));
  EXPECT_THROW(find_waterline(section.solid, 0.0, 0.0), Error);
}

TEST(Equilibrium, BargeFloatsUpright) {
  const Equilibrium e = find_equilibrium(box(0.3, 0.1), 0.015, {0, 0.05}, true);
  EXPECT_TRUE(e.floats && e.stable);
  EXPECT_NEAR(e.at.waterline, 0.05, 1e-13);
  EXPECT_EQ(e.at.heel, 0.0);
  EXPECT_NEAR(e.gm, 0.125, 1e-12);
}

TEST(Equilibrium, OffCentreWeightHeelsByWallSidedFormula) {
  // Heel towards the weight: cog to port (y > 0) means port down, negative roll.
  const double y = 0.02;
  const Equilibrium e = find_equilibrium(box(0.3, 0.1), 0.015, {y, 0.05}, true);
  ASSERT_TRUE(e.floats && e.stable);
  ASSERT_LT(e.at.heel, 0.0);
  const double heel = -e.at.heel, tan2 = std::tan(heel) * std::tan(heel);
  EXPECT_NEAR(std::sin(heel) * (0.125 + 0.075 * tan2), y * std::cos(heel), 1e-12);
}

TEST(Equilibrium, LollAngleMatchesWallSidedFormula) {
  // GM < 0 upright: tan^2(heel) = -2 GM / BM.
  const double gm = -0.005, kg = 0.025 + 0.15 - gm;
  const Equilibrium e = find_equilibrium(box(0.3, 0.1), 0.015, {0, kg}, true);
  ASSERT_TRUE(e.floats && e.stable);
  EXPECT_NEAR(std::tan(e.at.heel), std::sqrt(2 * 0.005 / 0.15), 1e-9);
  EXPECT_FALSE(find_equilibrium(box(0.3, 0.1), 0.015, {0, kg}, false).stable);
}

TEST(Equilibrium, HeavyBodySinks) {
  EXPECT_FALSE(find_equilibrium(box(0.3, 0.1), 0.031, {0, 0.05}, true).floats);
}

TEST(Equilibrium, ExampleSectionFloatsAtItsDesignDraft) {
  const Section section = build_section(damaged_midship());
  const double area = hydrostatics(buoyant_loops(section, {false, false}), {6.15 / 51, 0}).area;
  EXPECT_NEAR(area, 0.036701, 1e-6);
  const Equilibrium e = find_equilibrium(section.solid, area, {0, 0.100}, true);
  ASSERT_TRUE(e.floats && e.stable);
  EXPECT_NEAR(e.at.waterline, 0.147, 0.001);  // asked for: about 0.147 and 0.039
  EXPECT_NEAR(e.gm, 0.039, 0.0015);
  EXPECT_EQ(e.at.heel, 0.0);
}

TEST(Equilibrium, OneFloodedSideHeelsTowardsIt) {
  const Section section = build_section(damaged_midship());
  const auto solid = buoyant_loops(section, {true, false});
  const Equilibrium e = find_equilibrium(solid, 0.03, {0, 0.08}, true);
  ASSERT_TRUE(e.floats && e.stable);
  EXPECT_LT(e.at.heel, -0.02);  // port is flooded: port down
}

TEST(Equilibrium, PermeabilityCountsInBuoyancy) {
  SectionSpec spec = barge();
  CompartmentSpec c;
  c.name = "hold";
  c.box = {{-0.1, 0.02}, {0.1, 0.2}};
  c.wall_thickness = 0.02;
  c.permeability = 0.5;
  spec.compartments = {c};
  const Section section = build_section(spec);
  const double draft = find_equilibrium(section.solid, 0.015, {0, 0.03}, false).at.waterline;
  EXPECT_NEAR(0.3 * draft - 0.5 * 0.2 * (draft - 0.02), 0.015, 1e-9);
}

}  // namespace
}  // namespace seaway::hull
