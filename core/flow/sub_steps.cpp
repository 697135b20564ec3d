#include "core/flow/sub_steps.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::flow {
namespace {

int steps_for(double courant, double limit) { return std::max(1, static_cast<int>(std::ceil(courant / limit))); }

/// The leaves (by block) beyond the limit in a sub-step of so many, and those behind their sides near which they are: what a
/// sweep sees across the region's own sides is slow.
template <int Dim>
std::vector<char> region_for(const mesh::Forest<Dim>& forest, const std::vector<LeafCourant<Dim>>& courant, double limit,
                             int whole) {
  std::vector<char> region(static_cast<std::size_t>(forest.n_blocks()), 0);
  for (std::size_t i = 0; i < courant.size(); ++i) {
    if (steps_for(courant[i].largest, limit) <= whole) continue;
    const int b = forest.leaves()[i];
    region[static_cast<std::size_t>(b)] = 1;
    for (int axis = 0; axis < Dim; ++axis)
      for (int side = 0; side < 2; ++side)
        if (steps_for(courant[i].at_side(axis, side), limit) > whole) mesh::choose_behind(forest, b, axis, side, region);
  }
  mesh::complete_jumps(forest, region);
  return region;
}

}  // namespace

template <int Dim>
double largest_courant(const std::vector<LeafCourant<Dim>>& courant) {
  double largest = 0;
  for (const LeafCourant<Dim>& c : courant) {
    if (std::isnan(c.largest)) return c.largest;
    largest = std::max(largest, c.largest);
  }
  return largest;
}

template <int Dim>
SubStepPlan<Dim> plan_sub_steps(const mesh::Forest<Dim>& forest, const std::vector<LeafCourant<Dim>>& courant, double limit,
                                bool local) {
  SubStepPlan<Dim> plan;
  const int most = steps_for(largest_courant<Dim>(courant), limit);
  plan.whole = most;
  if (!local || most == 1) return plan;
  double least = static_cast<double>(most) * forest.n_leaves();  // leaves advanced
  std::vector<char> region;
  for (int whole = 1; whole < most; ++whole) {
    const int inner = (most + whole - 1) / whole;
    std::vector<char> chosen = region_for(forest, courant, limit, whole);
    const auto count = std::count(chosen.begin(), chosen.end(), 1);
    const double work = whole * (forest.n_leaves() + static_cast<double>(count) * inner);
    if (work >= least) continue;
    least = work;
    plan.whole = whole;
    plan.inner = inner;
    region = std::move(chosen);
  }
  if (plan.inner == 1) return plan;
  plan.region = mesh::make_part(forest, region);
  return plan;
}

template double largest_courant<2>(const std::vector<LeafCourant<2>>&);
template double largest_courant<3>(const std::vector<LeafCourant<3>>&);
template SubStepPlan<2> plan_sub_steps<2>(const mesh::Forest<2>&, const std::vector<LeafCourant<2>>&, double, bool);
template SubStepPlan<3> plan_sub_steps<3>(const mesh::Forest<3>&, const std::vector<LeafCourant<3>>&, double, bool);

}  // namespace seaway::flow
