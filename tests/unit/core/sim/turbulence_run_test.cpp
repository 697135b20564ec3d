// Runs with k-epsilon and walls: channels, friction, stages, resume, threads; and what the check says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/sim/check_case.hpp"
#include "core/sim/snapshot.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/unit/core/sim/barge_case.hpp"

namespace seaway::sim {
namespace {

using namespace testing;
using ::seaway::testing::TempFolder;

Case turbulent(Case c) {
  c.turbulence.model = Turbulence::Model::stabilised;
  c.turbulence.walls = Turbulence::Walls::wall_function;
  c.turbulence.velocity = 0.3;
  return c;
}

TEST(TurbulentRun, ResumedRunContinuesToTheBitAndMapsItsFields) {
  const Case c = turbulent(two_stages());
  Keeper whole;
  const TempFolder folder;
  ASSERT_EQ(run(c, folder.path(), whole).reason, StopReason::finished);
  ASSERT_EQ(whole.finished.size(), 2u);
  for (const int stop_after : {8, 20}) {
    const TempFolder other;
    Keeper first(stop_after), second;
    EXPECT_EQ(run(c, other.path(), first).reason, StopReason::cancelled);
    EXPECT_EQ(run(c, other.path(), second).reason, StopReason::finished);
    EXPECT_EQ(second.count("resumed"), 1);
    ASSERT_EQ(first.samples.size() + second.samples.size(), whole.samples.size());
    for (std::size_t i = 0; i < second.samples.size(); ++i)
      EXPECT_EQ(second.samples[i].values, whole.samples[first.samples.size() + i].values);
    const WallReport &a = second.finished.back().walls.at(0), &b = whole.finished.back().walls.at(0);
    EXPECT_EQ(a.y_plus_mean, b.y_plus_mean);
    EXPECT_EQ(a.y_plus_max, b.y_plus_max);
  }
}

TEST(TurbulentRun, SameBitsForAnyNumberOfThreads) {
  const Case c = turbulent(two_stages());
  const TempFolder a, b;
  Keeper one, three;
  run(c, a.path(), one, 1);
  run(c, b.path(), three, 3);
  ASSERT_EQ(one.samples.size(), three.samples.size());
  for (std::size_t i = 0; i < one.samples.size(); ++i) EXPECT_EQ(one.samples[i].values, three.samples[i].values);
}

TEST(TurbulentRun, PicturesHoldEnergyAndEddyViscosityAboutTheHull) {
  const TempFolder folder;
  const auto s = simulate(turbulent(barge(0.025)));
  s->step();
  const std::string path = folder / "section.json";
  write_section(*s, 0, path);
  nlohmann::json j;
  std::ifstream(path) >> j;
  const auto& t = j.at("turbulence");
  EXPECT_EQ(t.at("tke_m2_per_s2").size(), t.at("z").at("count"));
  EXPECT_EQ(t.at("nu_t_m2_per_s").at(0).size(), t.at("y").at("count"));
  EXPECT_NEAR(t.at("tke_m2_per_s2").at(0).at(0), s->turbulence()->spec().tke, 1e-2 * s->turbulence()->spec().tke);
}

TEST(TurbulentRun, FrictionHasItsChannelsOnlyWithWalls) {
  const TempFolder a, b;
  Keeper with, without;
  Case c = barge(0.025);
  c.stages[0].end.duration = 0.016;
  run(turbulent(c), a.path(), with);
  run(c, b.path(), without);
  for (const char* name : {"friction_y", "friction_z", "friction_moment_x"}) {
    EXPECT_LT(with.channel(name), with.channels.size()) << name;
    EXPECT_EQ(without.channel(name), without.channels.size()) << name;
  }
  ASSERT_EQ(with.finished.at(0).walls.size(), 1u);
  EXPECT_EQ(with.finished[0].walls[0].name, "hull");
  EXPECT_TRUE(without.finished.at(0).walls.empty());
}

/// Friction on a barge swaying through the water, at the second of two times.
double sway_friction(Turbulence::Model model, Turbulence::Walls walls, double* velocity) {
  Case c = barge(0.0125);
  c.turbulence.model = model;
  c.turbulence.walls = walls;
  c.turbulence.velocity = 0.3;
  c.body.prescribed = {{Dof::sway, 0.05, 1.0, 0}};
  c.time.dt = 0.005;
  const auto s = simulate(c);
  for (int i = 0; i < 10; ++i) s->step();
  *velocity = s->body().twist[0];
  return s->friction()[0];
}

TEST(TurbulentRun, FrictionOpposesTheMotionAndSlipHasNone) {
  double v = 0;
  EXPECT_EQ(sway_friction(Turbulence::Model::laminar, Turbulence::Walls::slip, &v), 0);
  EXPECT_GT(v, 0.2);
  for (const auto walls : {Turbulence::Walls::wall_function, Turbulence::Walls::non_equilibrium}) {
    const double f = sway_friction(Turbulence::Model::stabilised, walls, &v);
    EXPECT_LT(f, 0);
    // Water along the bottom: tau = rho C_f v^2 / 2 on 0.3 m with C_f of 0.003 .. 0.02.
    EXPECT_GT(-f, 0.5 * 1000 * 0.003 * v * v * 0.3);
    EXPECT_LT(-f, 0.5 * 1000 * 0.02 * v * v * 0.3);
  }
}

TEST(TurbulentRun, FrictionOpposesTheMotionInThreeDimensions) {
  Case c;
  c.dim = 3;
  c.tank.lower = {-0.8, -0.8, -0.4};
  c.tank.upper = {0.8, 0.8, 0.4};
  c.base_cell = 0.05;
  c.hull.shape = Hull::Shape::box;
  c.hull.length = 0.42;
  c.hull.beam = 0.32;
  c.hull.height = 0.21;
  c.body.mass = 14;
  c.body.draft = 0.105;
  c.body.cog = {0, 0, 0.1};
  c.body.gyradii = {0.1, 0.1, 0.1};
  c.body.prescribed = {{Dof::surge, 0.05, 1.0, 0}};
  c.time.dt = 0.01;
  c.stages.resize(1);
  c.stages[0].mesh.hull_cell = 0.05;
  c.stages[0].mesh.hull_sweep = 0;
  c.stages[0].end.duration = 1;
  c = turbulent(c);
  auto model = std::make_shared<Model<3>>(make_model<3>(c));
  auto forest = make_forest<3>(*model, c.stages[0].mesh, 1);
  Simulation<3> s(model, std::move(forest), quiet_context(1));
  s.initialise();
  for (int i = 0; i < 8; ++i) ASSERT_FALSE(s.step().failed);
  const auto& friction = s.friction();
  EXPECT_GT(s.body().twist[0], 0.2);
  EXPECT_LT(friction[0], 0);
  // Symmetric about the centre plane, as far as the hull's table of distances is.
  EXPECT_LT(std::abs(friction[1]), 1e-3 * std::abs(friction[0]));
  EXPECT_LT(std::abs(friction[3]), 1e-3 * std::abs(friction[0]));
  EXPECT_EQ(s.y_plus().size(), 1u);
  for (const int b : s.forest().leaves())
    for (int i = 0; i < mesh::BlockShape<3>::cells; ++i) ASSERT_GT(s.state().tke.block(b)[i], 0);
}

TEST(TurbulentRun, StressNeverLimitsTheStep) {
  Case c = barge(0.0125);
  c.fluids.nu_water = c.fluids.nu_air = 0.02;  // explicit limit 2 ms
  c.turbulence.walls = Turbulence::Walls::no_slip;
  c.body.prescribed = {{Dof::roll, 5 * degree, 1.0, 0.2}};
  const auto s = simulate(c);
  for (int i = 0; i < 60; ++i) {
    const StepReport report = s->step();
    ASSERT_FALSE(report.failed) << report.failure;
  }
  EXPECT_EQ(s->dt(), 0.008);
  EXPECT_LT(largest_velocity(*s), 0.5);
}

bool refuses(const Case& c, const std::string& field) {
  for (const Diagnostic& d : check_case(c).diagnostics)
    if (d.field == field && d.severity == Diagnostic::Severity::error) return true;
  return false;
}

TEST(CheckTurbulence, NamesWhatDoesNotFitTogether) {
  const Case good = turbulent(barge());
  EXPECT_TRUE(check_case(good).ok());
  Case c = good;
  c.turbulence.model = Turbulence::Model::laminar;
  EXPECT_TRUE(refuses(c, "turbulence.walls"));
  c = good;
  c.turbulence.walls = Turbulence::Walls::no_slip;
  EXPECT_TRUE(refuses(c, "turbulence.walls"));
  c = good;
  c.turbulence.velocity = 0;
  EXPECT_TRUE(refuses(c, "turbulence.velocity_m_per_s"));
  c = good;
  c.turbulence.intensity = 1.5;
  EXPECT_TRUE(refuses(c, "turbulence.intensity"));
  c = good;
  c.turbulence.length_scale = 0;
  EXPECT_TRUE(refuses(c, "turbulence.length_scale_m"));
  c = good;
  c.fluids.viscous = false;
  EXPECT_TRUE(refuses(c, "turbulence.model"));
  c = good;
  c.turbulence = {};
  c.turbulence.buoyancy = true;
  EXPECT_TRUE(refuses(c, "turbulence.buoyancy"));
}

TEST(CheckTurbulence, NamesSidesOfTheTankThatCannotStick) {
  const auto with = [](Tank::NoSlip side) {
    Case c = barge();
    c.tank.no_slip = {side};
    return c;
  };
  EXPECT_TRUE(check_case(with({2, false, {0, 0.1, 0}})).ok());
  EXPECT_TRUE(refuses(with({2, true, {0, 0, 0}}), "tank.no_slip[0].side"));  // open
  EXPECT_TRUE(refuses(with({0, true, {0, 0, 0}}), "tank.no_slip[0].side"));  // no x in 2-D
  EXPECT_TRUE(refuses(with({1, true, {0, 1, 0}}), "tank.no_slip[0].velocity_y_m_per_s"));
  Case twice = with({2, false, {0, 0, 0}});
  twice.tank.no_slip.push_back(twice.tank.no_slip[0]);
  EXPECT_TRUE(refuses(twice, "tank.no_slip[1].side"));
}

}  // namespace
}  // namespace seaway::sim
