// Interface and momentum transport on periodic tanks with level jumps.
#include "core/flow/advection.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "tests/unit/core/flow/tanks.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

template <int Dim>
constexpr int roots = Dim == 2 ? 3 : 2;

/// A wavy surface that crosses the level jumps of a periodic tank.
template <int Dim>
double wavy(const Vec<Dim>& x) {
  const double k = 2 * pi / roots<Dim>;
  double z = 0.5 * roots<Dim> + 0.13;
  for (int a = 0; a + 1 < Dim; ++a) z += 0.17 * std::sin(k * x[a] + 0.3 * a);
  return z;
}

template <int Dim>
Forest<Dim> jumpy(bool periodic = true, int threads = 1) {
  return unit_tank<Dim>(roots<Dim>, 0.3, Dim == 2 ? 1.6 : 0.9, Dim == 2 ? 2 : 1, periodic, threads);
}

template <int Dim>
void uniform_flow(int steps) {
  const auto forest = jumpy<Dim>();
  ASSERT_FALSE(forest.coarse_faces().empty());
  FlowState<Dim> state(forest);
  fill_water<Dim>(forest, wavy<Dim>, state);
  const double velocity[3] = {0.7, Dim == 2 ? 0.4 : -0.3, 0.4};
  const auto constant = [&](const Vec<Dim>&, int axis) { return velocity[axis]; };
  fill_faces<Dim>(forest, constant, state.u);
  fill_faces<Dim>(forest, constant, state.w);
  Advection<Dim> advection(forest, {}, {});
  const double dt = 0.45 / advection.courant_number(state.w, 1.0);
  const double before = water_volume<Dim>(forest, state.vof);
  for (int s = 0; s < steps; ++s) advection.advance(state, dt, s);  // every order of the sweeps
  double error = 0, low = 0, high = 0;
  for (int axis = 0; axis < Dim; ++axis)
    each_face<Dim>(forest, axis, [&](int b, const IVec<Dim>& i) {
      error = std::max(error, std::abs(face_of(state.u, axis, b, i) - velocity[axis]));
    });
  each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) {
    low = std::min(low, cell_of(state.vof, b, i));
    high = std::max(high, cell_of(state.vof, b, i) - 1);
  });
  // Rounding of numbers of order 1, divided by the mass of air where water was (ratio 833).
  EXPECT_LT(error, 1e-11);
  EXPECT_NEAR(water_volume<Dim>(forest, state.vof), before, 1e-13 * before);
  EXPECT_GT(low, -1e-12);
  EXPECT_LT(high, 1e-12);
}
TEST(Advection, KeepsAUniformVelocityAndTheWaterIn2D) { uniform_flow<2>(60); }
TEST(Advection, KeepsAUniformVelocityAndTheWaterIn3D) { uniform_flow<3>(12); }

template <int Dim>
FlowState<Dim> cellular_flow(const Forest<Dim>& forest) {
  FlowState<Dim> state(forest);
  fill_water<Dim>(forest, wavy<Dim>, state);
  const double k = 2 * pi / roots<Dim>;
  const auto wrap = [](double x) { return x - roots<Dim> * std::floor(x / roots<Dim>); };
  const auto psi = [=](double x, double z) {
    return std::sin(k * wrap(x)) * std::cos(k * wrap(z)) / k;
  };
  fill_stream<Dim>(forest, psi, state.w);
  for (double& w : state.w.data(0)) w += 0.3;
  EXPECT_EQ(duplicate_difference<Dim>(forest, state.w), 0);
  return state;
}

// The copies of a face drifted apart when one of its two blocks had a coarser neighbour: each
// gathered the surroundings of the face in its own way.
template <int Dim>
void shared_faces(int steps) {
  const auto forest = jumpy<Dim>();
  FlowState<Dim> state = cellular_flow<Dim>(forest);
  const auto rough = [](Vec<Dim> x, int axis) {
    for (int a = 0; a < Dim; ++a) x[a] = x[a] < roots<Dim> ? x[a] : 0.0;  // periodic
    return noise<Dim>(x) + 0.2 * axis;
  };
  fill_faces<Dim>(forest, rough, state.u);
  ASSERT_EQ(duplicate_difference<Dim>(forest, state.u), 0);
  Advection<Dim> advection(forest, {}, {});
  const double dt = 0.45 / advection.courant_number(state.w, 1.0);
  const double water = water_volume<Dim>(forest, state.vof);
  for (int s = 0; s < steps; ++s) {
    advection.advance(state, dt, s);
    // Rounding: blocks with and without an interface near them sum the same terms in another order.
    ASSERT_LT(duplicate_difference<Dim>(forest, state.u), 1e-14) << "after step " << s;
  }
  double low = 0, high = 0, largest = 0;
  each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) {
    low = std::min(low, cell_of(state.vof, b, i));
    high = std::max(high, cell_of(state.vof, b, i) - 1);
  });
  for (int axis = 0; axis < Dim; ++axis)
    each_face<Dim>(forest, axis, [&](int b, const IVec<Dim>& i) {
      largest = std::max(largest, std::abs(face_of(state.u, axis, b, i)));
    });
  EXPECT_GT(low, -1e-12);
  EXPECT_LT(high, 1e-12);
  EXPECT_NEAR(water_volume<Dim>(forest, state.vof), water, 1e-13 * water);
  EXPECT_LT(largest, 2.8) << "twice what there was: limited, but not strictly monotone";
}
TEST(Advection, BothCopiesOfAFaceStayTheSameIn2D) { shared_faces<2>(40); }
TEST(Advection, BothCopiesOfAFaceStayTheSameIn3D) { shared_faces<3>(9); }

