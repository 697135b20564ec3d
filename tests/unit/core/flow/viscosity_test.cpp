#include "core/flow/viscosity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <vector>

#include "core/flow/advection.hpp"
#include "core/flow/projection.hpp"
#include "tests/unit/core/flow/tanks.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

FluidProperties one_fluid(double nu) {
  FluidProperties fluids;
  fluids.rho_water = fluids.rho_air = 1000;
  fluids.nu_water = fluids.nu_air = nu;
  fluids.gravity = 0;
  return fluids;
}

/// u_0 = sin(k z) in a periodic box: decays as exp(-nu k^2 t).
template <int Dim>
void shear_wave() {
  const auto forest = unit_tank<Dim>(1, 0, 0, 0, true);
  FlowState<Dim> state(forest);
  fill_water<Dim>(
      forest, [](const Vec<Dim>&) { return 10.0; }, state);
  const double k = 2 * pi, nu = 0.01, t = 0.5;
  fill_faces<Dim>(
      forest,
      [k](const Vec<Dim>& x, int axis) { return axis == 0 ? std::sin(k * x[Dim - 1]) : 0.0; },
      state.u);
  Viscosity<Dim> viscosity(forest, one_fluid(nu), {});
  const int steps = static_cast<int>(std::ceil(t / (0.25 * viscosity.step_limit())));
  const auto start = state.u;
  for (int s = 0; s < steps; ++s) viscosity.apply(state, t / steps);
  // The discrete rate is known: (2 - 2 cos(k h)) / h^2 in place of k^2.
  const double h = 1.0 / BlockShape<Dim>::n;
  const double rate = nu * (2 - 2 * std::cos(k * h)) / (h * h);
  const double discrete = std::pow(1 - rate * t / steps, steps);
  double error = 0;
  for (int axis = 0; axis < Dim; ++axis)
    each_face<Dim>(forest, axis, [&](int b, const IVec<Dim>& i) {
      error = std::max(
          error, std::abs(face_of(state.u, axis, b, i) - discrete * face_of(start, axis, b, i)));
    });
  EXPECT_LT(error, 1e-13);
  EXPECT_NEAR(discrete, std::exp(-nu * k * k * t), (Dim == 2 ? 0.006 : 0.02));
}
TEST(Viscosity, ShearWaveDecaysAtTheDiscreteRateIn2D) { shear_wave<2>(); }
TEST(Viscosity, ShearWaveDecaysAtTheDiscreteRateIn3D) { shear_wave<3>(); }

TEST(Viscosity, StepLimitIsThatOfTheFinestCellsAndTheThinnestFluid) {
  const auto forest = unit_tank<2>(2, 0.1, 0.9, 1, false);
  FluidProperties fluids;
  fluids.nu_air = 2e-5;
  const Viscosity<2> viscosity(forest, fluids, {});
  // Twice the viscosity beside the surface; three parts of the stress, one of them along the step's own axis twice.
  EXPECT_NEAR(viscosity.step_limit(), 1.0 / (32.0 * 32.0) / (2 * 3 * 2 * 2e-5), 1e-9);
}

/// Relative error of the velocity of a Taylor-Green vortex in a periodic unit box at t = 0.25.
double taylor_green(int roots) {
  mesh::TankGrid<2> grid;
  grid.lower.setZero();
  grid.upper.setConstant(1);
  grid.root_blocks.fill(roots);
  grid.periodic.fill(true);
  const Forest<2> forest(grid, 0, [](const Vec2&, const Vec2&, int) { return false; });
  FlowState<2> state(forest);
  fill_water<2>(
      forest, [](const Vec2&) { return 10.0; }, state);
  const double k = 2 * pi, nu = 0.01;
  fill_stream<2>(
      forest, [k](double x, double z) { return std::sin(k * x) * std::sin(k * z) / k; }, state.u);
  const auto start = state.u;
  const auto fluids = one_fluid(nu);
  Advection<2> advection(forest, fluids, {});
  Viscosity<2> viscosity(forest, fluids, {});
  Projection<2> projection(forest, fluids, {});
  motion::Twist<2> twist = motion::Twist<2>::Zero();
  const int steps = 5 * 16 * roots / 4;
  const double dt = 0.25 / steps;
  projection.mixture_velocity(state, nullptr, twist);
  for (int s = 0; s < steps; ++s) {
    advection.advance(state, dt, s);
    viscosity.apply(state, dt);
    projection.prepare(state, nullptr);
    const auto report =
        projection.project(state, nullptr, twist, motion::DofMatrix<2>::Zero(), dt, {1e-8, 200});
    EXPECT_TRUE(report.converged);
  }
  const double decay = std::exp(-2 * nu * k * k * 0.25);
  double error = 0, scale = 0;
  for (int axis = 0; axis < 2; ++axis)
    each_face<2>(forest, axis, [&](int b, const IVec<2>& i) {
      const double exact = decay * face_of(start, axis, b, i);
      error += std::pow(face_of(state.u, axis, b, i) - exact, 2);
      scale += exact * exact;
    });
  return std::sqrt(error / scale);
}

