// A region that takes more sub-steps than the rest of the mesh.
#include <gtest/gtest.h>

#include <iostream>

#include "core/flow/advection.hpp"
#include "tests/unit/core/flow/tanks.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

template <int Dim>
constexpr int roots = Dim == 2 ? 6 : 5;

template <int Dim>
Forest<Dim> jumpy(int threads = 1) {
  return unit_tank<Dim>(roots<Dim>, 1.3, 3.6, 1, true, threads);
}

/// A flow with a jet about x in the surface: a stream function with a narrow hump.
template <int Dim>
FlowState<Dim> jet(const Forest<Dim>& forest, double at = 2.6) {
  FlowState<Dim> state(forest);
  fill_water<Dim>(forest, [](const Vec<Dim>& x) { return 0.5 * roots<Dim> + 0.2 * std::sin(2 * pi / roots<Dim> * x[0]); }, state);
  const double k = 2 * pi / roots<Dim>;
  const auto wrap = [](double x) { return x - roots<Dim> * std::floor(x / roots<Dim>); };
  const auto psi = [=](double x, double z) {
    const double dx = wrap(x) - at, dz = wrap(z) - 0.5 * roots<Dim>;
    return std::sin(k * wrap(x)) * std::cos(k * wrap(z)) / k + 0.8 * std::exp(-(dx * dx + dz * dz) / 0.09);
  };
  fill_stream<Dim>(forest, psi, state.w);
  for (int axis = 0; axis < Dim; ++axis) state.u.data(axis) = state.w.data(axis);
  return state;
}

template <int Dim>
SubStepPlan<Dim> plan_for(const Forest<Dim>& forest, const Advection<Dim>& advection, const FlowState<Dim>& state, double dt) {
  return plan_sub_steps<Dim>(forest, advection.courant_numbers(state.w, dt), 0.45, true);
}

template <int Dim>
void plan_holds_the_limit() {
  const auto forest = jumpy<Dim>();
  const FlowState<Dim> state = jet<Dim>(forest);
  const Advection<Dim> advection(forest, {}, {});
  const double dt = 2.9 * 0.45 / advection.courant_number(state.w, 1.0);
  const auto courant = advection.courant_numbers(state.w, dt);
  const auto plan = plan_for<Dim>(forest, advection, state, dt);
  ASSERT_GT(plan.inner, 1);
  EXPECT_GE(plan.total(), 3);
  EXPECT_FALSE(plan.fast.empty());
  EXPECT_EQ(plan.fast.size() + plan.rest.leaves.size(), forest.leaves().size());
  EXPECT_LT(plan.region.leaves.size(), forest.leaves().size());
  std::vector<char> fast(static_cast<std::size_t>(forest.n_blocks()), 0), inside = fast;
  for (const int b : plan.fast) fast[static_cast<std::size_t>(b)] = 1;
  for (const int b : plan.region.leaves) inside[static_cast<std::size_t>(b)] = 1;
  for (std::size_t i = 0; i < courant.size(); ++i) {
    const auto b = static_cast<std::size_t>(forest.leaves()[i]);
    EXPECT_LE(courant[i] / (fast[b] ? plan.total() : plan.whole), 0.45 * (1 + 1e-12));
    EXPECT_TRUE(!fast[b] || inside[b]);
    EXPECT_TRUE(!fast[b] || plan.region.cut_sides[b] == 0) << "a ring lies around every fast leaf";
  }
  EXPECT_EQ(plan_sub_steps<Dim>(forest, courant, 0.45, false).whole, 3);
  EXPECT_EQ(plan_sub_steps<Dim>(forest, courant, 2.0, true).total(), 1);
}
TEST(SubStepPlan, HoldsTheLimitWithFewerLeavesIn2D) { plan_holds_the_limit<2>(); }
TEST(SubStepPlan, HoldsTheLimitWithFewerLeavesIn3D) { plan_holds_the_limit<3>(); }

