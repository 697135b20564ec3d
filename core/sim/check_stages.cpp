// Stages: mesh rules, end rules, mapping, and whether their cells resolve walls and waves.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/sim/build_hull.hpp"
#include "core/sim/findings.hpp"

namespace seaway::sim {

namespace {

constexpr int cells_per_wave_height = 6;

std::string stage_field(std::size_t i) { return fmt::format("cascade.stages[{}]", i); }

void check_cell(CheckState& s, const std::string& field, double cell) {
  if (!s.base_cell_ok) return;
  if (cell > cell_tolerance * s.c.base_cell)
    s.findings.warning(field,
                       fmt::format("{} m is coarser than the base cell, {} m; it has no effect",
                                   cell, s.c.base_cell),
                       "cells are the base cell or finer");
  if (cell < s.c.base_cell / 16384)
    s.findings.error(
        field,
        fmt::format("{} m is more than 14 halvings below the base cell, {} m", cell, s.c.base_cell),
        "use larger cells or a smaller mesh.base_cell_m");
}

/// The solver's window around the hull is made of the finest leaves of a mesh.
void check_not_below_hull(CheckState& s, const Stage& stage, const std::string& field, double cell) {
  if (!s.has_hull() || !s.base_cell_ok || !(cell > 0) || !(stage.mesh.hull_cell > 0)) return;
  const double at_hull = hull_cell(s.c, stage), here = actual_cell(s.c.base_cell, cell);
  if (here < 0.75 * at_hull)
    s.findings.error(field,
                     fmt::format("makes cells of {:.4g} m, finer than those at the hull, {:.4g} m; these must be the finest of the mesh",
                                 here, at_hull),
                     fmt::format("set hull_cell_m to {:.4g}, or give coarser cells here", cell));
}

void check_mesh(CheckState& s, std::size_t i) {
  Findings& f = s.findings;
  const MeshRule& mesh = s.c.stages[i].mesh;
  const std::string field = stage_field(i) + ".mesh";
  if (f.not_negative(field + ".hull_cell_m", mesh.hull_cell) && mesh.hull_cell > 0) {
    check_cell(s, field + ".hull_cell_m", mesh.hull_cell);
    if (!s.has_hull())
      f.error(field + ".hull_cell_m", fmt::format("{} m, but there is no hull", mesh.hull_cell),
              "add a hull or remove the rule");
  }
  f.not_negative(field + ".hull_margin_m", mesh.hull_margin);
  f.in_range(field + ".hull_sweep_deg", mesh.hull_sweep / degree, 0, 180);
  f.not_negative(field + ".hull_heave_m", mesh.hull_heave);
  for (std::size_t k = 0; k < mesh.surface.size(); ++k) {
    const SurfaceBand& band = mesh.surface[k];
    const std::string at = fmt::format("{}.surface[{}]", field, k);
    if (f.positive(at + ".cell_m", band.cell)) check_cell(s, at + ".cell_m", band.cell);
    check_not_below_hull(s, s.c.stages[i], at + ".cell_m", band.cell);
    if (!(band.within > 0))
      f.error(at + ".within_m", fmt::format("{} m; it must be above 0", band.within),
              "leave it out: everywhere");
    if (f.positive(at + ".half_height_m", band.half_height) && s.wave_ok &&
        band.half_height < 0.5 * s.wave_height)
      f.warning(at + ".half_height_m",
                fmt::format("{} m is less than half the wave height, {} m: crests leave "
                            "the band",
                            band.half_height, 0.5 * s.wave_height),
                "give at least one wave height");
  }
  for (std::size_t k = 0; k < mesh.boxes.size(); ++k) {
    const RefinementBox& box = mesh.boxes[k];
    const std::string at = fmt::format("{}.boxes[{}]", field, k);
    if (f.positive(at + ".cell_m", box.cell)) check_cell(s, at + ".cell_m", box.cell);
    check_not_below_hull(s, s.c.stages[i], at + ".cell_m", box.cell);
    if (s.c.dim == 3) f.extent(at + ".x_m", box.lower.x(), box.upper.x());
    f.extent(at + ".y_m", box.lower.y(), box.upper.y());
    f.extent(at + ".z_m", box.lower.z(), box.upper.z());
  }
}

void check_end(CheckState& s, std::size_t i) {
  Findings& f = s.findings;
  const EndRule& end = s.c.stages[i].end;
  const std::string field = stage_field(i) + ".end";
  if (end.kind == EndRule::Kind::time) {
    f.positive(field + ".time.duration_s", end.duration);
    return;
  }
  f.above_to(field + ".converged.tolerance", end.tolerance, 0, 1);
  f.in_range(field + ".converged.min_periods", end.min_periods, 0, 1000);
  if (f.in_range(field + ".converged.max_periods", end.max_periods, end.min_periods, 10000))
    f.positive(field + ".converged.max_periods", end.max_periods);
  if (s.c.body.free.empty())
    f.error(field + ".converged",
            "the stage waits for a motion to converge, but no motion is free: it would "
            "never end",
            "use end.time, or free a motion in body.free");
}

void check_mapping(CheckState& s, std::size_t i) {
  Findings& f = s.findings;
  const Mapping& m = s.c.stages[i].mapping;
  const std::string field = stage_field(i) + ".mapping";
  f.whole_in_range(field + ".k", m.k, 1, 100000);
  f.whole_in_range(field + ".subsets", m.subsets, 0, std::max(m.k, 0));
  f.above_to(field + ".shape", m.shape, 0, 1000);
  f.whole_in_range(field + ".tail_degree", m.tail_degree, -1, 3);
}

/// Smallest number of cells across a compartment: with fewer two of its walls share a cell.
constexpr int cells_per_compartment = 4;

void check_walls(CheckState& s) {
  double coarsest = 0;
  std::size_t stage = 0;
  for (std::size_t i = 0; i < s.c.stages.size(); ++i)
    if (const double cell = hull_cell(s.c, s.c.stages[i]); cell > coarsest) {
      coarsest = cell;
      stage = i;
    }
  for (std::size_t i = 0; i < s.c.hull.compartments.size(); ++i) {
    const Compartment& c = s.c.hull.compartments[i];
    const std::string field = fmt::format("hull.compartments[{}]", i);
    for (int axis = 3 - s.c.dim; axis < 3; ++axis) {
      const double width = c.upper[axis] - c.lower[axis];
      const double cell = axis == 0 ? s.c.stretch_x * coarsest : coarsest;
      if (width >= cells_per_compartment * cell * (1 - 1e-6)) continue;
      s.findings.error(fmt::format("{}.{}_m", field, "xyz"[axis]),
                       fmt::format("the compartment is {:.4g} m wide, less than {} cells of {:.4g} m at the hull in "
                                   "stage {} ('{}'); two walls would share a cell",
                                   width, cells_per_compartment, cell, stage, s.c.stages[stage].name),
                       fmt::format("set hull_cell_m to {:.4g} or less in every stage, or widen the compartment",
                                   width / cells_per_compartment * coarsest / cell));
    }
  }
  if (s.c.hull.compartments.empty() || !has_thin_walls(s.c)) return;
  for (std::size_t i = 0; i < s.c.hull.compartments.size(); ++i)
    if (!s.c.hull.compartments[i].flooded)
      s.findings.warning(fmt::format("hull.compartments[{}]", i),
                         fmt::format("starts dry, behind walls thinner than {} cells; with water on one side alone the force on such a "
                                     "wall can be far off",
                                     cells_per_wall),
                         "give thicker walls or finer cells; leave out a compartment that stays dry, the hull is solid there");
  s.findings.warning(
      "hull.compartments",
      fmt::format("some wall is thinner than {} cells of {:.4g} m at the hull in stage {} ('{}'); walls are held by "
                  "connected spaces instead of cells, in all stages",
                  cells_per_wall, coarsest, stage, s.c.stages[stage].name),
      "nothing to do; with thicker walls or finer cells the pressure at the walls is smoother");
}

/// Cell at the calm level where the hull (or the origin) is.
double surface_cell(const Case& c, const Stage& stage) {
  double cell = c.base_cell;
  if (c.hull.shape != Hull::Shape::none) cell = std::min(cell, hull_cell(c, stage));
  for (const SurfaceBand& band : stage.mesh.surface)
    if (band.cell > 0) cell = std::min(cell, actual_cell(c.base_cell, band.cell));
  for (const RefinementBox& box : stage.mesh.boxes) {
    const Vec3 at(c.body.offset.x(), c.body.offset.y(), 0);
    bool holds = true;
    for (int a = 3 - c.dim; a < 3; ++a)
      holds = holds && box.lower[a] <= at[a] && box.upper[a] >= at[a];
    if (holds && box.cell > 0) cell = std::min(cell, actual_cell(c.base_cell, box.cell));
  }
  return cell;
}

void check_wave_resolution(CheckState& s) {
  for (std::size_t i = 0; i < s.c.stages.size(); ++i) {
    const double cell = surface_cell(s.c, s.c.stages[i]);
    const double cells = s.wave_height / cell;
    if (cells >= cells_per_wave_height * (1 - 1e-6)) continue;
    const std::string field = stage_field(i) + ".mesh.surface";
    const std::string message =
        fmt::format("{:.3g} cells of {:.4g} m per wave height of {} m; {} are needed", cells, cell,
                    s.wave_height, cells_per_wave_height);
    const std::string hint = fmt::format("give {} of {:.3g} or less", s.has_hull() && s.c.stages[i].mesh.hull_cell > 0 ? "hull_cell_m" : "a surface band with cell_m",
                                         s.wave_height / cells_per_wave_height);
    if (i + 1 == s.c.stages.size())
      s.findings.error(field, message, hint);
    else
      s.findings.warning(field, message, hint);
  }
}

void check_time_step_known(CheckState& s) {
  const bool given = std::all_of(s.c.stages.begin(), s.c.stages.end(), [](const Stage& stage) { return stage.dt > 0; });
  if (given || s.c.time.dt > 0 || s.wave_period > 0 || !s.c.body.prescribed.empty() || s.roll_period > 0 ||
      s.heave_period > 0)
    return;
  if (!s.report.ok()) return;  // the period is missing because of another error
  s.findings.error(
      "time.dt_s",
      "no time step, and neither a wave nor a free or prescribed motion to take it from",
      "give dt_s");
}

}  // namespace

void check_stages(CheckState& s) {
  Findings& f = s.findings;
  if (s.c.stages.empty()) {
    f.error("cascade.stages", "0 stages; allowed: 1 to 16", "describe at least one stage");
    return;
  }
  if (s.c.stages.size() > 16)
    f.error("cascade.stages", fmt::format("{} stages; allowed: 1 to 16", s.c.stages.size()),
            "leave some out");
  const int before = f.n_errors();
  std::set<std::string> names;
  for (std::size_t i = 0; i < s.c.stages.size(); ++i) {
    const Stage& stage = s.c.stages[i];
    if (!stage.name.empty() && !names.insert(stage.name).second)
      f.error(stage_field(i) + ".name", fmt::format("'{}' is used twice", stage.name),
              "give each stage its own name");
    f.not_negative(stage_field(i) + ".time.dt_s", stage.dt);
    if (stage.steps_per_period != 0) f.in_range(stage_field(i) + ".time.steps_per_period", stage.steps_per_period, 10, 1e5);
    check_mesh(s, i);
    check_end(s, i);
    check_mapping(s, i);
    if (i > 0 && s.has_hull() && s.base_cell_ok &&
        hull_cell(s.c, stage) > cell_tolerance * hull_cell(s.c, s.c.stages[i - 1]))
      f.warning(stage_field(i) + ".mesh.hull_cell_m",
                "the cells at the hull are coarser than in the stage before",
                "order the stages from coarse to fine");
  }
  if (s.base_cell_ok && f.n_errors() == before) {
    if (s.has_hull()) check_walls(s);
    if (s.wave_ok) check_wave_resolution(s);
  }
  check_time_step_known(s);
}

}  // namespace seaway::sim
