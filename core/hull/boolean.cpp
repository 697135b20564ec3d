#include "core/hull/boolean.hpp"

#include <cmath>
#include <polyclipping/clipper.hpp>

namespace seaway::hull {

namespace {

constexpr double per_metre = 1e9;  // raster of Clipper's integers: 1e-9 m

ClipperLib::Path to_clipper(const Polygon& p) {
  ClipperLib::Path path;
  path.reserve(p.size());
  for (const Vec2& x : p)
    path.emplace_back(std::llround(x.x() * per_metre), std::llround(x.y() * per_metre));
  return path;
}

ClipperLib::Paths to_clipper(const Polygons& loops) {
  ClipperLib::Paths paths;
  paths.reserve(loops.size());
  for (const Polygon& p : loops) paths.push_back(to_clipper(p));
  return paths;
}

Polygons from_clipper(const ClipperLib::Paths& paths) {
  Polygons loops;
  loops.reserve(paths.size());
  for (const ClipperLib::Path& path : paths) {
    if (path.size() < 3) continue;
    Polygon p;
    p.reserve(path.size());
    for (const ClipperLib::IntPoint& x : path)
      p.emplace_back(static_cast<double>(x.X) / per_metre, static_cast<double>(x.Y) / per_metre);
    loops.push_back(std::move(p));
  }
  return loops;
}

Polygons combine(ClipperLib::ClipType type, const Polygons& a, const Polygons& b) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(to_clipper(a), ClipperLib::ptSubject, true);
  clipper.AddPaths(to_clipper(b), ClipperLib::ptClip, true);
  ClipperLib::Paths out;
  clipper.Execute(type, out, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return from_clipper(out);
}

}  // namespace

Polygons subtract(const Polygons& a, const Polygons& b) {
  return combine(ClipperLib::ctDifference, a, b);
}
Polygons intersect(const Polygons& a, const Polygons& b) {
  return combine(ClipperLib::ctIntersection, a, b);
}
Polygons unite(const Polygons& a, const Polygons& b) { return combine(ClipperLib::ctUnion, a, b); }

Polygons shrink(const Polygon& p, double distance) {
  // A mitre longer than 10 wall thicknesses is cut off: only at corners sharper than 11.5 degrees.
  ClipperLib::ClipperOffset offset(10.0);
  offset.AddPath(to_clipper(p), ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
  ClipperLib::Paths out;
  offset.Execute(out, -distance * per_metre);
  return from_clipper(out);
}

double area_of(const Polygons& loops) {
  double sum = 0;
  for (const Polygon& p : loops) sum += signed_area(p);
  return sum;
}

}  // namespace seaway::hull
