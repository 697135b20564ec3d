// Pressure probes: at walls, in the fluid, in the solid, behind thin walls; what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.hpp"
#include "core/sim/check_case.hpp"
#include "tests/unit/core/sim/barge_case.hpp"

namespace seaway::sim {
namespace {

using namespace testing;

Probe on_hull(const std::string& name, double y, double z) { return {name, true, {0, y, z}}; }

double height_of(const Simulation<2>& s, const Probe& probe) {
  const Vec2 body = from_vec3<2>(probe.place) - s.model().body.cog;
  return probe.on_hull ? motion::to_earth(s.body().pose, body)[1] : probe.place.z();
}

class Heeled : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Probes, Heeled, ::testing::Values(0.0, 7.3, -15.0), [](const auto& test) {
  return std::to_string(test.index);
});

TEST_P(Heeled, WaterAtRestHasItsHydrostaticPressure) {
  Case c = barge();
  c.body.angles = {GetParam() * degree, 0, 0};
  c.numerics.pressure_tolerance = 1e-12;
  // On the bottom, on a corner, on the sides below water, in the middle of nowhere.
  c.outputs.probes = {on_hull("keel", 0.013, 0), on_hull("bilge", -0.15, 0), on_hull("port", 0.15, 0.006),
                      {"deep", false, {0, 0.41, -0.3}}};
  const auto s = simulate(c);
  const double reference = s->pressure(c.outputs.probes[3]) - 9810 * 0.3;
  EXPECT_NEAR(reference, 1.2 * 9.81 * 0.4, 1.2 * 9.81 * 0.05);  // the air above, to a cell
  for (const Probe& probe : c.outputs.probes)
    EXPECT_NEAR(s->pressure(probe) - reference, -9810 * height_of(*s, probe), 1e-3) << probe.name;
}

TEST(Probes, ReadNothingInsideTheSolid) {
  Case c = barge();
  c.outputs.probes = {{"inside", false, {0, 0, 0}}, {"beside", false, {0, 0.3, -0.1}}};
  const auto s = simulate(c);
  EXPECT_EQ(s->pressure(c.outputs.probes[0]), 0.0);
  EXPECT_GT(s->pressure(c.outputs.probes[1]), 900);
}

TEST(Probes, ReadTheirOwnSideOfAThinWall) {
  Case c = barge();
  Compartment hold;
  hold.name = "hold";
  hold.lower = {0, -0.1, 0.03};
  hold.upper = {0, 0.147, 0.097};
  hold.wall_thickness = 0.003;  // a quarter of a cell
  hold.flooded = false;
  hold.openings.push_back({"hatch", {0, 0, 0.09}, {0, 0.05, 0.11}});
  c.hull.compartments = {hold};
  c.numerics.pressure_tolerance = 1e-10;
  c.outputs.probes = {on_hull("inside", 0.146, 0.035), on_hull("outside", 0.1501, 0.035)};
  const auto s = simulate(c);
  EXPECT_LT(std::abs(s->pressure(c.outputs.probes[0])), 10);  // air
  EXPECT_NEAR(s->pressure(c.outputs.probes[1]), 9810 * 0.015, 10);
}

TEST(Probes, MoveWithTheHullAndAreChannelsOfTheHistory) {
  Case c = barge();
  c.body.prescribed = {{Dof::heave, 0.02, 0.48, 0}};
  c.outputs.probes = {on_hull("keel", 0, 0), {"fixed", false, {0, 0, -0.05}}};
  Keeper keeper;
  const std::string folder = ::testing::TempDir() + "probe_channel";
  std::filesystem::remove_all(folder);  // a checkpoint there would be resumed
  std::filesystem::create_directories(folder);
  ASSERT_EQ(run(c, folder, keeper).reason, StopReason::finished);
  const std::size_t at = keeper.channel("pressure.keel");
  ASSERT_LT(at, keeper.channels.size());
  EXPECT_EQ(keeper.channels[at].unit, "Pa");
  // Both start at the keel; a quarter period on it is 20 mm higher, in water that slows down with 3.4 m/s2.
  const auto below = [&](const Sample& s) { return s.values[keeper.channel("pressure.fixed")] - s.values[at]; };
  EXPECT_LT(std::abs(below(keeper.samples.front())), 25);
  EXPECT_NEAR(below(keeper.samples.back()), 1000 * (9.81 - 3.4) * 0.02, 20);
}

std::string first_error(const Case& c) {
  for (const Diagnostic& d : check_case(c).diagnostics)
    if (d.severity == Diagnostic::Severity::error) return d.field + ": " + d.message;
  return "accepted";
}

TEST(Probes, AreRefusedWhereTheyCannotBe) {
  Case c = barge();
  c.outputs.probes = {on_hull("a", 0.15, 0.02)};
  EXPECT_EQ(first_error(c), "accepted");
  c.outputs.probes = {on_hull("a", 0.15, 0.02), on_hull("a", 0, 0)};
  EXPECT_THAT(first_error(c), ::testing::HasSubstr("outputs.probes[1].name: 'a' is used twice"));
  c.outputs.probes = {on_hull("a", 0.2, 0.02)};
  EXPECT_THAT(first_error(c), ::testing::HasSubstr("outputs.probes[0].y_m: 0.2 m is outside the box around the hull"));
  c.outputs.probes = {{"a", false, {0, 0, -3}}};
  EXPECT_THAT(first_error(c), ::testing::HasSubstr("outputs.probes[0].z_m: -3 m is outside the tank"));
  c.outputs.probes = {on_hull("a", 0, 0.05)};  // in the middle of the solid
  EXPECT_THROW(make_model<2>(c), Error);
}

}  // namespace
}  // namespace seaway::sim
