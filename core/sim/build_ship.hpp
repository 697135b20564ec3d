// The hull of a ship's case (3-D) as geometry: from the case's description to core/hull. Relative file names
// are looked up in Case::folder. Pure functions, thread-safe.
#pragma once

#include <memory>

#include "core/hull/surface_hull.hpp"
#include "core/sim/case.hpp"

namespace seaway::sim {

/// The outer surface, hull axes. Before: shape is not none. Throws Error: invalid_argument (sizes, a table
/// that gives no hull), not_found (table).
hull::Surface outer_surface(const Hull& hull, const std::string& folder);

/// nullptr if the case has no hull. The distance table has half the finest hull cell of all stages as spacing
/// (or what its size allows) and is exact to 8 of the coarsest hull cells from the hull. Throws as
/// outer_surface.
std::shared_ptr<const hull::SurfaceHull> build_surface_hull(const Case& c);

}  // namespace seaway::sim
