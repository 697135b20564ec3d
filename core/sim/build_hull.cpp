#include "core/sim/build_hull.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/error.hpp"

namespace seaway::sim {

namespace {

hull::SectionSpec::Shape section_shape(Hull::Shape shape) {
  switch (shape) {
    case Hull::Shape::box:
      return hull::SectionSpec::Shape::box;
    case Hull::Shape::rounded_box:
      return hull::SectionSpec::Shape::rounded_box;
    case Hull::Shape::polygon:
      return hull::SectionSpec::Shape::polygon;
    case Hull::Shape::offsets_section:
      return hull::SectionSpec::Shape::offsets;
    default:
      break;
  }
  fail(ErrorCode::internal, "this hull is no section");
}

}  // namespace

double actual_cell(double base_cell, double wanted) {
  double cell = base_cell;
  for (int level = 0; level < 60 && cell > cell_tolerance * wanted; ++level) cell *= 0.5;
  return cell;
}

double hull_cell(const Case& c, const Stage& stage) {
  if (stage.mesh.hull_cell > 0) return actual_cell(c.base_cell, stage.mesh.hull_cell);
  double wanted = c.base_cell;
  const Vec3 at(c.body.offset.x(), c.body.offset.y(), 0.0);
  for (const RefinementBox& box : stage.mesh.boxes) {
    bool holds = true;
    for (int a = 3 - c.dim; a < 3; ++a) holds = holds && box.lower[a] <= at[a] && box.upper[a] >= at[a];
    if (holds && box.cell > 0) wanted = std::min(wanted, box.cell);
  }
  return actual_cell(c.base_cell, wanted);
}

HullCells hull_cells(const Case& c) {
  HullCells cells{c.base_cell, 0};
  for (const Stage& stage : c.stages) {
    const double cell = hull_cell(c, stage);
    cells.finest = std::min(cells.finest, cell);
    cells.coarsest = std::max(cells.coarsest, cell);
  }
  return cells;
}

std::string file_beside_case(const std::string& name, const std::string& folder) {
  const std::filesystem::path file(name);
  if (file.empty() || file.is_absolute() || folder.empty()) return name;
  return (std::filesystem::path(folder) / file).string();
}

hull::SectionSpec section_spec(const Hull& hull, const std::string& folder) {
  hull::SectionSpec spec;
  spec.shape = section_shape(hull.shape);
  spec.beam = hull.beam;
  spec.height = hull.height;
  spec.corner_radius = hull.corner_radius;
  for (const auto& v : hull.vertices) spec.vertices.emplace_back(v[0], v[1]);
  spec.offsets_file = file_beside_case(hull.offsets_file, folder);
  spec.station = hull.station;
  spec.scale = hull.scale;
  spec.extend_to = hull.extend_to;
  spec.compartments = compartment_specs<2>(hull);
  return spec;
}

bool has_thin_walls(const Case& c) {
  double thinnest = 1e300;
  for (const Compartment& compartment : c.hull.compartments)
    thinnest = std::min(thinnest, compartment.wall_thickness);
  for (std::size_t i = 0; i < c.hull.compartments.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Compartment &a = c.hull.compartments[i], &b = c.hull.compartments[j];
      double gap = 0;  // between the boxes, along the axis that parts them
      for (int axis = 3 - c.dim; axis < 3; ++axis)
        gap = std::max({gap, a.lower[axis] - b.upper[axis], b.lower[axis] - a.upper[axis]});
      if (gap > 1e-9) thinnest = std::min(thinnest, gap);
    }
  // A stretched base cell may be a little larger; the rule is about the nominal one.
  return thinnest < cells_per_wall * hull_cells(c).coarsest * (1 - 1e-6);
}

double opening_reach(const Case& c) {
  return 2 * hull_cells(c).coarsest * std::max(1.0, c.stretch_x);
}

std::vector<bool> open_compartments(const Hull& hull) {
  std::vector<bool> open;
  for (const Compartment& c : hull.compartments) open.push_back(c.flooded);
  return open;
}

std::shared_ptr<const hull::SectionHull> build_section_hull(const Case& c) {
  if (c.hull.shape == Hull::Shape::none) return nullptr;
  SEAWAY_CHECK(!c.stages.empty(), "the case has no stages; at least one is needed");
  const HullCells cells = hull_cells(c);
  return std::make_shared<hull::SectionHull>(hull::build_section(section_spec(c.hull, c.folder)),
                                             0.5 * cells.finest, 16 * cells.coarsest, opening_reach(c));
}

double start_draft(const Case& c, const hull::Section& section) {
  if (c.body.draft > 0) return c.body.draft;
  const auto solid = hull::buoyant_loops(section, open_compartments(c.hull));
  const auto draft = hull::find_waterline(solid, 0.0, c.body.mass / c.fluids.rho_water);
  SEAWAY_CHECK(draft, "mass {} kg/m exceeds what the hull can displace, {} kg/m; it cannot float",
               c.body.mass, c.fluids.rho_water * hull::hydrostatics(solid, {1e9, 0.0}).area);
  return *draft;
}

NaturalPeriods natural_periods(const Case& c, double gm, double waterplane) {
  const auto is_free = [&](Dof dof) {
    return std::find(c.body.free.begin(), c.body.free.end(), dof) != c.body.free.end();
  };
  NaturalPeriods periods;
  const double weight = c.body.mass * c.fluids.gravity;
  // Rough added inertia: a quarter of the dry one in roll, the mass in heave.
  if (is_free(Dof::roll) && gm > 0)
    periods.roll = 2 * pi * c.body.gyradii.x() * std::sqrt(1.25 * c.body.mass / (weight * gm));
  const double stiffness = c.fluids.rho_water * c.fluids.gravity * waterplane;
  if (is_free(Dof::heave) && stiffness > 0)
    periods.heave = 2 * pi * std::sqrt(2 * c.body.mass / stiffness);
  return periods;
}

NaturalPeriods natural_periods(const Case& c, const hull::Section& section, double draft) {
  const auto loops = hull::buoyant_loops(section, open_compartments(c.hull));
  return natural_periods(c, hull::metacentric_height(loops, {draft, 0}, from_vec3<2>(c.body.cog)),
                         hull::hydrostatics(loops, {draft, 0}).waterplane_breadth);
}

}  // namespace seaway::sim
