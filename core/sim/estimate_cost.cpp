// Cells, steps and CPU time of each stage, counted on blocks as the mesh will be, without its 2:1
// balance: expect up to a fifth more cells.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/sim/build_hull.hpp"
#include "core/sim/findings.hpp"

namespace seaway::sim {

namespace {

constexpr int block_cells = 16;                      // mesh::BlockShape<2>::n
constexpr double cell_steps_per_cpu_second = 0.8e6;  // typical of one core, moving hull and waves
constexpr double usual_periods = 8;                  // a stage that ends by convergence
constexpr double held_periods = 5;  // before the release, if that waits for convergence
constexpr std::int64_t too_many_blocks = 4'000'000;  // 1e9 cells

struct Region {
  Vec2 lower, upper;
  double cell;
};

std::vector<Region> regions_of(const CheckState& s, const Stage& stage) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::vector<Region> regions;
  const Body& body = s.c.body;
  const MeshRule& mesh = stage.mesh;
  double left = body.offset.y(), right = left;
  if (s.section) {
    const double draft = start_draft(s.c, *s.section);
    const Vec2 cog = from_vec3<2>(body.cog), at = cog - Vec2(0, draft) + from_vec3<2>(body.offset);
    Region swept{at, at, mesh.hull_cell};
    for (const double turn :
         {-mesh.hull_sweep, -0.5 * mesh.hull_sweep, 0.0, 0.5 * mesh.hull_sweep, mesh.hull_sweep})
      for (const Vec2& x : s.section->outer) {
        const Vec2 r = x - cog;
        const Vec2 p = at + Vec2(std::cos(turn) * r.x() - std::sin(turn) * r.y(),
                                 std::sin(turn) * r.x() + std::cos(turn) * r.y());
        swept.lower = swept.lower.cwiseMin(p);
        swept.upper = swept.upper.cwiseMax(p);
      }
    const hull::Box<2> box = hull::bounds_of(s.section->outer);
    left += box.lower.x();
    right += box.upper.x();
    if (mesh.hull_cell > 0) {
      const double margin = mesh.hull_margin > 0 ? mesh.hull_margin : 8 * mesh.hull_cell;
      const double heave = mesh.hull_heave > 0 ? mesh.hull_heave : 0.25 * draft;
      swept.lower -= Vec2(margin, margin + heave);
      swept.upper += Vec2(margin, margin + heave);
      regions.push_back(swept);
    }
  }
  for (const SurfaceBand& band : mesh.surface) {
    const bool everywhere = !(band.within < inf);
    regions.push_back({{everywhere ? -inf : left - band.within, -band.half_height},
                       {everywhere ? inf : right + band.within, band.half_height},
                       band.cell});
  }
  for (const RefinementBox& box : mesh.boxes)
    regions.push_back({from_vec3<2>(box.lower), from_vec3<2>(box.upper), box.cell});
  return regions;
}

/// Leaf blocks under the block at `lower` with cells of size `cell`.
std::int64_t count_blocks(const std::vector<Region>& regions, const Vec2& lower, double cell,
                          int level, std::int64_t budget) {
  const Vec2 upper = lower.array() + block_cells * cell;
  const bool split =
      level < 20 && std::any_of(regions.begin(), regions.end(), [&](const Region& r) {
        return cell > cell_tolerance * r.cell && (r.lower.array() < upper.array()).all() &&
               (r.upper.array() > lower.array()).all();
      });
  if (!split) return 1;
  std::int64_t sum = 0;
  for (int i = 0; i < 4 && sum < budget; ++i)
    sum += count_blocks(regions, lower + 0.5 * block_cells * cell * Vec2(i % 2, i / 2), 0.5 * cell,
                        level + 1, budget - sum);
  return sum;
}

std::int64_t count_cells(const CheckState& s, const Stage& stage) {
  const std::vector<Region> regions = regions_of(s, stage);
  const double edge = block_cells * s.c.base_cell;
  const Vec2 low = from_vec3<2>(s.c.tank.lower), size = from_vec3<2>(s.c.tank.upper) - low;
  // Tolerance against rounding of tanks that are whole multiples of the blocks.
  const double n_y = std::max(1.0, std::ceil(size.x() / edge - 1e-6));
  const double n_z = std::max(1.0, std::ceil(size.y() / edge - 1e-6));
  if (n_y * n_z >= static_cast<double>(too_many_blocks))
    return too_many_blocks * block_cells * block_cells;
  std::int64_t blocks = 0;
  for (double j = 0; j < n_y; ++j)
    for (double k = 0; k < n_z && blocks < too_many_blocks; ++k)
      blocks += count_blocks(regions, low + edge * Vec2(j, k), s.c.base_cell, 0,
                             too_many_blocks - blocks);
  return blocks * block_cells * block_cells;
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
    e.cells = count_cells(s, s.c.stages[i]);
    e.dt = dt;
    const double steps = std::ceil(stage_duration(s, i) / dt - 1e-9);
    e.steps = static_cast<std::int64_t>(std::min(steps, 1e15));
    e.cpu_s = static_cast<double>(e.cells) * steps / cell_steps_per_cpu_second;
    if (e.cells >= too_many_blocks * block_cells * block_cells)
      s.findings.error(fmt::format("cascade.stages[{}].mesh", i),
                       fmt::format("more than {:.1g} cells", static_cast<double>(e.cells)),
                       "use larger cells or smaller regions");
    s.report.stages.push_back(e);
  }
}

}  // namespace seaway::sim
