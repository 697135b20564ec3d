// One stage: prescribed motion, volume book, wave zones, waves, rest.
#include "core/sim/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "core/field/restrict.hpp"
#include "tests/unit/core/sim/barge_case.hpp"

namespace seaway::sim {
namespace {

using namespace testing;

/// Drift of the visible water over 40 steps of a roll of 12 degrees, in parts of the displacement.
struct Drift {
  double visible = 0;    ///< largest
  double with_owed = 0;  ///< largest, the reservoir included
};
Drift rolling_drift(bool correct) {
  Case c = barge(0.00625);
  c.body.prescribed = {{Dof::roll, 12 * degree, 0.6, 0.2}};
  c.numerics.volume_correction = correct;
  c.numerics.pressure_tolerance = 1e-8;  // the book is as exact as w is solenoidal
  const auto s = simulate(c);
  const double start = s->water().visible;
  Drift drift;
  for (int i = 0; i < 40; ++i) {
    const StepReport report = s->step();
    EXPECT_FALSE(report.failed) << report.failure;
    const WaterBalance water = s->water();
    const double displaced = s->model().displacement;
    drift.visible = std::max(drift.visible, std::abs(water.visible - start) / displaced);
    drift.with_owed =
        std::max(drift.with_owed, std::abs(water.visible + water.reservoir - start) / displaced);
  }
  return drift;
}

TEST(Simulation, VolumeBookKeepsTheVisibleWaterOfARollingBarge) {
  const Drift with = rolling_drift(true), without = rolling_drift(false);
  std::cout << "drift over displacement: corrected " << with.visible << " (" << with.with_owed
            << " with what is owed), not corrected " << without.visible << "\n";
  EXPECT_LT(with.visible, 1e-4);
  // most.
  EXPECT_LT(with.with_owed, 1e-8);  // to the residual of the solve
  EXPECT_GT(without.visible, 5 * with.visible);
}

TEST(Simulation, PrescribedMotionFollowsItsFunctionExactly) {
  Case c = barge(0.0125);
  c.body.prescribed = {{Dof::roll, 0.1, 0.5, 0.1}, {Dof::heave, 0.01, 0.4, 0.1}};
  const auto s = simulate(c);
  const motion::PrescribedMotion roll{motion::Dof::roll, 0.1, 0.5, 0.1};
  const motion::PrescribedMotion heave{motion::Dof::heave, 0.01, 0.4, 0.1};
  for (int i = 0; i < 25; ++i) {
    ASSERT_FALSE(s->step().failed);
    EXPECT_NEAR(s->body().pose.roll, roll.position(s->time()), 1e-14);
    EXPECT_NEAR(s->body().pose.cog[1], heave.position(s->time()), 1e-15);
    EXPECT_EQ(s->body().pose.cog[0], 0);
    // Velocities live half a step later: those that carry the hull to its next place.
    EXPECT_NEAR(s->body().twist[2], roll.mean_velocity(s->time(), s->dt()), 1e-14);
  }
}

/// A resumed run has the means of the leaves in the parents: the run that goes on must have them too, or the next pressure
/// solve starts from other values and ends with other bits.
TEST(Simulation, ParentsHoldTheMeansOfTheirLeavesAfterAStep) {
  Case c = barge(0.00625);
  c.body.prescribed = {{Dof::roll, 12 * degree, 0.6, 0.2}};
  const auto s = simulate(c);
  for (int i = 0; i < 20; ++i) ASSERT_FALSE(s->step().failed);
  auto p = s->state().p, vof = s->state().vof;
  field::restrict_cells<double, 2>(s->forest(), p);
  field::restrict_cells<double, 2>(s->forest(), vof);
  EXPECT_EQ(p.data(), s->state().p.data());
  EXPECT_EQ(vof.data(), s->state().vof.data());
  auto u = s->state().u, w = s->state().w;
  field::restrict_faces<double, 2>(s->forest(), u);
  field::restrict_faces<double, 2>(s->forest(), w);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_EQ(u.data(axis), s->state().u.data(axis)) << axis;
    EXPECT_EQ(w.data(axis), s->state().w.data(axis)) << axis;
  }
}

/// A tank without a hull, the calm surface between two grid lines.
Case empty_tank() {
  Case c = barge();
  c.hull = {};
  c.body = {};
  c.tank.lower = {0, -0.8, -0.41};
  c.tank.upper = {0, 0.8, 0.39};
  c.stages[0].mesh = {};
  return c;
}

TEST(Simulation, ZonesOfRestLeaveStillWaterStill) {
  // Relaxing the velocities after the weight had acted made the water lighter in the zones.
  Case c = empty_tank();
  c.zones.generation_length = c.zones.absorption_length = 0.4;
  c.zones.rate = 10;
  c.numerics.pressure_tolerance = 1e-10;
  const auto s = simulate(c);
  for (int i = 0; i < 20; ++i) ASSERT_FALSE(s->step().failed);
  EXPECT_LT(largest_velocity(*s), 1e-9);
  EXPECT_EQ(s->exchanged(), 0);
}

TEST(Simulation, ZonesKeepTheLevelOfATankWithWaves) {
  // The same fault: the mean level fell by 30 mm in 14 s, 2 mm in a period like this. Measured
  // against the wave's own water in the tank, which is no whole number of wavelengths long.
  Case c = empty_tank();
  c.wave.kind = Wave::Kind::regular;
  c.wave.height = 0.05;
  c.wave.period = 0.8;
  c.zones.generation_length = c.zones.absorption_length = 0.5;
  c.time.dt = 0.8 / 60;
  c.stages[0].mesh.surface = {{0.0125, 0.04}};
  const auto s = simulate(c);
  const auto level = [&] {  // over that of the exact wave [m]
    double wave = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i)
      wave += s->model().wave->elevation(0, -0.8 + 1.6 * (i + 0.5) / n, s->time()) / n;
    return s->water().visible / 1.6 - 0.41 - wave;
  };
  EXPECT_NEAR(level(), 0, 1e-5);
  const double start = s->water().visible;
  double sum = 0;
  for (int i = 0; i < 60; ++i) {
    ASSERT_FALSE(s->step().failed);
    sum += level() / 60;
    // All water that came or went is in the book, to the divergence left by the solve.
    EXPECT_NEAR(s->water().visible, start + s->water().exchanged, 1e-5);
  }
  std::cout << "level over the wave's: mean " << sum << " m, at the end " << level() << " m\n";
  EXPECT_NEAR(sum, 0, 1e-3);
  EXPECT_NEAR(level(), 0, 1e-3);
}