/// Steps with the plan, and with as many sub-steps everywhere.
template <int Dim>
void same_as_everywhere(double at, int steps, double vof_bound, double u_bound) {
  const auto forest = jumpy<Dim>();
  FlowState<Dim> local = jet<Dim>(forest, at), whole = jet<Dim>(forest, at);
  Advection<Dim> advection(forest, {}, {}), reference(forest, {}, {});
  const double dt = 2.9 * 0.45 / advection.courant_number(local.w, 1.0);
  const auto plan = plan_for<Dim>(forest, advection, local, dt);
  ASSERT_GT(plan.inner, 1);
  FaceField<double, Dim> passed(forest);
  advection.set_flux_visitor([&](int axis, const FaceField<double, Dim>& swept) {
    for (std::size_t k = 0; k < passed.data(axis).size(); ++k) passed.data(axis)[k] += swept.data(axis)[k];
  });
  const CellField<double, Dim> before = local.vof;
  CellField<double, Dim> clipped(forest);
  double cut = 0;
  for (int s = 0; s < steps; ++s) {
    for (int k = 0; k < plan.whole; ++k) {
      for (const auto& clip : advection.advance(local, dt / plan.whole, s + k, plan)) {
        clipped.data()[static_cast<std::size_t>(clip.cell)] += clip.volume;
        cut += std::abs(clip.volume);
      }
      for (int i = 0; i < plan.inner; ++i) reference.advance(whole, dt / plan.total(), s + k);
    }
    ASSERT_LT(duplicate_difference<Dim>(forest, local.u), 1e-13) << "after step " << s;
  }
  double balance = 0, vof = 0, volume = 0, low = 0, high = 0, u = 0;
  each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) {
    const auto& block = forest.block(b);
    double gain = -cell_of(clipped, b, i) / block.cell_volume();
    for (int axis = 0; axis < Dim; ++axis) {
      IVec<Dim> next = i;
      ++next[axis];
      gain += (face_of(passed, axis, b, i) - face_of(passed, axis, b, next)) / block.h[axis];
    }
    const double now = cell_of(local.vof, b, i);
    balance = std::max(balance, std::abs(now - cell_of(before, b, i) - gain));
    vof += std::abs(now - cell_of(whole.vof, b, i)) * block.cell_volume();
    volume += block.cell_volume();
    low = std::min(low, now);
    high = std::max(high, now - 1);
  });
  for (int axis = 0; axis < Dim; ++axis)
    each_face<Dim>(forest, axis, [&](int b, const IVec<Dim>& i) {
      u = std::max(u, std::abs(face_of(local.u, axis, b, i) - face_of(whole.u, axis, b, i)));
    });
  EXPECT_LT(balance, 1e-12) << "what passed the faces is what the cells gained";
  EXPECT_GT(low, -1e-12);
  EXPECT_LT(high, 1e-12);
  EXPECT_LT(cut, 1e-5 * volume);
  EXPECT_LT(vof / volume, vof_bound);
  EXPECT_LT(u, u_bound);
  std::cout << "clipped " << cut / volume << ", vof " << vof / volume << ", u " << u << '\n';
}
// Speeds up to 3.8; the bounds are two to three times what the difference in time makes.
TEST(LocalAdvection, DiffersByTheTimeStepFromSubStepsEverywhereIn2D) { 
  for (const double at : {1.1, 1.6, 2.6, 3.3, 3.9}) {  // inside, beside and across the level jumps
    SCOPED_TRACE(at);
    same_as_everywhere<2>(at, 4, 4e-6, 0.1);
  }
}
TEST(LocalAdvection, DiffersByTheTimeStepFromSubStepsEverywhereIn3D) { same_as_everywhere<3>(2.6, 2, 1e-5, 0.03); }

TEST(LocalAdvection, KeepsAUniformVelocity) {
  const auto forest = jumpy<3>();
  FlowState<3> state = jet<3>(forest);
  fill_faces<3>(forest, [](const Vec3&, int axis) { return 0.3 + axis; }, state.u);
  Advection<3> advection(forest, {}, {});
  const double dt = 2.9 * 0.45 / advection.courant_number(state.w, 1.0);
  const auto plan = plan_for<3>(forest, advection, state, dt);
  ASSERT_GT(plan.inner, 1);
  for (int s = 0; s < 2; ++s) advection.advance(state, dt, s, plan);
  double error = 0;
  for (int axis = 0; axis < 3; ++axis)
    each_face<3>(forest, axis, [&](int b, const IVec<3>& i) {
      error = std::max(error, std::abs(face_of(state.u, axis, b, i) - (0.3 + axis)));
    });
  EXPECT_LT(error, 1e-10);
}

