#include "core/flow/k_epsilon.hpp"

#include <gtest/gtest.h>

#include "core/flow/advection.hpp"
#include "core/flow/super_steps.hpp"
#include "core/flow/viscosity.hpp"
#include "tests/unit/core/flow/tanks.hpp"

namespace seaway::flow {
namespace {

using namespace testing;
using Model = TurbulenceSpec::Model;

FluidProperties water_only(double nu = 1e-6) {
  FluidProperties fluids;
  fluids.rho_air = fluids.rho_water;
  fluids.nu_air = fluids.nu_water = nu;
  return fluids;
}

template <int Dim>
void fill(CellField<double, Dim>& f, const Forest<Dim>& forest, const std::function<double(const Vec<Dim>&)>& g) {
  each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) { cell_of(f, b, i) = g(forest.block(b).cell_centre(i)); });
  field::restrict_cells<double, Dim>(forest, f);
}

template <int Dim>
void water_everywhere(const Forest<Dim>& forest, FlowState<Dim>& state) {
  fill_water<Dim>(forest, [](const Vec<Dim>&) { return 100.0; }, state);
}

TEST(SuperSteps, StagesGrowWithTheSquareRootOfTheStep) {
  EXPECT_EQ(super_stages(0.3), 1);
  EXPECT_EQ(super_stages(1.0), 1);
  EXPECT_EQ(super_stages(1.01), 2);
  EXPECT_EQ(super_stages(3.0), 2);
  EXPECT_EQ(super_stages(55.0), 10);
  EXPECT_ANY_THROW((void)super_stages(std::nan("")));
}

TEST(SuperSteps, WeightsKeepAConstantAndDampTheStiffestMode) {
  for (const int s : {1, 2, 5, 12}) {
    const double z = -(static_cast<double>(s) * (s + 1));  // dt lambda at the limit: the explicit one is -2
    double before = 1, now = 1 + super_step(1, s).rate * z;
    for (int j = 2; j <= s; ++j) {
      const SuperStep w = super_step(j, s);
      EXPECT_NEAR(w.previous + w.before, 1, 1e-14);
      const double next = w.previous * now + w.before * before + w.rate * z * now;
      before = now;
      now = next;
    }
    EXPECT_LE(std::abs(now), 1 + 1e-12) << s;
  }
}

/// Decay of uniform turbulence over `steps` steps of dt against the exact solution.
template <int Dim>
double decay_error(int steps, double dt) {
  const auto forest = unit_tank<Dim>(1, 0, 0, 0, true);
  FlowState<Dim> state(forest);
  water_everywhere(forest, state);
  TurbulenceSpec spec{Model::standard, false, 0.01, 0.02};
  KEpsilon<Dim> model(forest, water_only(), {}, spec);
  model.initialise(state);
  for (int i = 0; i < steps; ++i) {
    model.advance(state, dt, {});
    model.update_nu_t(state);
  }
  const double growth = 1 + (k_epsilon::c_2 - 1) * steps * dt * spec.epsilon / spec.tke;
  return std::abs(state.tke.block(0)[3] / (spec.tke * std::pow(growth, -1 / (k_epsilon::c_2 - 1))) - 1);
}

TEST(KEpsilon, TurbulenceDecaysAsTheExactSolutionAtSecondOrder) {
  const double coarse = decay_error<2>(20, 0.05), fine = decay_error<2>(40, 0.025);
  EXPECT_LT(coarse, 3e-3);  // steps of a tenth of k / epsilon
  EXPECT_LT(fine, coarse / 3.5);
  EXPECT_NEAR(decay_error<3>(20, 0.05), coarse, 1e-12);
}

TEST(KEpsilon, ShearInEquilibriumStaysAndHasTheEddyViscosityOfTheModel) {
  // u = S z with P = epsilon would grow in k-epsilon; of the first step both models must agree: the limiter is
  // passive in shear.
  for (const Model kind : {Model::standard, Model::stabilised}) {
    const auto forest = unit_tank<2>(1, 0, 0, 0, false);
    FlowState<2> state(forest);
    water_everywhere(forest, state);
    fill_faces<2>(forest, [](const Vec2& x, int axis) { return axis == 0 ? 3 * x[1] : 0.0; }, state.u);
    KEpsilon<2> model(forest, water_only(), {}, {kind, false, 0.01, 0.009});
    model.initialise(state);
    model.find_nu_t(state);
    // Not in the row at the walls, where the tank slips.
    EXPECT_NEAR(model.nu_t().block(0)[8 * 16 + 8], 0.09 * 1e-4 / 0.009, 1e-12);
    model.advance(state, 1e-3, {});
    const double nu_t = 1e-3, production = nu_t * 9;  // = epsilon
    EXPECT_NEAR(state.tke.block(0)[8 * 16 + 8], 0.01 + 1e-3 * (production - 0.009), 1e-8);
    const double rate = 0.9 * (1.44 * production - 1.92 * 0.009);
    EXPECT_NEAR(state.epsilon.block(0)[8 * 16 + 8], 0.009 + 1e-3 * rate, 1e-7);
  }
}

