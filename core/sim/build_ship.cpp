#include "core/sim/build_ship.hpp"

#include <algorithm>
#include <filesystem>

#include "core/base/error.hpp"
#include "core/hull/surface_shapes.hpp"
#include "core/sim/build_hull.hpp"

namespace seaway::sim {

hull::Surface outer_surface(const Hull& hull, const std::string& folder) {
  switch (hull.shape) {
    case Hull::Shape::box:
      return hull::box_surface(hull.length, hull.beam, hull.height);
    case Hull::Shape::rounded_box:
      return hull.corner_radius > 0
                 ? hull::rounded_box_surface(hull.length, hull.beam, hull.height, hull.corner_radius)
                 : hull::box_surface(hull.length, hull.beam, hull.height);
    case Hull::Shape::cylinder:
      return hull::cylinder_surface(hull.length, hull.radius);
    case Hull::Shape::sphere:
      return hull::sphere_surface(hull.radius);
    case Hull::Shape::wigley:
      return hull::wigley_surface(hull.length, hull.beam, hull.design_draft, hull.height);
    case Hull::Shape::offsets_hull: {
      hull::OffsetsHullSpec spec;
      spec.scale = hull.scale;
      spec.origin = hull.station;
      spec.extend_to = hull.extend_to;
      return hull::offsets_surface(hull::read_offsets_table(file_beside_case(hull.offsets_file, folder)), spec);
    }
    case Hull::Shape::polygon:
    case Hull::Shape::offsets_section:
    case Hull::Shape::none:
      break;
  }
  fail(ErrorCode::invalid_argument, "this shape is a section; a ship's case needs a body in space");
}

std::shared_ptr<const hull::SurfaceHull> build_surface_hull(const Case& c) {
  if (c.hull.shape == Hull::Shape::none) return nullptr;
  SEAWAY_CHECK(!c.stages.empty(), "the case has no stages; at least one is needed");
  double finest = c.base_cell, coarsest = 0;
  for (const Stage& stage : c.stages) {
    const double cell = hull_cell(c, stage);
    finest = std::min(finest, cell);
    coarsest = std::max(coarsest, cell);
  }
  hull::Surface surface = outer_surface(c.hull, c.folder);
  const double margin = 8 * coarsest;
  const double spacing = std::max(0.5 * finest, hull::DistanceGrid::finest_spacing(hull::bounds_of(surface), margin));
  return std::make_shared<hull::SurfaceHull>(std::move(surface), spacing, margin);
}

}  // namespace seaway::sim