TEST(Viscosity, TaylorGreenVortexDecaysAtTheExactRate) {
  const double coarse = taylor_green(1), fine = taylor_green(2);
  std::cout << "Taylor-Green errors " << coarse << ", " << fine << "\n";
  EXPECT_LT(coarse, 0.08);
  EXPECT_LT(fine, 0.6 * coarse);  // at least first order, with dt in proportion
}

/// Two fluids between plates, the upper one moving: the speed at their border, from rest to the steady state, in parts of
/// the plate's. Exact: the stress is the same in both, and so the drops of speed are as thickness over mu = rho nu.
struct Couette {
  double border = 0, exact = 0;
  double stress_range = 0;  ///< in the two fluids away from the border, (largest - smallest) / mean
};

Couette two_layers(int roots) {
  mesh::TankGrid<2> grid;
  grid.lower.setZero();
  grid.upper = Vec2(1, 1);
  grid.root_blocks.fill(roots);
  grid.periodic = {true, false};
  const Forest<2> forest(grid, 0, [](const Vec2&, const Vec2&, int) { return false; });
  const double h = 1.0 / (16 * roots), middle = 0.5;
  FlowState<2> state(forest);
  fill_water<2>(forest, [&](const Vec2&) { return middle; }, state);
  FluidProperties fluids;
  fluids.rho_water = 1000;
  fluids.rho_air = 10;
  fluids.nu_water = 0.01;
  fluids.nu_air = 0.05;
  field::Boundaries<2> sides;
  for (int side = 0; side < 2; ++side) sides.wall[1][static_cast<std::size_t>(side)].no_slip = true;
  sides.wall[1][1].velocity = Vec2(1, 0);
  Viscosity<2> viscosity(forest, fluids, sides);
  for (int s = 0; s < 400; ++s) viscosity.apply(state, 0.5);
  // One column: speeds at cell centres.
  std::vector<std::pair<double, double>> column;
  each_face<2>(forest, 0, [&](int b, const IVec<2>& i) {
    const Vec2 x = forest.block(b).cell_centre(i);
    if (x[0] < h) column.emplace_back(x[1], face_of(state.u, 0, b, i));
  });
  std::sort(column.begin(), column.end());
  const double mu_water = fluids.rho_water * fluids.nu_water, mu_air = fluids.rho_air * fluids.nu_air;
  const std::size_t half = column.size() / 2;
  double low = 1e9, high = -1e9;
  for (std::size_t k = 1; k < column.size(); ++k) {
    if (k == half) continue;
    const double stress = (k < half ? mu_water : mu_air) * (column[k].second - column[k - 1].second) / h;
    low = std::min(low, stress);
    high = std::max(high, stress);
  }
  Couette c;
  c.stress_range = (high - low) / (0.5 * (high + low));
  c.border = column[half - 1].second + 0.5 * (column[half - 1].second - column[half - 2].second);
  c.exact = 1 / (1 + mu_water / mu_air);
  return c;
}

TEST(Viscosity, TwoLayersBetweenPlatesHaveOneStress) {
  const Couette coarse = two_layers(1), fine = two_layers(2);
  std::cout << "Couette, speed at the border " << coarse.border << ", " << fine.border << ", exact " << fine.exact
            << "; stress differs by " << fine.stress_range << "\n";
  EXPECT_LT(coarse.stress_range, 1e-6);
  EXPECT_LT(fine.stress_range, 1e-6);
  // The border's own edge has a harmonic rho and a mean nu: of first order.
  EXPECT_NEAR(coarse.border, coarse.exact, 0.05 * coarse.exact);
  EXPECT_LT(std::abs(fine.border - fine.exact), 0.6 * std::abs(coarse.border - coarse.exact));
}

}  // namespace
}  // namespace seaway::flow
