// Ships in cases: geometry, hydrostatics and what is wrong with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/sim/build_ship.hpp"
#include "core/sim/check_case.hpp"
#include "core/sim/ship_report.hpp"

namespace seaway::sim {
namespace {

/// DTMB 5415 at 1:51, upright at its draft.
Case dtmb5415() {
  Case c;
  c.dim = 3;
  c.folder = SEAWAY_EXAMPLES;
  c.tank.lower = {-4, -4, -2};
  c.tank.upper = {4, 4, 1};
  c.base_cell = 0.16;
  c.hull.shape = Hull::Shape::offsets_hull;
  c.hull.offsets_file = "dtmb5415_offsets.csv";
  c.hull.station = 71;
  c.hull.scale = 51;
  c.body.mass = 63.24;
  c.body.cog = {-0.0136, 0, 0.148};
  c.body.gyradii = {0.12, 0.7, 0.7};
  c.body.draft = 0.1206;
  c.body.free = {Dof::heave, Dof::roll};
  Stage stage;
  stage.name = "A";
  stage.mesh.hull_cell = 0.02;
  stage.end.kind = EndRule::Kind::time;
  stage.end.duration = 1;
  c.stages = {stage};
  return c;
}

Compartment hold() {
  Compartment c;
  c.name = "hold";
  c.lower = {-0.24, -0.3, -0.05};
  c.upper = {0.24, 0.3, 0.18};
  c.wall_thickness = 0.02;
  c.openings.resize(1);
  c.openings[0].name = "damage";
  c.openings[0].lower = {-0.05, 0.1, 0.08};
  c.openings[0].upper = {0.05, 0.25, 0.12};
  return c;
}

const Diagnostic* find(const CaseReport& report, const std::string& field) {
  const auto it = std::find_if(report.diagnostics.begin(), report.diagnostics.end(),
                               [&](const Diagnostic& d) { return d.field == field; });
  return it == report.diagnostics.end() ? nullptr : &*it;
}

TEST(CheckShip, Dtmb5415FloatsWhereItIsSaidTo) {
  const CaseReport report = check_case(dtmb5415());
  const HydrostaticsSummary& h = report.hydrostatics;
  ASSERT_TRUE(h.valid);
  EXPECT_NEAR(h.draft, 0.1206, 0.003 * 0.1206);
  EXPECT_NEAR(h.gm, 0.038, 0.002);  // seed value at model scale
  EXPECT_NEAR(h.heel, 0, 1e-6);
  EXPECT_EQ(find(report, "body.draft_m"), nullptr);
  EXPECT_NEAR(h.wetted_surface * 51 * 51, 2979, 30);
}

TEST(CheckShip, WrongDraftAndKgAreNamed) {
  Case c = dtmb5415();
  c.body.draft = 0.14;
  const CaseReport far = check_case(c);
  ASSERT_NE(find(far, "body.draft_m"), nullptr);
  EXPECT_NE(find(far, "body.draft_m")->hint.find("0.1206"), std::string::npos);
  c = dtmb5415();
  c.body.cog.z() = 0.2;
  EXPECT_NE(find(check_case(c), "body.cog.z_m"), nullptr);
  c = dtmb5415();
  c.body.mass = 1000;
  EXPECT_NE(find(check_case(c), "body.mass_kg"), nullptr);
  c = dtmb5415();
  c.body.free.push_back(Dof::pitch);
  c.body.cog.x() = 0.05;
  EXPECT_NE(find(check_case(c), "body.cog.x_m"), nullptr);
}

TEST(CheckShip, FilesThatAreWrongAreNamed) {
  Case c = dtmb5415();
  c.hull.offsets_file = "nowhere.csv";
  EXPECT_NE(find(check_case(c), "hull.offsets_hull.file"), nullptr);
  c.hull.shape = Hull::Shape::stl;
  c.hull.offsets_file = "nowhere.stl";
  c.hull.unit = 1;
  EXPECT_NE(find(check_case(c), "hull.stl.file"), nullptr);
  c.hull.unit = 0;
  ASSERT_NE(find(check_case(c), "hull.stl"), nullptr);
  EXPECT_NE(find(check_case(c), "hull.stl")->message.find("unit"), std::string::npos);
}

/// A short wave across the corners of a large tank without a hull.
Case oblique_wave() {
  Case c = dtmb5415();
  c.hull = {};
  c.body = {};
  c.stages.front().mesh.hull_cell = 0;
  c.stages.front().mesh.surface = {{0.01, 0.1}};
  c.wave.kind = Wave::Kind::regular;
  c.wave.height = 0.06;
  c.wave.period = 1.2;
  c.wave.heading = 30 * degree;
  c.zones.generation_length = 1.5;
  c.zones.absorption_length = 2.4;
  return c;
}

TEST(CheckShip, ObliqueWavesNeedZonesAtAllSides) {
  const CaseReport fine = check_case(oblique_wave());
  EXPECT_TRUE(fine.ok()) << (fine.diagnostics.empty() ? "" : fine.diagnostics.front().field + ": " + fine.diagnostics.front().message);
  Case plain = oblique_wave();
  plain.zones.generation_length = 0;
  ASSERT_NE(find(check_case(plain), "zones"), nullptr);
  EXPECT_NE(find(check_case(plain), "zones")->message.find("30 degrees"), std::string::npos);
  Case periodic = oblique_wave();
  periodic.tank.periodic[0] = true;
  EXPECT_NE(find(check_case(periodic), "tank.periodic"), nullptr);
  Case beach = oblique_wave();
  beach.zones.absorption_target = Zones::Target::rest;
  EXPECT_NE(find(check_case(beach), "zones.absorption_target"), nullptr);
  Case narrow = oblique_wave();  // across the main direction as well
  narrow.tank.lower.y() = -1.9;
  narrow.tank.upper.y() = 1.9;
  EXPECT_NE(find(check_case(narrow), "zones.absorption_length_m"), nullptr);
}

TEST(CheckShip, NoSideOfTheShipStandsInAZone) {
  Case c = dtmb5415();
  c.wave = oblique_wave().wave;
  c.zones.generation_length = 1.5;
  c.zones.absorption_length = 2.4;  // 1.6 m free from the middle on; the bow is at 1.56 m
  EXPECT_EQ(find(check_case(c), "zones"), nullptr);
  c.wave.heading = 90 * degree;
  c.body.offset.x() = 0.2;
  EXPECT_EQ(find(check_case(c), "zones"), nullptr);  // no zones along the ship
  c.wave.heading = 30 * degree;
  ASSERT_NE(find(check_case(c), "zones"), nullptr);
  EXPECT_NE(find(check_case(c), "zones")->message.find(" in x "), std::string::npos);
}

TEST(CheckShip, CompartmentsAreChecked) {
  Case c = dtmb5415();
  c.hull.compartments = {hold()};
  c.hull.compartments[0].lower.x() = 3;
  c.hull.compartments[0].upper.x() = 4;
  EXPECT_NE(find(check_case(c), "hull.compartments[0]"), nullptr);
  c.hull.compartments = {hold()};
  c.hull.compartments[0].openings[0].lower = {1, 0, 0.3};
  c.hull.compartments[0].openings[0].upper = {1.1, 0.1, 0.4};
  EXPECT_NE(find(check_case(c), "hull.compartments[0].openings[0]"), nullptr);
  c.hull.compartments = {hold()};
  std::swap(c.hull.compartments[0].lower.y(), c.hull.compartments[0].upper.y());
  EXPECT_NE(find(check_case(c), "hull.compartments[0].y_m"), nullptr);
}

TEST(BuildShip, HullForTheSolver) {
  Case c = dtmb5415();
  c.hull.compartments = {hold()};
  const auto hull = build_surface_hull(c);
  ASSERT_NE(hull, nullptr);
  EXPECT_EQ(hull->n_compartments(), 1);
  EXPECT_EQ(hull->compartment_at({0, 0, 0.1}), 0);
  EXPECT_EQ(hull->space_near({0.2, 0.0, 0.1}), 1);
  EXPECT_EQ(hull->space_near({0.2, 0.3, 0.1}), 0);
  EXPECT_EQ(hull->space_near({0.0, 0.15, 0.1}), -1);
  c.body.draft = 0;
  c.hull.compartments[0].flooded = false;
  EXPECT_NEAR(start_draft(c, hull->ship()), 0.1206, 0.003 * 0.1206);
  c.hull.compartments[0].flooded = true;
  EXPECT_GT(start_draft(c, hull->ship()), 0.123);
  c.body.mass = 500;
  EXPECT_THROW(start_draft(c, hull->ship()), Error);
  c.hull.shape = Hull::Shape::none;
  EXPECT_EQ(build_surface_hull(c), nullptr);
}

TEST(ShipReport, IntactAndDamaged) {
  Case c = dtmb5415();
  c.hull.compartments = {hold()};
  const hull::Ship ship = hull::build_ship(ship_spec(c.hull, c.folder));
  LoadCondition load;
  load.mass = c.body.mass;
  load.cog = c.body.cog;
  load.open = {true};
  const ShipReport r = ship_report(ship, load);
  ASSERT_TRUE(r.at_draft && r.intact && r.damaged);
  EXPECT_NEAR(r.at_draft->draft, 0.1206, 0.003 * 0.1206);
  EXPECT_NEAR(r.length_waterline * 51, 141.5, 0.5);
  EXPECT_NEAR(r.breadth_waterline * 51, 19.083, 0.02);
  EXPECT_NEAR(r.block_coefficient, 0.506, 0.005);
  EXPECT_NEAR(r.intact->rest.at.heel, 0, 1e-6);
  EXPECT_GT(r.intact->largest_lever, 0);
  EXPECT_GT(r.damaged->rest.at.waterline, r.intact->rest.at.waterline);
  ASSERT_EQ(r.damaged->flood.size(), 1u);
  // Lost buoyancy: hull below the water less the flood and the hole displaces the mass.
  const double submerged = hull::hydrostatics({{ship.outer, 1.0}}, r.damaged->rest.at).volume -
                           r.damaged->flood[0].volume;
  EXPECT_NEAR(submerged * 1000, c.body.mass, 0.5);
  EXPECT_FALSE(ship_report(ship, {}).at_draft);
}

}  // namespace
}  // namespace seaway::sim