/// nu_t after `time` in a strain without rotation that swings like that under a wave, over nu_t at the start.
double growth_under_waves(Model kind) {
  const auto forest = unit_tank<2>(1, 0, 0, 0, false);
  FlowState<2> state(forest);
  water_everywhere(forest, state);
  KEpsilon<2> model(forest, water_only(), {}, {kind, false, 1e-6, 1e-7});
  model.initialise(state);
  const double dt = 0.01, omega = 2 * pi / 1.4, k = omega * omega / 9.81, amplitude = 0.05;
  for (int i = 0; i < 2800; ++i) {  // 20 periods of potential flow: u = a omega e^kz (cos, sin)(ky - wt)
    const double t = i * dt;
    fill_faces<2>(forest, [&](const Vec2& x, int axis) {
      const double phase = k * x[0] - omega * t, speed = amplitude * omega * std::exp(k * (x[1] - 0.5));
      return speed * (axis == 0 ? std::cos(phase) : std::sin(phase));
    }, state.u);
    model.advance(state, dt, {});
    model.update_nu_t(state);
  }
  return model.nu_t().block(0)[8 * 16 + 8] / 0.9e-6;
}

TEST(KEpsilon, EddyViscosityUnderWavesGrowsWithTheStandardModelOnly) {
  EXPECT_GT(growth_under_waves(Model::standard), 100);
  EXPECT_LT(growth_under_waves(Model::stabilised), 1);
}

TEST(KEpsilon, StaysPositiveWhateverTheStep) {
  const auto forest = unit_tank<2>(2, 0.4, 1.2, 1, false);
  FlowState<2> state(forest);
  fill_water<2>(forest, [](const Vec2& x) { return 1 + 0.2 * std::sin(5 * x[0]); }, state);
  FluidProperties fluids;
  KEpsilon<2> model(forest, fluids, {}, {Model::standard, true, 1e-3, 1e-3});
  model.initialise(state);
  fill<2>(state.tke, forest, [](const Vec2& x) { return 1e-3 * std::pow(10.0, 4 * noise<2>(x)); });
  fill_faces<2>(forest, [](const Vec2& x, int axis) { return noise<2>(x) * (axis + 1); }, state.u);
  for (const double dt : {1e-3, 1.0, 100.0}) {
    model.advance(state, dt, {});
    model.update_nu_t(state);
    each_cell<2>(forest, [&](int b, const IVec<2>& i) {
      const double k = cell_of(state.tke, b, i), e = cell_of(state.epsilon, b, i);
      ASSERT_TRUE(std::isfinite(k) && std::isfinite(e)) << dt;
      ASSERT_GT(k, 0) << dt;
      ASSERT_GT(e, 0) << dt;
    });
  }
}

TEST(KEpsilon, BuoyancyTakesEnergyAtTheFreeSurfaceAlone) {
  const auto after = [](bool buoyancy, double height) {
    const auto forest = unit_tank<2>(2, 0, 0, 0, false);
    FlowState<2> state(forest);
    fill_water<2>(forest, [](const Vec2&) { return 1.03; }, state);
    KEpsilon<2> model(forest, FluidProperties{}, {}, {Model::stabilised, buoyancy, 1e-3, 1e-4});
    model.initialise(state);
    model.advance(state, 0.01, {});
    return state.tke.block(forest.find_leaf(Vec2(0.5, height)))[0 * 16 + 8 + 16 * static_cast<int>((height - std::floor(height)) * 16)];
  };
  EXPECT_LT(after(true, 1.01), 0.5 * after(false, 1.01));
  EXPECT_NEAR(after(true, 0.5), after(false, 0.5), 1e-12);
}

