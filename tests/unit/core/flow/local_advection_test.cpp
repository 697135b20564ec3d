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
  EXPECT_LT(plan.region.leaves.size(), forest.leaves().size());
  std::vector<char> inside(static_cast<std::size_t>(forest.n_blocks()), 0);
  for (const int b : plan.region.leaves) inside[static_cast<std::size_t>(b)] = 1;
  int cuts = 0;
  for (std::size_t i = 0; i < courant.size(); ++i) {
    const int b = forest.leaves()[i];
    EXPECT_LE(courant[i].largest / (inside[static_cast<std::size_t>(b)] ? plan.total() : plan.whole), 0.45 * (1 + 1e-12));
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side) {
        if (!plan.region.is_cut(b, axis, side)) continue;
        ++cuts;
        EXPECT_LE(courant[i].at_side(axis, side) / plan.whole, 0.45 * (1 + 1e-12)) << "slow near the region's sides";
      }
  }
  EXPECT_GT(cuts, 0);
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

/// Largest Courant numbers of cells, and of those near a side, as sums over the cells' faces have them.
TEST(LeafCourant, IsThatOfTheCellsAndOfThoseNearEachSide) {
  const auto forest = unit_tank<3>(2, 0, 0, 0, true);
  FlowState<3> state(forest);
  fill_faces<3>(forest, [](const Vec3& x, int axis) { return noise<3>(x + Vec3::Constant(0.3 * axis)); }, state.w);
  const Advection<3> advection(forest, {}, {});
  const auto courant = advection.courant_numbers(state.w, 0.1);
  std::vector<LeafCourant<3>> expected(courant.size());
  constexpr int n = BlockShape<3>::n;
  each_cell<3>(forest, [&](int b, const IVec<3>& i) {
    double sum = 0;
    for (int a = 0; a < 3; ++a) {
      IVec<3> next = i;
      ++next[a];
      sum += 0.1 / forest.block(b).h[a] * std::max(std::abs(face_of(state.w, a, b, i)), std::abs(face_of(state.w, a, b, next)));
    }
    const auto at = std::find(forest.leaves().begin(), forest.leaves().end(), b) - forest.leaves().begin();
    LeafCourant<3>& leaf = expected[static_cast<std::size_t>(at)];
    leaf.largest = std::max(leaf.largest, sum);
    for (int a = 0; a < 3; ++a) {
      if (i[a] < courant_margin) leaf.at_side(a, 0) = std::max(leaf.at_side(a, 0), sum);
      if (i[a] >= n - courant_margin) leaf.at_side(a, 1) = std::max(leaf.at_side(a, 1), sum);
    }
  });
  for (std::size_t k = 0; k < courant.size(); ++k) {
    EXPECT_NEAR(courant[k].largest, expected[k].largest, 1e-14);
    for (std::size_t s = 0; s < 6; ++s) EXPECT_NEAR(courant[k].near_side[s], expected[k].near_side[s], 1e-14);
  }
}

/// f(plan, step) with every `stride`-th leaf taken for a fast one, but not near its sides; alone and together with a second.
template <int Dim, class F>
void with_each_fast(const Forest<Dim>& forest, int stride, F&& f) {
  const auto n = static_cast<std::size_t>(forest.n_leaves());
  int tried = 0;
  for (std::size_t i = 0; i < n; i += static_cast<std::size_t>(stride)) {
    std::vector<LeafCourant<Dim>> courant(n);
    courant[i].largest = 0.9;
    if (i % 2 == 1) courant[(i + 3) % n].largest = 0.9;
    const auto plan = plan_sub_steps<Dim>(forest, courant, 0.45, true);
    ASSERT_EQ(plan.inner, 2);
    SCOPED_TRACE(i);
    f(plan, ++tried % Dim);
  }
  EXPECT_GT(tried, 5);
}

/// How far two states are from each other: volume of water in other places [m^Dim], largest difference of velocities.
template <int Dim>
std::pair<double, double> distance(const Forest<Dim>& forest, const FlowState<Dim>& a, const FlowState<Dim>& b) {
  double vof = 0, u = 0;
  each_cell<Dim>(forest, [&](int at, const IVec<Dim>& i) {
    vof += std::abs(cell_of(a.vof, at, i) - cell_of(b.vof, at, i)) * forest.block(at).cell_volume();
  });
  for (int axis = 0; axis < Dim; ++axis)
    each_face<Dim>(forest, axis, [&](int at, const IVec<Dim>& i) {
      u = std::max(u, std::abs(face_of(a.u, axis, at, i) - face_of(b.u, axis, at, i)));
    });
  return {vof, u};
}

