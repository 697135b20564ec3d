// A closed surface cut by a plane: outlines for pictures (sections, waterlines, body plans).
// Pure function, thread-safe.
#pragma once

#include <vector>

#include "core/hull/surface.hpp"

namespace seaway::hull {

/// The closed lines in which the plane normal . x = d cuts the surface, the solid on their left seen
/// against `normal` (holes run the other way). Corners exactly on the plane count as below it, so that
/// a closed surface always gives closed lines. Before: every edge belongs to two triangles.
std::vector<std::vector<Vec3>> cut_surface(const Surface& surface, const Vec3& normal, double d);

}  // namespace seaway::hull