TEST(ScalarSweep, AUniformScalarStaysAndASpikeStaysPositiveAcrossTheSurface) {
  const auto forest = unit_tank<2>(2, 0.4, 1.2, 1, false);
  FlowState<2> state(forest);
  fill_water<2>(forest, [](const Vec2& x) { return 1 + 0.2 * std::sin(5 * x[0]); }, state);
  const FluidProperties fluids;
  Advection<2> advection(forest, fluids, {});
  const double pi_2 = pi / 2;
  fill_stream<2>(forest, [&](double x, double z) { return std::sin(pi_2 * x) * std::sin(pi_2 * z) / 2; }, state.w);
  state.u = state.w;
  state.tke = CellField<double, 2>(forest, 0.3);
  state.epsilon = CellField<double, 2>(forest);
  fill<2>(state.epsilon, forest, [](const Vec2& x) { return (x - Vec2(0.7, 0.8)).norm() < 0.1 ? 1e3 : 1e-6; });
  double largest = 0;
  for (int s = 0; s < 40; ++s) advection.advance(state, 0.01, s);
  each_cell<2>(forest, [&](int b, const IVec<2>& i) {
    largest = std::max(largest, std::abs(cell_of(state.tke, b, i) - 0.3));
    ASSERT_GT(cell_of(state.epsilon, b, i), 0);
  });
  EXPECT_LT(largest, 1e-10);
}

/// u_0 = sin(k z) with eddy viscosity decays as with molecular viscosity nu + nu_t, also over steps far beyond
/// the explicit limit.
template <int Dim>
void shear_wave_with_eddies(double steps_of_limit, double tolerance) {
  const auto forest = unit_tank<Dim>(1, 0, 0, 0, true);
  FlowState<Dim> state(forest);
  water_everywhere(forest, state);
  const double k = 2 * pi, nu = 0.01;
  fill_faces<Dim>(forest, [k](const Vec<Dim>& x, int axis) { return axis == 0 ? std::sin(k * x[Dim - 1]) : 0.0; },
                  state.u);
  Viscosity<Dim> viscosity(forest, water_only(0.2 * nu), {});
  const CellField<double, Dim> nu_t(forest, 0.8 * nu);
  const double h = 1.0 / BlockShape<Dim>::n;
  const double dt = steps_of_limit * h * h / (2 * Dim * nu);
  const auto start = state.u;
  const int stages = viscosity.apply(state, dt, &nu_t);
  EXPECT_EQ(stages == 1, steps_of_limit < 0.5);
  const double decay = std::exp(-nu * (2 - 2 * std::cos(k * h)) / (h * h) * dt);
  double error = 0;
  each_face<Dim>(forest, 0, [&](int b, const IVec<Dim>& i) {
    error = std::max(error, std::abs(face_of(state.u, 0, b, i) - decay * face_of(start, 0, b, i)));
  });
  EXPECT_LT(error, tolerance);
}
TEST(Viscosity, EddyStressDecaysAShearWaveIn2D) { shear_wave_with_eddies<2>(0.2, 1e-3); }
TEST(Viscosity, EddyStressDecaysAShearWaveIn3D) { shear_wave_with_eddies<3>(0.2, 2e-3); }
// First order in time: exp(-x) by stages at x = 0.46 and 0.64.
TEST(Viscosity, EddyStressHasNoStepLimitIn2D) { shear_wave_with_eddies<2>(12, 0.05); }
TEST(Viscosity, EddyStressHasNoStepLimitIn3D) { shear_wave_with_eddies<3>(6, 0.08); }

TEST(Viscosity, AStressTakesNoMomentumThroughASlipSideAndSomeThroughANoSlipSide) {
  for (const bool no_slip : {false, true}) {
    const auto forest = unit_tank<2>(1, 0, 0, 0, false);
    FlowState<2> state(forest);
    water_everywhere(forest, state);
    Boundaries<2> boundaries;
    boundaries.wall[1][0] = {no_slip, Vec2(0.5, 0)};
    fill_faces<2>(forest, [](const Vec2&, int axis) { return axis == 0 ? 1.0 : 0.0; }, state.u);
    Viscosity<2> viscosity(forest, water_only(1e-3), boundaries);
    const double dt = 0.1;
    viscosity.apply(state, dt);
    // Row at the bottom: the wall is half a cell away, 0.5 m/s slower.
    const double lost = no_slip ? dt * 1e-3 * 0.5 * 2 * 16 * 16 : 0;
    EXPECT_NEAR(state.u.block(0, 0)[8], 1 - lost, 1e-12);
    EXPECT_NEAR(state.u.block(0, 0)[8 + 17], 1, 1e-12);
  }
}

}  // namespace
}  // namespace seaway::flow
