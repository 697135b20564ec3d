#include "core/sim/build_ship.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace seaway::sim {

namespace {

hull::ShipSpec::Shape ship_shape(Hull::Shape shape) {
  switch (shape) {
    case Hull::Shape::box:
      return hull::ShipSpec::Shape::box;
    case Hull::Shape::rounded_box:
      return hull::ShipSpec::Shape::rounded_box;
    case Hull::Shape::cylinder:
      return hull::ShipSpec::Shape::cylinder;
    case Hull::Shape::sphere:
      return hull::ShipSpec::Shape::sphere;
    case Hull::Shape::wigley:
      return hull::ShipSpec::Shape::wigley;
    case Hull::Shape::offsets_hull:
      return hull::ShipSpec::Shape::offsets;
    case Hull::Shape::stl:
      return hull::ShipSpec::Shape::stl;
    case Hull::Shape::polygon:
    case Hull::Shape::offsets_section:
    case Hull::Shape::none:
      break;
  }
  fail(ErrorCode::invalid_argument, "this shape is a section; a ship's case needs a body in space");
}

}  // namespace

hull::ShipSpec ship_spec(const Hull& hull, const std::string& folder) {
  hull::ShipSpec spec;
  spec.shape = ship_shape(hull.shape);
  spec.length = hull.length;
  spec.beam = hull.beam;
  spec.height = hull.height;
  spec.corner_radius = hull.corner_radius;
  spec.radius = hull.radius;
  spec.design_draft = hull.design_draft;
  spec.file = file_beside_case(hull.offsets_file, folder);
  spec.amidships = hull.station;
  spec.scale = hull.scale;
  spec.extend_to = hull.extend_to;
  spec.unit = hull.unit;
  spec.compartments = compartment_specs<3>(hull);
  return spec;
}

hull::Surface outer_surface(const Hull& hull, const std::string& folder) {
  return hull::outer_surface(ship_spec(hull, folder));
}

std::shared_ptr<const hull::SurfaceHull> build_surface_hull(const Case& c) {
  if (c.hull.shape == Hull::Shape::none) return nullptr;
  SEAWAY_CHECK(!c.stages.empty(), "the case has no stages; at least one is needed");
  const HullCells cells = hull_cells(c);
  hull::Ship ship = hull::build_ship(ship_spec(c.hull, c.folder));
  const double margin = 8 * cells.coarsest;
  const double spacing =
      std::max(0.5 * cells.finest, hull::DistanceGrid::finest_spacing(hull::bounds_of(ship.outer), margin));
  return std::make_shared<hull::SurfaceHull>(std::move(ship), spacing, margin, opening_reach(c));
}

double start_draft(const Case& c, const hull::Ship& ship) {
  if (c.body.draft > 0) return c.body.draft;
  const hull::Solid solid = hull::buoyant_surfaces(ship, open_compartments(c.hull));
  const auto draft = hull::find_waterline(solid, 0.0, 0.0, c.body.mass / c.fluids.rho_water);
  SEAWAY_CHECK(draft, "mass {} kg exceeds what the hull can displace, {} kg; it cannot float", c.body.mass,
               c.fluids.rho_water * hull::hydrostatics(solid, {1e9, 0, 0}).volume);
  return *draft;
}

NaturalPeriods natural_periods(const Case& c, const hull::Ship& ship, double draft) {
  const hull::Solid solid = hull::buoyant_surfaces(ship, open_compartments(c.hull));
  const hull::ShipHydrostatics water = hull::hydrostatics(solid, {draft, 0, 0});
  return natural_periods(c, hull::metacentric_heights(water, {draft, 0, 0}, c.body.cog).transverse,
                         water.waterplane_area);
}

}  // namespace seaway::sim
