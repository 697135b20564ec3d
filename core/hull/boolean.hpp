// Set operations on polygons: difference, intersection, union and inward offset (Clipper library).
//
// Coordinates are rounded to 1e-9 m on the way in, so a result is exact for input on that raster
// and else within 1e-9 m. Results are loops without self-crossings: outer ones anticlockwise, holes
// clockwise. Pure functions, thread-safe.
#pragma once

#include <vector>

#include "core/hull/polygon.hpp"

namespace seaway::hull {

using Polygons = std::vector<Polygon>;

Polygons subtract(const Polygons& a, const Polygons& b);
Polygons intersect(const Polygons& a, const Polygons& b);
Polygons unite(const Polygons& a, const Polygons& b);

/// `p` with its boundary moved inwards by `distance` >= 0 [m], corners kept sharp (mitred). Empty
/// if nothing is left.
Polygons shrink(const Polygon& p, double distance);

/// Sum of the signed areas [m2].
double area_of(const Polygons& loops);

}  // namespace seaway::hull
