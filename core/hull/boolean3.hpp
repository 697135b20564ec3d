// Set operations on closed surfaces and the search for triangles that cross (CGAL, polygon mesh
// processing). Predicates are exact, new points are rounded to doubles. Pure functions; slow
// against all else here (a second for 50,000 triangles): for preparing, never for stepping.
#pragma once

#include <optional>
#include <utility>

#include "core/hull/surface.hpp"

namespace seaway::hull {

/// First pair of triangles, not neighbours, that cross, touch or overlap; or neighbours that fold
/// onto each other.
std::optional<std::pair<int, int>> first_crossing(const Surface& s);

/// Results are closed and oriented outwards; empty if nothing is left. Each throws
/// Error(invalid_argument) if an input is not closed or crosses itself, or if the result cannot be
/// made a surface in which every edge joins two triangles (the inputs touch along a line).
Surface subtract(const Surface& a, const Surface& b);
Surface intersect(const Surface& a, const Surface& b);
Surface unite(const Surface& a, const Surface& b);

}  // namespace seaway::hull