/// A region may be cut anywhere, through level jumps too: cells gain what passed their faces, and the flow is no further from
/// that of a long sub-step of the whole mesh than that is from the flow of two short ones.
template <int Dim>
void regions_may_be_cut_anywhere(const Forest<Dim>& forest, int stride) {
  const FlowState<Dim> start = broken_surface<Dim>(forest);
  Advection<Dim> advection(forest, {}, {});
  const double dt = 0.42 / advection.courant_number(start.w, 1.0);
  std::vector<FlowState<Dim>> whole(Dim, start);
  double bound_vof = 0, bound_u = 0;
  for (int step = 0; step < Dim; ++step) {
    FlowState<Dim> halves = start;
    for (int k = 0; k < 2; ++k) advection.advance(halves, 0.5 * dt, step);
    advection.advance(whole[static_cast<std::size_t>(step)], dt, step);
    const auto [vof, u] = distance<Dim>(forest, whole[static_cast<std::size_t>(step)], halves);
    bound_vof = std::max(bound_vof, vof);
    bound_u = std::max(bound_u, u);
  }
  double largest_vof = 0, largest_u = 0, balance = 0;
  FaceField<double, Dim> passed(forest);
  advection.set_flux_visitor([&](int axis, const FaceField<double, Dim>& swept) { passed.data(axis) = swept.data(axis); });
  with_each_fast<Dim>(forest, stride, [&](const SubStepPlan<Dim>& plan, int step) {
    FlowState<Dim> state = start;
    CellField<double, Dim> clipped(forest);
    for (const auto& clip : advection.advance(state, dt, step, plan)) clipped.data()[static_cast<std::size_t>(clip.cell)] += clip.volume;
    each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) {
      const auto& block = forest.block(b);
      double gain = -cell_of(clipped, b, i) / block.cell_volume();
      for (int axis = 0; axis < Dim; ++axis) {
        IVec<Dim> next = i;
        ++next[axis];
        gain += (face_of(passed, axis, b, i) - face_of(passed, axis, b, next)) / block.h[axis];
      }
      balance = std::max(balance, std::abs(cell_of(state.vof, b, i) - cell_of(start.vof, b, i) - gain));
    });
    const auto [vof, u] = distance<Dim>(forest, state, whole[static_cast<std::size_t>(step)]);
    largest_vof = std::max(largest_vof, vof);
    largest_u = std::max(largest_u, u);
  });
  std::cout << "vof " << largest_vof << " of " << bound_vof << ", u " << largest_u << " of " << bound_u << ", balance " << balance << '\n';
  EXPECT_LT(balance, 1e-12);
  EXPECT_LT(largest_vof, bound_vof);
  EXPECT_LT(largest_u, 1.25 * bound_u);
}
TEST(LocalAdvection, RegionsMayBeCutBesideLevelJumps) { regions_may_be_cut_anywhere<2>(jumpy<2>(), 2); }
TEST(LocalAdvection, RegionsMayBeCutOnThreeLevels) { regions_may_be_cut_anywhere<2>(scattered<2>(2, 0.35), 3); }
TEST(LocalAdvection, RegionsMayBeCutIn3D) { regions_may_be_cut_anywhere<3>(scattered<3>(1, 0.3), 37); }

/// Spray about the surface: shares of the water that the long sub-step let pass may be more than a cell has when its time
/// comes. Velocities must not be made of the mass that is missing.
template <int Dim>
void velocities_stay_in_their_range(int steps) {
  const auto forest = jumpy<Dim>();
  double largest = 0;
  for (const double at : {1.1, 1.6, 2.1, 2.6, 3.3, 3.9}) {
    FlowState<Dim> state = jet<Dim>(forest, at);
    each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) {
      const Vec<Dim> x = forest.block(b).cell_centre(i);
      double& vof = cell_of(state.vof, b, i);
      if (std::abs(x[Dim - 1] - 0.5 * roots<Dim>) < 1.2 && noise<Dim>(x) > 0.2) vof = 0.5 + 0.5 * noise<Dim>(2 * x);
    });
    field::restrict_cells<double, Dim>(forest, state.vof);
    fill_faces<Dim>(forest, [](const Vec<Dim>& x, int axis) { return noise<Dim>(3 * x + Vec<Dim>::Constant(0.3 * axis)); }, state.u);
    Advection<Dim> advection(forest, {}, {});
    const double dt = 5.9 * 0.45 / advection.courant_number(state.w, 1.0);
    const auto plan = plan_for<Dim>(forest, advection, state, dt);
    ASSERT_GT(plan.inner, 1);
    for (int s = 0; s < steps; ++s)
      for (int k = 0; k < plan.whole; ++k) advection.advance(state, dt / plan.whole, s + k, plan);
    for (int axis = 0; axis < Dim; ++axis)
      for (const double u : state.u.data(axis)) largest = std::max(largest, std::abs(u));
  }
  std::cout << "largest velocity " << largest << '\n';
  EXPECT_LT(largest, 1.01);  // as with all sub-steps everywhere
}
TEST(LocalAdvection, KeepsVelocitiesInTheirRangeInSprayIn2D) { velocities_stay_in_their_range<2>(6); }
TEST(LocalAdvection, KeepsVelocitiesInTheirRangeInSprayIn3D) { velocities_stay_in_their_range<3>(2); }

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
