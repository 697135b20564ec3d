// The hull of a ship's case (3-D) as geometry: from the case's description to core/hull, and where the ship
// floats. Relative file names are looked up in Case::folder. Pure functions, thread-safe.
#pragma once

#include <memory>

#include "core/hull/ship_hydrostatics.hpp"
#include "core/hull/surface_hull.hpp"
#include "core/sim/build_hull.hpp"

namespace seaway::sim {

/// Before: shape is not none and exists in 3-D, else Error(invalid_argument). Wrong values show in
/// hull::build_ship.
hull::ShipSpec ship_spec(const Hull& hull, const std::string& folder);

/// The outer surface, hull axes. Before: shape is not none. Throws Error: invalid_argument (sizes, a table or
/// STL file that gives no hull), not_found (file).
hull::Surface outer_surface(const Hull& hull, const std::string& folder);

/// nullptr if the case has no hull. The distance table has half the finest hull cell of all stages as spacing
/// (or what its size allows) and is exact to 8 of the coarsest hull cells from the hull; openings reach 2 of
/// the coarsest hull cells beyond their boxes in opening_part. Throws as hull::build_ship.
std::shared_ptr<const hull::SurfaceHull> build_surface_hull(const Case& c);

/// Draft amidships at the start, upright and on even keel: Body::draft, or if that is 0 the draft at which the
/// ship floats with the flooded compartments open. Throws Error(invalid_argument) if it does not float.
double start_draft(const Case& c, const hull::Ship& ship);

/// As for a section (build_hull.hpp).
NaturalPeriods natural_periods(const Case& c, const hull::Ship& ship, double draft);

}  // namespace seaway::sim