TEST(Simulation, WaveInAPeriodicBoxKeepsItsHeightAndSpeed) {
  Case c = empty_tank();
  c.tank.periodic = {false, true, false};
  c.wave.kind = Wave::Kind::regular;
  c.wave.height = 0.06;
  c.wave.length = 1.6;
  c.time.dt = 0;  // 1/120 of the period
  c.stages[0].mesh.surface = {{0.0125, 0.05}};
  const auto s = simulate(c);
  const auto profile = [&] {  // first harmonic of the surface
    double a = 0, b = 0;
    const int n = 64;
    for (int i = 0; i < n; ++i) {
      const double y = -0.8 + 1.6 * (i + 0.5) / n, z = s->elevation(0, y);
      a += 2 * z * std::cos(2 * pi * y / 1.6) / n;
      b += 2 * z * std::sin(2 * pi * y / 1.6) / n;
    }
    return std::pair{std::hypot(a, b), std::atan2(b, a)};
  };
  const auto start = profile();
  const double water = s->water().visible;
  while (s->time() < s->model().wave->period() - 1e-9) ASSERT_FALSE(s->step().failed);
  const auto end = profile();
  std::cout << "after one period: height " << end.first / start.first << ", phase "
            << end.second - start.second << "\n";
  EXPECT_NEAR(s->time(), s->model().wave->period(), 1e-9);
  EXPECT_NEAR(end.first / start.first, 1, 0.02);  // 5 cells a height
  EXPECT_NEAR(std::remainder(end.second - start.second, 2 * pi), 0, 2 * pi * 0.01);
  EXPECT_NEAR(s->water().visible, water, 1e-5 * water);
}

TEST(Simulation, FreeBargeAtItsDraftStaysThere) {
  Case c = barge(0.0125);
  c.body.free = {Dof::sway, Dof::heave, Dof::roll};
  c.body.mass = 15 + 1.2 * 0.3 * 0.05;  // the air above the water carries its part
  const auto s = simulate(c);
  for (int i = 0; i < 40; ++i) ASSERT_FALSE(s->step().failed);
  EXPECT_NEAR(s->body().pose.cog[1], 0, 0.01 * 0.0125);
  EXPECT_NEAR(s->body().pose.roll, 0, 0.05 * degree);
  EXPECT_NEAR(s->load()[1], c.body.mass * 9.81, 1e-3 * c.body.mass * 9.81);
}

TEST(Simulation, HeavyAndLightBodiesDoNotMakeItUnstable) {
  // The added mass of the heave is about the displaced one: coupling by turns diverges within ten
  // steps.
  for (const double mass : {3.0, 15.0, 27.0}) {
    Case c = barge(0.0125);
    c.body.free = {Dof::heave};
    c.body.mass = mass;
    c.body.draft = mass / 300;
    c.body.offset = {0, 0, 0.01};
    const auto s = simulate(c);
    for (int i = 0; i < 40; ++i) {
      ASSERT_FALSE(s->step().failed) << mass;
      ASSERT_LT(std::abs(s->body().pose.cog[1] - s->model().rest_cog[1]), 0.011) << mass;
    }
  }
}

}  // namespace
}  // namespace seaway::sim