/// What a step does must not depend on what was advanced before it: a resumed run has no step before.
TEST(LocalAdvection, RemembersNothingOfEarlierSteps) {
  const auto forest = jumpy<2>();
  Advection<2> used(forest, {}, {}), fresh(forest, {}, {});
  for (const double at : {0.8, 1.0, 1.2, 1.4, 2.6, 3.4, 3.7, 4.0}) {
    FlowState<2> other = jet<2>(forest, 5.0 - at);
    const double dt = 2.9 * 0.45 / fresh.courant_number(other.w, 1.0);
    used.advance(other, dt / 3, 0);
    used.advance(other, dt / 3, 1);
    FlowState<2> a = jet<2>(forest, at), b = a;
    Advection<2> unused(forest, {}, {});
    const auto plan = plan_for<2>(forest, unused, a, dt);
    ASSERT_GT(plan.inner, 1) << at;
    used.advance(a, dt, 0, plan);
    unused.advance(b, dt, 0, plan);
    EXPECT_EQ(a.vof.data(), b.vof.data()) << at;
    for (int axis = 0; axis < 2; ++axis) EXPECT_EQ(a.u.data(axis), b.u.data(axis)) << at;
  }
}

/// Leaves of up to `level` here and there, so that fast leaves meet level jumps in every way.
template <int Dim>
Forest<Dim> scattered(int level, double share) {
  mesh::TankGrid<Dim> grid;
  grid.lower.setZero();
  grid.upper.setConstant(roots<Dim>);
  grid.root_blocks.fill(roots<Dim>);
  grid.periodic.fill(Dim == 2);
  const mesh::RefineRule<Dim> rule = [=](const Vec<Dim>& lower, const Vec<Dim>&, int at) {
    return at < level && noise<Dim>(lower + Vec<Dim>::Constant(0.11 * at)) < 2 * share - 1;
  };
  return Forest<Dim>(grid, level, rule, 1);
}

/// A swirl in water, air and a broken surface, no leaf of which is fast.
template <int Dim>
FlowState<Dim> broken_surface(const Forest<Dim>& forest) {
  constexpr double length = roots<Dim>, k = 2 * pi / length;
  FlowState<Dim> state(forest);
  fill_water<Dim>(forest, [](const Vec<Dim>& x) { return 0.5 * length + 0.6 * std::sin(k * x[0]); }, state);
  each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) {
    const Vec<Dim> x = forest.block(b).cell_centre(i);
    if (std::abs(x[Dim - 1] - 0.5 * length) > 1.1) return;
    double& vof = cell_of(state.vof, b, i);
    vof = std::clamp(vof + 0.3 * noise<Dim>(x), 0.0, 1.0);
  });
  field::restrict_cells<double, Dim>(forest, state.vof);
  const auto psi = [](double x, double z) {
    return (std::sin(k * x) * std::cos(k * z) + 0.5 * std::sin(3 * k * x + 1) * std::cos(2 * k * z + 0.7)) / k;
  };
  fill_stream<Dim>(forest, psi, state.w);
  const auto u = [](const Vec<Dim>& x, int axis) {
    return std::sin(k * x[0] + axis) * std::cos(2 * k * x[Dim - 1]) + 0.1 * noise<Dim>(x + Vec<Dim>::Constant(0.37 * axis));
  };
  fill_faces<Dim>(forest, u, state.u);
  return state;
}

/// f(plan, step) with every `stride`-th leaf taken for a fast one, alone and together with a second.
template <int Dim, class F>
void with_each_fast(const Forest<Dim>& forest, int stride, F&& f) {
  const auto n = static_cast<std::size_t>(forest.n_leaves());
  int tried = 0;
  for (std::size_t i = 0; i < n; i += static_cast<std::size_t>(stride)) {
    std::vector<double> courant(n, 0.3);
    courant[i] = 0.9;
    if (i % 2 == 1) courant[(i + 3) % n] = 0.9;
    const auto plan = plan_sub_steps<Dim>(forest, courant, 0.45, true);
    if (plan.inner == 1) continue;  // the region would be most of the mesh
    SCOPED_TRACE(i);
    ++tried;
    f(plan, tried % Dim);
  }
  EXPECT_GT(tried, 5);
}

