// Closed plane polygons in hull axes (y port, z up) [m]: measures and elementary tests.
//
// A polygon is a list of corners; the edge from the last to the first is implied. Anticlockwise
// loops have positive area, holes run clockwise. Pure functions, thread-safe.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/base/vec.hpp"
#include "core/hull/hull.hpp"

namespace seaway::hull {

using Polygon = std::vector<Vec2>;

/// A loop of the boundary of a solid with density `weight` on its left side. A solid is a list of
/// them: outer loops anticlockwise, holes clockwise; several loops may bound the same region, then
/// their weights add.
struct WeightedLoop {
  Polygon points;
  double weight = 1;
};

/// Enclosed area, positive if anticlockwise [m2].
double signed_area(const Polygon& p);

/// Integral of (y, z) over the enclosed area, signed as the area [m3].
Vec2 first_moment(const Polygon& p);

/// Smallest upright box around the corners. Before: not empty.
Box<2> bounds_of(const Polygon& p);

/// Whether the winding number of `p` about `x` is not zero. Points on the boundary: either answer.
bool contains(const Polygon& p, const Vec2& x);
/// Same for a region given by several loops (holes clockwise).
bool contains(const std::vector<Polygon>& loops, const Vec2& x);

/// The four corners of a box, anticlockwise.
Polygon box_polygon(const Box<2>& box);

/// First pair of edges (i, j), i < j, edge i running from corner i to i + 1, that cross, touch or
/// overlap, other than neighbours meeting in their common corner. O(n^2).
std::optional<std::pair<int, int>> first_self_intersection(const Polygon& p);

/// Sutherland-Hodgman: the part of `p` inside the box. A polygon that falls into several pieces
/// comes back as one loop whose pieces are joined by edges that run to and fro along the box's
/// sides; they cancel in every integral. Empty if nothing is left.
Polygon clip_to_box(const Polygon& p, const Box<2>& box);

/// Square of the distance of `x` from the edge a-b [m2].
inline double squared_distance_to_edge(const Vec2& x, const Vec2& a, const Vec2& b) {
  const Vec2 e = b - a, r = x - a;
  const double ee = e.squaredNorm();
  double t = ee > 0 ? r.dot(e) / ee : 0.0;
  t = t < 0 ? 0 : (t > 1 ? 1 : t);
  return (r - t * e).squaredNorm();
}

}  // namespace seaway::hull
