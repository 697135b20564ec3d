#include "core/flow/sub_steps.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::flow {
namespace {

int steps_for(double courant, double limit) { return std::max(1, static_cast<int>(std::ceil(courant / limit))); }

/// Leaves (by block) beyond the limit in a sub-step of so many.
template <int Dim>
std::vector<char> too_fast(const mesh::Forest<Dim>& forest, const std::vector<double>& courant, double limit, int whole) {
  std::vector<char> out(static_cast<std::size_t>(forest.n_blocks()), 0);
  for (std::size_t i = 0; i < courant.size(); ++i)
    if (steps_for(courant[i], limit) > whole) out[static_cast<std::size_t>(forest.leaves()[i])] = 1;
  return out;
}

/// Marks the leaves below a block.
template <int Dim>
void choose_below(const mesh::Forest<Dim>& forest, int b, std::vector<char>& chosen) {
  if (forest.block(b).leaf) {
    chosen[static_cast<std::size_t>(b)] = 1;
    return;
  }
  for (const int child : forest.block(b).child) choose_below(forest, child, chosen);
}

/// The fast leaves and a ring of leaves around them that is eight cells wide in the size of its own leaves: a fast leaf beside
/// a coarser one counts with all that its parent holds, or the ring would be but half a coarse leaf wide there.
template <int Dim>
std::vector<char> region_around(const mesh::Forest<Dim>& forest, const std::vector<char>& fast) {
  std::vector<char> inner = fast;
  for (const int b : forest.leaves())
    if (fast[static_cast<std::size_t>(b)] && forest.touches_coarser(b)) choose_below(forest, forest.block(b).parent, inner);
  std::vector<char> region = mesh::with_neighbours(forest, inner);
  mesh::complete_jumps(forest, region);
  return region;
}

}  // namespace

double largest_courant(const std::vector<double>& courant) {
  double largest = 0;
  for (const double c : courant) {
    if (std::isnan(c)) return c;
    largest = std::max(largest, c);
  }
  return largest;
}

template <int Dim>
SubStepPlan<Dim> plan_sub_steps(const mesh::Forest<Dim>& forest, const std::vector<double>& courant, double limit, bool local) {
  SubStepPlan<Dim> plan;
  const int most = steps_for(largest_courant(courant), limit);
  plan.whole = most;
  if (!local || most == 1) return plan;
  double least = static_cast<double>(most) * forest.n_leaves();  // leaves advanced
  std::vector<char> fast, region;
  for (int whole = 1; whole < most; ++whole) {
    const int inner = (most + whole - 1) / whole;
    std::vector<char> chosen = too_fast(forest, courant, limit, whole);
    std::vector<char> around = region_around(forest, chosen);
    const auto count = std::count(around.begin(), around.end(), 1);
    const double work = whole * (forest.n_leaves() + static_cast<double>(count) * inner);
    if (work >= least) continue;
    least = work;
    plan.whole = whole;
    plan.inner = inner;
    fast = std::move(chosen);
    region = std::move(around);
  }
  if (plan.inner == 1) return plan;
  std::vector<char> slow(fast.size(), 0);
  for (const int b : forest.leaves()) {
    if (fast[static_cast<std::size_t>(b)]) plan.fast.push_back(b);
    else slow[static_cast<std::size_t>(b)] = 1;
  }
  plan.rest = mesh::make_part(forest, slow);
  plan.region = mesh::make_part(forest, region);
  return plan;
}

template SubStepPlan<2> plan_sub_steps<2>(const mesh::Forest<2>&, const std::vector<double>&, double, bool);
template SubStepPlan<3> plan_sub_steps<3>(const mesh::Forest<3>&, const std::vector<double>&, double, bool);

}  // namespace seaway::flow