template <int Dim>
Vec<Dim> momentum(const Forest<Dim>& forest, const FlowState<Dim>& state,
                  const FluidProperties& fluids, double& scale) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  scale = 0;
  for (int axis = 0; axis < Dim; ++axis)
    for (const int b : forest.leaves()) {
      field::Scratch<double, Dim> vof;
      field::gather_cells<double, Dim>(forest, state.vof, b, 1, vof);
      field::for_box<Dim>(
          field::filled<Dim>(0), field::cells_upper<Dim>(), [&](const IVec<Dim>& i) {
            IVec<Dim> below = i;
            --below[axis];
            const double mass = 0.5 * (fluids.rho(vof(i)) + fluids.rho(vof(below)));
            const double m = mass * face_of(state.u, axis, b, i) * forest.block(b).cell_volume();
            sum[axis] += m;
            scale += std::abs(m);
          });
    }
  return sum;
}

template <int Dim>
void momentum_is_kept(int steps) {
  const auto forest = unit_tank<Dim>(roots<Dim>, 0, 0, 0, true);
  FlowState<Dim> state = cellular_flow<Dim>(forest);
  for (int axis = 0; axis < Dim; ++axis) state.u.data(axis) = state.w.data(axis);
  const FluidProperties fluids;
  Advection<Dim> advection(forest, fluids, {});
  const double dt = 0.4 / advection.courant_number(state.w, 1.0);
  double scale = 0;
  const Vec<Dim> before = momentum<Dim>(forest, state, fluids, scale);
  for (int s = 0; s < steps; ++s) advection.advance(state, dt, s);
  const Vec<Dim> after = momentum<Dim>(forest, state, fluids, scale);
  for (int a = 0; a < Dim; ++a) EXPECT_NEAR(after[a], before[a], 1e-12 * scale);
}
TEST(Advection, KeepsMomentumInAPeriodicBoxIn2D) { momentum_is_kept<2>(40); }
TEST(Advection, KeepsMomentumInAPeriodicBoxIn3D) { momentum_is_kept<3>(9); }

TEST(Advection, CourantNumberIsTheSumOverDirectionsOnTheFinestCells) {
  const auto forest = jumpy<2>();
  FlowState<2> state(forest);
  fill_faces<2>(
      forest, [](const Vec2&, int axis) { return axis == 0 ? 1.5 : -0.5; }, state.w);
  const Advection<2> advection(forest, {}, {});
  const double h = 1.0 / 64;
  EXPECT_NEAR(advection.courant_number(state.w, 0.01), 0.01 * (1.5 + 0.5) / h, 1e-13);
  face_of(state.w, 0, forest.leaves()[3], IVec<2>{4, 4}) = std::nan("");
  EXPECT_TRUE(std::isnan(advection.courant_number(state.w, 0.01)));
}

TEST(Advection, SweptWaterOfAllSweepsIsWhatTheCellsGainAndLose) {
  const auto forest = jumpy<2>();
  FlowState<2> state = cellular_flow<2>(forest);
  Advection<2> advection(forest, {}, {});
  const double dt = 0.45 / advection.courant_number(state.w, 1.0);
  FaceField<double, 2> sum(forest);
  advection.set_flux_visitor([&](int axis, const FaceField<double, 2>& swept) {
    for (std::size_t k = 0; k < sum.data(axis).size(); ++k)
      sum.data(axis)[k] += swept.data(axis)[k];
  });
  const auto before = state.vof;
  advection.advance(state, dt, 1);
  double largest = 0;
  each_cell<2>(forest, [&](int b, const IVec<2>& i) {
    double gain = 0;
    for (int axis = 0; axis < 2; ++axis) {
      IVec<2> next = i;
      ++next[axis];
      gain += (face_of(sum, axis, b, i) - face_of(sum, axis, b, next)) / forest.block(b).h[axis];
    }
    largest = std::max(largest, std::abs(cell_of(state.vof, b, i) - cell_of(before, b, i) - gain));
  });
  EXPECT_LT(largest, 1e-12);  // w is solenoidal to rounding, so the dilation cancels
}

TEST(Advection, SurfaceComesBackAfterOnePassage) {
  // A block of water carried once through the periodic tank and its level jumps; the error of the
  // sharp corners is of the size of the coarse cells along the edges.
  const auto forest = unit_tank<2>(3, 0.3, 1.6, 1, true);
  FlowState<2> state(forest);
  const double cx = 1.5, cz = 1.5, half = 0.5;
  each_cell<2>(forest, [&](int b, const IVec<2>& i) {
    const auto& block = forest.block(b);
    const Vec2 x = block.cell_centre(i);
    const auto part = [&](double c, double at, double h) {
      return std::clamp((half - std::abs(at - c)) / h + 0.5, 0.0, 1.0);
    };
    cell_of(state.vof, b, i) = part(cx, x[0], block.h[0]) * part(cz, x[1], block.h[1]);
  });
  field::restrict_cells<double, 2>(forest, state.vof);
  fill_faces<2>(
      forest, [](const Vec2&, int) { return 1.0; }, state.w);
  state.u = state.w;
  Advection<2> advection(forest, {}, {});
  const auto start = state.vof;
  const int steps = 400;  // Courant number 3 / 400 * 2 * 32 = 0.48
  for (int s = 0; s < steps; ++s) advection.advance(state, 3.0 / steps, s);
  double error = 0;
  each_cell<2>(forest, [&](int b, const IVec<2>& i) {
    error +=
        std::abs(cell_of(state.vof, b, i) - cell_of(start, b, i)) * forest.block(b).cell_volume();
  });
  std::cout << "translation error " << error << " of 1\n";
  EXPECT_LT(error, 0.06);
}

}  // namespace
}  // namespace seaway::flow