template <int Dim>
void unknown_fluxes_do_not_count(const Forest<Dim>& forest, int stride) {
  const FlowState<Dim> start = broken_surface<Dim>(forest);
  Advection<Dim> advection(forest, {}, {});
  const double dt = 0.42 / advection.courant_number(start.w, 1.0);
  with_each_fast<Dim>(forest, stride, [&](SubStepPlan<Dim> plan, int step) {
    FlowState<Dim> a = start;
    advection.advance(a, dt, step, plan);
    for (const double flux : {0.003, std::nan("")}) {
      FlowState<Dim> b = start;
      plan.unknown_flux = flux;
      advection.advance(b, dt, step, plan);
      EXPECT_TRUE(a.vof.data() == b.vof.data()) << flux;
      for (int axis = 0; axis < Dim; ++axis) EXPECT_TRUE(a.u.data(axis) == b.u.data(axis)) << flux;
    }
  });
}
TEST(LocalAdvection, KeepsNothingOfUnknownFluxesBesideLevelJumps) { unknown_fluxes_do_not_count<2>(jumpy<2>(), 3); }
TEST(LocalAdvection, KeepsNothingOfUnknownFluxesOnThreeLevels) { unknown_fluxes_do_not_count<2>(scattered<2>(2, 0.35), 7); }
TEST(LocalAdvection, KeepsNothingOfUnknownFluxesIn3D) { unknown_fluxes_do_not_count<3>(scattered<3>(1, 0.3), 53); }

/// Outside the region and on its sides the flow is what a sub-step of the whole mesh makes of it.
template <int Dim>
void rest_is_that_of_the_whole(const Forest<Dim>& forest, int stride) {
  const FlowState<Dim> start = broken_surface<Dim>(forest);
  Advection<Dim> advection(forest, {}, {});
  const double dt = 0.42 / advection.courant_number(start.w, 1.0);
  std::vector<FlowState<Dim>> whole(Dim, start);
  for (int step = 0; step < Dim; ++step) advection.advance(whole[static_cast<std::size_t>(step)], dt, step);
  with_each_fast<Dim>(forest, stride, [&](const SubStepPlan<Dim>& plan, int step) {
    const FlowState<Dim>& expected = whole[static_cast<std::size_t>(step)];
    FlowState<Dim> state = start;
    advection.advance(state, dt, step, plan);
    std::vector<char> inside(static_cast<std::size_t>(forest.n_blocks()), 0);
    for (const int b : plan.region.leaves) inside[static_cast<std::size_t>(b)] = 1;
    int vof = 0, u = 0;  // that differ
    each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) {
      if (!inside[static_cast<std::size_t>(b)]) vof += cell_of(state.vof, b, i) != cell_of(expected.vof, b, i);
    });
    for (int a = 0; a < Dim; ++a)
      each_face<Dim>(forest, a, [&](int b, const IVec<Dim>& i) {
        const bool side = (i[a] == 0 && plan.region.is_cut(b, a, 0)) || (i[a] == BlockShape<Dim>::n && plan.region.is_cut(b, a, 1));
        if (side || !inside[static_cast<std::size_t>(b)]) u += face_of(state.u, a, b, i) != face_of(expected.u, a, b, i);
      });
    EXPECT_EQ(vof, 0);
    EXPECT_EQ(u, 0);
  });
}
TEST(LocalAdvection, LeavesTheRestAsTheWholeMeshHasItBesideLevelJumps) { rest_is_that_of_the_whole<2>(jumpy<2>(), 2); }
TEST(LocalAdvection, LeavesTheRestAsTheWholeMeshHasItOnThreeLevels) { rest_is_that_of_the_whole<2>(scattered<2>(2, 0.35), 3); }
TEST(LocalAdvection, LeavesTheRestAsTheWholeMeshHasItIn3D) { rest_is_that_of_the_whole<3>(scattered<3>(1, 0.3), 37); }

TEST(LocalAdvection, GivesTheSameBitsOnAnyNumberOfThreads) {
  const auto one = jumpy<2>(1), three = jumpy<2>(3);
  FlowState<2> a = jet<2>(one), b = jet<2>(three);
  Advection<2> first(one, {}, {}), second(three, {}, {});
  const double dt = 2.9 * 0.45 / first.courant_number(a.w, 1.0);
  const auto plan = plan_for<2>(one, first, a, dt), other = plan_for<2>(three, second, b, dt);
  ASSERT_GT(plan.inner, 1);
  for (int s = 0; s < 3; ++s) {
    first.advance(a, dt, s, plan);
    second.advance(b, dt, s, other);
  }
  EXPECT_EQ(a.vof.data(), b.vof.data());
  for (int axis = 0; axis < 2; ++axis) EXPECT_EQ(a.u.data(axis), b.u.data(axis));
}

}  // namespace
}  // namespace seaway::flow
