// Cells, steps and CPU time of each stage, counted on blocks as the mesh will be, without its 2:1
// balance: expect up to a fifth more cells.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/field/field.hpp"
#include "core/sim/build_hull.hpp"
#include "core/sim/findings.hpp"
#include "core/sim/mesh_regions.hpp"

namespace seaway::sim {

namespace {

constexpr double cell_steps_per_cpu_second = 0.8e6;  // typical of one core, moving hull and waves
constexpr double usual_periods = 8;                  // a stage that ends by convergence
constexpr double held_periods = 5;  // before the release, if that waits for convergence
constexpr std::int64_t too_many_blocks = 2'000'000;  // 5e8 cells of a section, 1e9 of a ship

/// Leaf blocks under the block at `lower` with cells of size `cell`.
template <int Dim>
std::int64_t count_blocks(const std::vector<mesh::RefinedBox<Dim>>& regions, const Vec<Dim>& lower, const Vec<Dim>& cell,
                          int level, std::int64_t budget) {
  constexpr int n = mesh::BlockShape<Dim>::n;
  const Vec<Dim> upper = lower + n * cell;
  const bool split =
      level < 20 && std::any_of(regions.begin(), regions.end(), [&](const auto& r) {
        return cell[Dim - 1] > cell_tolerance * r.cell && (r.lower.array() < upper.array()).all() &&
               (r.upper.array() > lower.array()).all();
      });
  if (!split) return 1;
  std::int64_t sum = 0;
  for (int i = 0; i < (1 << Dim) && sum < budget; ++i) {
    Vec<Dim> corner = lower;
    for (int a = 0; a < Dim; ++a) corner[a] += 0.5 * n * cell[a] * ((i >> a) & 1);
    sum += count_blocks<Dim>(regions, corner, 0.5 * cell, level + 1, budget - sum);
  }
  return sum;
}

template <int Dim>
std::int64_t count_cells(const CheckState& s, const Stage& stage) {
  constexpr int cells = mesh::BlockShape<Dim>::cells;
  std::optional<HullPlace<Dim>> place;
  if (s.place) {
    place = HullPlace<Dim>{{from_vec3<Dim>(s.place->bounds.lower), from_vec3<Dim>(s.place->bounds.upper)},
                           from_vec3<Dim>(s.place->cog), from_vec3<Dim>(s.place->start), s.place->draft};
  }
  const auto regions = refined_regions<Dim>(stage.mesh, place);
  Vec<Dim> cell = Vec<Dim>::Constant(s.c.base_cell);
  if (Dim == 3) cell[0] *= s.c.stretch_x;
  const Vec<Dim> edge = mesh::BlockShape<Dim>::n * cell;
  const Vec<Dim> low = from_vec3<Dim>(s.c.tank.lower), size = from_vec3<Dim>(s.c.tank.upper) - low;
  // Tolerance against rounding of tanks that are whole multiples of the blocks.
  const Vec<Dim> n = (size.array() / edge.array() - 1e-6).ceil().max(1.0);
  if (n.prod() >= static_cast<double>(too_many_blocks)) return too_many_blocks * cells;
  IVec<Dim> upper{};
  for (int a = 0; a < Dim; ++a) upper[a] = static_cast<int>(n[a]);
  std::int64_t blocks = 0;
  field::for_box<Dim>(field::filled<Dim>(0), upper, [&](const IVec<Dim>& i) {
    Vec<Dim> corner = low;
    for (int a = 0; a < Dim; ++a) corner[a] += edge[a] * i[a];
    if (blocks < too_many_blocks)
      blocks += count_blocks<Dim>(regions, corner, cell, 0, too_many_blocks - blocks);
  });
  return blocks * cells;
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
  const double dt = s.c.time.dt > 0 ? s.c.time.dt : shortest_period(s) / s.c.time.steps_per_period;
  for (std::size_t i = 0; i < s.c.stages.size(); ++i) {
    StageEstimate e;
    e.name = s.c.stages[i].name;
    e.cells = s.c.dim == 2 ? count_cells<2>(s, s.c.stages[i]) : count_cells<3>(s, s.c.stages[i]);
    e.dt = dt;
    const double steps = std::ceil(stage_duration(s, i) / dt - 1e-9);
    e.steps = static_cast<std::int64_t>(std::min(steps, 1e15));
    e.cpu_s = static_cast<double>(e.cells) * steps / cell_steps_per_cpu_second;
    if (e.cells >= too_many_blocks * (s.c.dim == 2 ? mesh::BlockShape<2>::cells : mesh::BlockShape<3>::cells))
      s.findings.error(fmt::format("cascade.stages[{}].mesh", i),
                       fmt::format("more than {:.1g} cells", static_cast<double>(e.cells)),
                       "use larger cells or smaller regions");
    s.report.stages.push_back(e);
  }
}

}  // namespace seaway::sim
