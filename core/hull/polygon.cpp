#include "core/hull/polygon.hpp"

#include <algorithm>

namespace seaway::hull {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

int winding_number(const Polygon& p, const Vec2& x) {
  int winding = 0;
  for (std::size_t i = 0, n = p.size(); i < n; ++i) {
    const Vec2& a = p[i];
    const Vec2& b = p[i + 1 < n ? i + 1 : 0];
    if ((a.y() > x.y()) == (b.y() > x.y())) continue;
    const double side = cross(b - a, x - a);
    if (b.y() > a.y() && side > 0) ++winding;
    if (b.y() < a.y() && side < 0) --winding;
  }
  return winding;
}

/// -1, 0, 1: on which side of the line a-b is c?
int side_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double s = cross(b - a, c - a);
  return s > 0 ? 1 : (s < 0 ? -1 : 0);
}

bool within_span(const Vec2& a, const Vec2& b, const Vec2& c) {
  return std::min(a.x(), b.x()) <= c.x() && c.x() <= std::max(a.x(), b.x()) &&
         std::min(a.y(), b.y()) <= c.y() && c.y() <= std::max(a.y(), b.y());
}

bool edges_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const int sc = side_of(a, b, c), sd = side_of(a, b, d);
  const int sa = side_of(c, d, a), sb = side_of(c, d, b);
  if (sc * sd < 0 && sa * sb < 0) return true;
  return (sc == 0 && within_span(a, b, c)) || (sd == 0 && within_span(a, b, d)) ||
         (sa == 0 && within_span(c, d, a)) || (sb == 0 && within_span(c, d, b));
}

/// Keeps the part of `p` where sign * x[axis] <= sign * limit.
Polygon clip_axis(const Polygon& p, int axis, double limit, double sign) {
  Polygon out;
  out.reserve(p.size() + 4);
  for (std::size_t i = 0, n = p.size(); i < n; ++i) {
    const Vec2& a = p[i];
    const Vec2& b = p[i + 1 < n ? i + 1 : 0];
    const double sa = sign * (a[axis] - limit), sb = sign * (b[axis] - limit);
    if (sa <= 0) out.push_back(a);
    if ((sa <= 0) != (sb <= 0)) {
      Vec2 c = a + (sa / (sa - sb)) * (b - a);
      c[axis] = limit;
      out.push_back(c);
    }
  }
  return out;
}

}  // namespace

double signed_area(const Polygon& p) {
  double twice = 0;
  for (std::size_t i = 0, n = p.size(); i < n; ++i)
    twice += cross(p[i] - p[0], p[i + 1 < n ? i + 1 : 0] - p[0]);
  return 0.5 * twice;
}

Vec2 first_moment(const Polygon& p) {
  if (p.empty()) return Vec2::Zero();
  Vec2 sum = Vec2::Zero();  // about the first corner, which keeps rounding small
  for (std::size_t i = 0, n = p.size(); i < n; ++i) {
    const Vec2 a = p[i] - p[0], b = p[i + 1 < n ? i + 1 : 0] - p[0];
    sum += cross(a, b) * (a + b);
  }
  return sum / 6.0 + signed_area(p) * p[0];
}

Box<2> bounds_of(const Polygon& p) {
  Box<2> box{p.front(), p.front()};
  for (const Vec2& x : p) {
    box.lower = box.lower.cwiseMin(x);
    box.upper = box.upper.cwiseMax(x);
  }
  return box;
}

bool contains(const Polygon& p, const Vec2& x) { return winding_number(p, x) != 0; }

bool contains(const std::vector<Polygon>& loops, const Vec2& x) {
  int winding = 0;
  for (const Polygon& p : loops) winding += winding_number(p, x);
  return winding != 0;
}

Polygon box_polygon(const Box<2>& box) {
  return {box.lower, {box.upper.x(), box.lower.y()}, box.upper, {box.lower.x(), box.upper.y()}};
}

std::optional<std::pair<int, int>> first_self_intersection(const Polygon& p) {
  const int n = static_cast<int>(p.size());
  const auto corner = [&](int i) -> const Vec2& { return p[static_cast<std::size_t>(i % n)]; };
  for (int i = 0; i < n; ++i) {
    // Neighbours share a corner; they offend if one runs back over the other.
    const Vec2 e = corner(i + 1) - corner(i), f = corner(i + 2) - corner(i + 1);
    if (n > 2 && cross(e, f) == 0 && e.dot(f) < 0)
      return std::pair{std::min(i, (i + 1) % n), std::max(i, (i + 1) % n)};
    for (int j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (edges_meet(corner(i), corner(i + 1), corner(j), corner(j + 1))) return std::pair{i, j};
    }
  }
  return std::nullopt;
}

Polygon clip_to_box(const Polygon& p, const Box<2>& box) {
  Polygon out = p;
  for (int axis = 0; axis < 2 && !out.empty(); ++axis) {
    out = clip_axis(out, axis, box.upper[axis], 1.0);
    out = clip_axis(out, axis, box.lower[axis], -1.0);
  }
  return out;
}

}  // namespace seaway::hull
