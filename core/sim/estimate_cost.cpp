// Cells, steps and CPU time of each stage. Cells are counted on the blocks that the mesh will have; in three dimensions
// it leaves out those of the hull's box that the hull stays away from, up to a third of them, which are counted here.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/field/field.hpp"
#include "core/sim/build_hull.hpp"
#include "core/sim/findings.hpp"
#include "core/sim/mesh_regions.hpp"
#include "core/sim/time_step.hpp"

namespace seaway::sim {

namespace {

// Typical of one core with a moving hull in waves: what a step does per cell and what it does per block's ghosts.
constexpr double cell_steps_per_cpu_second_2d = 2.4e6, cell_steps_per_cpu_second_3d = 0.75e6;
constexpr double usual_periods = 8;                  // a stage that ends by convergence
constexpr double held_periods = 5;  // before the release, if that waits for convergence
constexpr std::int64_t too_many_blocks = 2'000'000;  // 5e8 cells of a section, 1e9 of a ship

/// Blocks that are split, by level: their places among the blocks of that level.
template <int Dim>
using SplitBlocks = std::vector<std::set<IVec<Dim>>>;

/// Notes all splits that the rule asks for in the block at place `at` of `level`. False if one level has more than `most`.
template <int Dim>
bool find_splits(const mesh::TankGrid<Dim>& grid, const mesh::RefineRule<Dim>& refine, const IVec<Dim>& at, int level,
                 std::size_t most, SplitBlocks<Dim>& splits) {
  Vec<Dim> lower, upper;
  for (int a = 0; a < Dim; ++a) {
    const double edge = (grid.upper[a] - grid.lower[a]) / (grid.root_blocks[a] * std::ldexp(1.0, level));
    lower[a] = grid.lower[a] + at[a] * edge;
    upper[a] = lower[a] + edge;
  }
  if (!refine(lower, upper, level)) return true;
  if (static_cast<int>(splits.size()) <= level) splits.resize(static_cast<std::size_t>(level) + 1);
  auto& here = splits[static_cast<std::size_t>(level)];
  here.insert(at);
  if (here.size() > most) return false;
  for (int i = 0; i < (1 << Dim); ++i) {
    IVec<Dim> child{};
    for (int a = 0; a < Dim; ++a) child[a] = 2 * at[a] + ((i >> a) & 1);
    if (!find_splits<Dim>(grid, refine, child, level + 1, most, splits)) return false;
  }
  return true;
}

/// Leaves of the 2:1 balance over faces, edges and corners, as p4est makes it: around a split block all blocks of its level
/// exist, so their parents are split.
template <int Dim>
std::int64_t count_leaves(const mesh::TankGrid<Dim>& grid, SplitBlocks<Dim> splits) {
  std::int64_t leaves = 1;
  for (const int r : grid.root_blocks) leaves *= r;
  for (std::size_t level = splits.size(); level-- > 0;) {
    leaves += static_cast<std::int64_t>(splits[level].size()) * ((1 << Dim) - 1);
    if (level == 0) break;
    for (const IVec<Dim>& at : splits[level])
      field::for_box<Dim>(field::filled<Dim>(-1), field::filled<Dim>(2), [&](const IVec<Dim>& step) {
        IVec<Dim> parent{};
        for (int a = 0; a < Dim; ++a) {
          const int n = grid.root_blocks[a] << level;
          int beside = at[a] + step[a];
          if (grid.periodic[a]) beside = (beside + n) % n;
          if (beside < 0 || beside >= n) return;
          parent[a] = beside / 2;
        }
        splits[level - 1].insert(parent);
      });
  }
  return leaves;
}

/// Cells of a stage's mesh, or what many blocks hold if there are more.
template <int Dim>
std::int64_t count_cells(const CheckState& s, const Stage& stage) {
  constexpr int cells = mesh::BlockShape<Dim>::cells;
  std::optional<HullPlace<Dim>> place;
  if (s.place) {
    place = HullPlace<Dim>{{from_vec3<Dim>(s.place->bounds.lower), from_vec3<Dim>(s.place->bounds.upper)},
                           from_vec3<Dim>(s.place->cog), from_vec3<Dim>(s.place->start), s.place->draft};
  }
  Vec<Dim> edge = Vec<Dim>::Constant(mesh::BlockShape<Dim>::n * s.c.base_cell);
  if (Dim == 3) edge[0] *= s.c.stretch_x;
  const Vec<Dim> size = from_vec3<Dim>(s.c.tank.upper) - from_vec3<Dim>(s.c.tank.lower);
  if ((size.array() / edge.array()).max(1.0).prod() >= static_cast<double>(too_many_blocks)) return too_many_blocks * cells;
  const mesh::TankGrid<Dim> grid = tank_grid<Dim>(s.c);
  const mesh::RefineRule<Dim> refine = mesh::refine_boxes<Dim>(grid, refined_regions<Dim>(stage.mesh, place));
  SplitBlocks<Dim> splits;
  bool counted = true;
  field::for_box<Dim>(field::filled<Dim>(0), grid.root_blocks, [&](const IVec<Dim>& root) {
    counted = counted && find_splits<Dim>(grid, refine, root, 0, too_many_blocks >> Dim, splits);
  });
  return (counted ? count_leaves<Dim>(grid, std::move(splits)) : too_many_blocks) * cells;
}

double shortest_period(const CheckState& s) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const double period : {s.wave_period, s.roll_period, s.heave_period})
    if (period > 0) shortest = std::min(shortest, period);
  for (const Body::Prescribed& p : s.c.body.prescribed) shortest = std::min(shortest, p.period);
  return shortest;
}

double stage_duration(const CheckState& s, std::size_t i) {
  const EndRule& end = s.c.stages[i].end;
  if (end.kind == EndRule::Kind::time) return end.duration;
  const double cycle = std::max({s.wave_period, s.roll_period, s.heave_period});
  double held = 0;
  if (i == 0 && s.c.body.release == Body::Release::at_time) held = s.c.body.release_time;
  if (i == 0 && s.c.body.release == Body::Release::converged)
    held = cycle * std::clamp(held_periods, static_cast<double>(s.c.body.release_min_periods),
                              static_cast<double>(s.c.body.release_max_periods));
  return held + cycle * std::clamp(usual_periods, end.min_periods, end.max_periods);
}

}  // namespace

void estimate_cost(CheckState& s) {
  for (std::size_t i = 0; i < s.c.stages.size(); ++i) {
    StageEstimate e;
    const Stage& stage = s.c.stages[i];
    const double dt = time_step(s.c.time, stage, shortest_period(s), s.wave_period);
    e.name = s.c.stages[i].name;
    e.cells = s.c.dim == 2 ? count_cells<2>(s, s.c.stages[i]) : count_cells<3>(s, s.c.stages[i]);
    e.dt = dt;
    const double steps = std::ceil(stage_duration(s, i) / dt - 1e-9);
    e.steps = static_cast<std::int64_t>(std::min(steps, 1e15));
    e.cpu_s = static_cast<double>(e.cells) * steps / (s.c.dim == 2 ? cell_steps_per_cpu_second_2d : cell_steps_per_cpu_second_3d);
    if (e.cells >= too_many_blocks * (s.c.dim == 2 ? mesh::BlockShape<2>::cells : mesh::BlockShape<3>::cells))
      s.findings.error(fmt::format("cascade.stages[{}].mesh", i),
                       fmt::format("more than {:.1g} cells", static_cast<double>(e.cells)),
                       "use larger cells or smaller regions");
    s.report.stages.push_back(e);
  }
}

}  // namespace seaway::sim
