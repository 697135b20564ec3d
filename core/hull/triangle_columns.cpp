#include "core/hull/triangle_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"

namespace seaway::hull {

namespace {

struct Point {
  double u, v, w;
};

/// A convex polygon in space; a triangle cut by at most seven planes.
struct Polygon3 {
  int n = 0;
  Point p[12];
  void push(const Point& x) { p[n++] = x; }
};

/// The part of `in` where s <= 0, s linear.
template <class Level>
inline void cut(const Polygon3& in, const Level& s, Polygon3& out) {
  out.n = 0;
  if (in.n == 0) return;
  const Point* a = &in.p[in.n - 1];
  double sa = s(*a);
  for (int i = 0; i < in.n; ++i) {
    const Point* b = &in.p[i];
    const double sb = s(*b);
    if ((sa <= 0) != (sb <= 0)) {
      const double t = sa / (sa - sb);
      out.push({a->u + t * (b->u - a->u), a->v + t * (b->v - a->v), a->w + t * (b->w - a->w)});
    }
    if (sb <= 0) out.push(*b);
    a = b;
    sa = sb;
  }
}

/// Triangle `x` from the centre of `f`, cut to the rectangle |v| <= half, |w| <= half. Returns the
/// polygon, which lives in one of the two buffers.
template <class Triangle, class Frame>
inline const Polygon3* cut_to_rectangle(const Triangle& t, const Frame& f, Polygon3& one,
                                        Polygon3& two) {
  const double v0 = f.centre[1], w0 = f.centre[2], hv = f.half[1], hw = f.half[2];
  one.n = 3;
  for (int i = 0; i < 3; ++i) one.p[i] = {t.x[i][0] - f.centre[0], t.x[i][1] - v0, t.x[i][2] - w0};
  Polygon3 *now = &one, *next = &two;
  const auto by = [&](const auto& level) {
    cut(*now, level, *next);
    std::swap(now, next);
  };
  if (t.high[1] > v0 + hv) by([hv](const Point& p) { return p.v - hv; });
  if (t.low[1] < v0 - hv) by([hv](const Point& p) { return -hv - p.v; });
  if (t.high[2] > w0 + hw) by([hw](const Point& p) { return p.w - hw; });
  if (t.low[2] < w0 - hw) by([hw](const Point& p) { return -hw - p.w; });
  return now;
}

/// Integrals over projected polygons.
struct Sum {
  double volume = 0, u = 0, v = 0, w = 0;

  /// height dv dw: the polygon is wholly above the control volume; its u moment cancels.
  void add_constant(const Polygon3& q, double weight, double height) {
    const double s = 0.5 * weight * height;
    for (int i = 1; i + 1 < q.n; ++i) {
      const Point &a = q.p[0], &b = q.p[i], &c = q.p[i + 1];
      const double area = s * ((b.v - a.v) * (c.w - a.w) - (c.v - a.v) * (b.w - a.w));
      volume += area;
      v += area * (a.v + b.v + c.v) * (1.0 / 3.0);
      w += area * (a.w + b.w + c.w) * (1.0 / 3.0);
    }
  }
  /// max(u - c, 0) dv dw and its moments: (u^2 - c^2) / 2 where u > c, v (u - c), w (u - c).
  void add_above(const Polygon3& q, double weight, double c, bool cuts) {
    Polygon3 part;
    const Polygon3* p = &q;
    if (cuts) {
      cut(
          q, [c](const Point& x) { return c - x.u; }, part);
      p = &part;
    }
    for (int i = 1; i + 1 < p->n; ++i) {
      const Point &a = p->p[0], &b = p->p[i], &d = p->p[i + 1];
      const double area = 0.5 * weight * ((b.v - a.v) * (d.w - a.w) - (d.v - a.v) * (b.w - a.w));
      const double ga = a.u - c, gb = b.u - c, gd = d.u - c, g = ga + gb + gd;
      volume += area * g * (1.0 / 3.0);
      // u^2 - c^2 = g^2 + 2 c g
      u += area * ((ga * ga + gb * gb + gd * gd + ga * gb + gb * gd + gd * ga) * (1.0 / 12.0) +
                   c * g * (1.0 / 3.0));
      v += area * ((a.v + b.v + d.v) * g + a.v * ga + b.v * gb + d.v * gd) * (1.0 / 12.0);
      w += area * ((a.w + b.w + d.w) * g + a.w * ga + b.w * gb + d.w * gd) * (1.0 / 12.0);
    }
  }
  /// clamp(u, -half, half) + half
  void add(const Polygon3& q, double weight, double half) {
    if (q.n < 3) return;
    double low = q.p[0].u, high = low;
    for (int i = 1; i < q.n; ++i) {
      low = std::min(low, q.p[i].u);
      high = std::max(high, q.p[i].u);
    }
    if (high <= -half) return;
    if (low >= half) return add_constant(q, weight, 2 * half);
    add_above(q, weight, -half, low < -half);
    if (high > half) add_above(q, -weight, half, true);
  }
};

/// Whether the segment ab meets |v| <= half_v, |w| <= half_w.
bool meets(const Point& a, const Point& b, double half_v, double half_w) {
  double t0 = 0, t1 = 1;
  const auto slab = [&](double x, double dx, double half) {
    if (dx == 0) return std::abs(x) <= half;
    const double p = (-half - x) / dx, q = (half - x) / dx;
    t0 = std::max(t0, std::min(p, q));
    t1 = std::min(t1, std::max(p, q));
    return t0 <= t1;
  };
  return slab(a.v, b.v - a.v, half_v) && slab(a.w, b.w - a.w, half_w);
}

float rounded_down(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float rounded_up(double x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

}  // namespace

TriangleColumns::TriangleColumns(const std::vector<std::shared_ptr<const SurfaceTree>>& solids,
                                 const OrientedBox<3>& block) {
  std::vector<std::vector<int>> found[3];
  std::size_t fewest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::size_t n = 0;
    found[axis].resize(solids.size());
    for (std::size_t i = 0; i < solids.size(); ++i) {
      solids[i]->find_in_column(block, axis, found[axis][i]);
      n += found[axis][i].size();
    }
    if (axis == 0 || n < fewest) {
      fewest = n;
      axes_[0] = axis;
    }
  }
  axes_[1] = (axes_[0] + 1) % 3;
  axes_[2] = (axes_[0] + 2) % 3;
  for (int a = 0; a < 3; ++a) half_[a] = block.half[axes_[a]];
  for (std::size_t i = 0; i < solids.size(); ++i) gather(*solids[i], found[axes_[0]][i], block);
  fill_bins();
}

void TriangleColumns::gather(const SurfaceTree& solid, const std::vector<int>& found,
                             const OrientedBox<3>& block) {
  const Surface& s = solid.surface();
  Eigen::Matrix3d turn;
  for (int a = 0; a < 3; ++a) turn.row(a) = block.axes.col(axes_[a]).transpose();
  const auto local = [&](int vertex) -> Vec3 { return turn * (s.vertices[vertex] - block.centre); };
  const auto u_of = [&](int vertex) { return turn.row(0).dot(s.vertices[vertex] - block.centre); };
  std::vector<Triangle> beyond;
  bool shows = false;
  for (const int number : found) {
    const auto& corners = s.triangles[number];
    Triangle t;
    double low[3], high[3];
    for (int i = 0; i < 3; ++i) {
      const Vec3 x = local(corners[i]);
      for (int a = 0; a < 3; ++a) {
        t.x[i][a] = x[a];
        low[a] = i == 0 ? x[a] : std::min(low[a], x[a]);
        high[a] = i == 0 ? x[a] : std::max(high[a], x[a]);
      }
    }
    if (high[0] <= -half_[0]) continue;  // counts nothing
    if (low[1] >= half_[1] || high[1] <= -half_[1] || low[2] >= half_[2] || high[2] <= -half_[2])
      continue;
    t.weight = solid.weight();
    for (int a = 0; a < 3; ++a) {
      t.low[a] = rounded_down(low[a]);
      t.high[a] = rounded_up(high[a]);
    }
    if (low[0] <= half_[0]) {
      triangles_.push_back(t);
      continue;
    }
    beyond.push_back(t);
    for (int e = 0; e < 3 && !shows; ++e) {
      bool border = false;
      for (const int v : s.triangles[solid.neighbours()[number][e]])
        border = border || u_of(v) <= half_[0];
      if (!border) continue;
      const double *p = t.x[e], *q = t.x[(e + 1) % 3];
      shows = meets({p[0], p[1], p[2]}, {q[0], q[1], q[2]}, half_[1], half_[2]);
    }
  }
  if (beyond.empty()) return;
  if (!shows) {
    const Frame f{{0, 0, 0}, {half_[0], half_[1], half_[2]}};
    Sum sum;
    Polygon3 one, two;
    for (const Triangle& t : beyond) sum.add_constant(*cut_to_rectangle(t, f, one, two), 1.0, 1.0);
    const double times = sum.volume / (4 * half_[1] * half_[2]);
    if (std::abs(times - std::round(times)) < 1e-9) {
      always_ += solid.weight() * std::round(times);
      return;
    }
  }
  triangles_.insert(triangles_.end(), beyond.begin(), beyond.end());
}

int TriangleColumns::bin_of(double x, int side) const {
  const double i = (x + half_[side + 1]) * bins_per_metre_[side];
  return i <= 0 ? 0 : (i >= n_bins ? n_bins - 1 : static_cast<int>(i));
}

void TriangleColumns::fill_bins() {
  for (int side = 0; side < 2; ++side) bins_per_metre_[side] = n_bins / (2 * half_[side + 1]);
  std::array<int, n_bins * n_bins + 1> count{};
  const auto for_bins = [&](const Triangle& t, const auto& act) {
    const int v1 = bin_of(t.high[1], 0), w1 = bin_of(t.high[2], 1);
    for (int w = t.first_bin[1]; w <= w1; ++w)
      for (int v = t.first_bin[0]; v <= v1; ++v) act(w * n_bins + v);
  };
  for (Triangle& t : triangles_) {
    for (int side = 0; side < 2; ++side)
      t.first_bin[side] = static_cast<signed char>(bin_of(t.low[side + 1], side));
    for_bins(t, [&](int bin) { ++count[static_cast<std::size_t>(bin)]; });
  }
  begin_[0] = 0;
  for (std::size_t i = 0; i < n_bins * n_bins; ++i) begin_[i + 1] = begin_[i] + count[i];
  members_.resize(static_cast<std::size_t>(begin_.back()));
  std::array<int, n_bins* n_bins + 1> next = begin_;
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for_bins(triangles_[i], [&](int bin) {
      members_[static_cast<std::size_t>(next[static_cast<std::size_t>(bin)]++)] =
          static_cast<int>(i);
    });
}

TriangleColumns::Frame TriangleColumns::frame_of(const Cuboid& box) const {
  Frame f;
  for (int a = 0; a < 3; ++a) {
    f.centre[a] = box.centre[axes_[a]];
    f.half[a] = box.half[axes_[a]];
    SEAWAY_ASSERT(std::abs(f.centre[a]) + f.half[a] <= half_[a] * (1 + 1e-9));
  }
  return f;
}

/// Every triangle above the lower end of `f` whose bounds meet its rectangle, once.
template <class Visit>
inline void TriangleColumns::visit(const Frame& f, const Visit& act) const {
  const double v0 = f.centre[1] - f.half[1], v1 = f.centre[1] + f.half[1],
               w0 = f.centre[2] - f.half[2], w1 = f.centre[2] + f.half[2],
               u0 = f.centre[0] - f.half[0];
  const int bv0 = bin_of(v0, 0), bv1 = bin_of(v1, 0), bw0 = bin_of(w0, 1), bw1 = bin_of(w1, 1);
  for (int w = bw0; w <= bw1; ++w)
    for (int v = bv0; v <= bv1; ++v) {
      const int bin = w * n_bins + v;
      for (int m = begin_[static_cast<std::size_t>(bin)];
           m < begin_[static_cast<std::size_t>(bin) + 1]; ++m) {
        const Triangle& t =
            triangles_[static_cast<std::size_t>(members_[static_cast<std::size_t>(m)])];
        if (std::max<int>(t.first_bin[0], bv0) != v || std::max<int>(t.first_bin[1], bw0) != w)
          continue;  // seen in an earlier bin
        if (t.high[0] <= u0 || t.low[1] >= v1 || t.high[1] <= v0 || t.low[2] >= w1 ||
            t.high[2] <= w0)
          continue;
        act(t);
      }
    }
}

TriangleColumns::Moments TriangleColumns::moments(const Cuboid& box) const {
  const Frame f = frame_of(box);
  Sum sum;
  Polygon3 one, two;
  visit(f, [&](const Triangle& t) {
    sum.add(*cut_to_rectangle(t, f, one, two), t.weight, f.half[0]);
  });
  Moments m;
  m.volume = sum.volume + always_ * 8 * f.half[0] * f.half[1] * f.half[2];
  m.first[axes_[0]] = sum.u;
  m.first[axes_[1]] = sum.v;
  m.first[axes_[2]] = sum.w;
  return m;
}

std::vector<TriangleColumns::Moments> TriangleColumns::moments(const BoxLattice& lattice) const {
  LatticeSum sum(lattice, {axes_[0], axes_[1], axes_[2]});
  for (const Triangle& t : triangles_) sum.add(t.x, t.weight);
  return sum.moments(always_);
}

double TriangleColumns::volume_below(const Cuboid& box, const Vec3& normal, double d) const {
  const Frame f = frame_of(box);
  double n[3] = {normal[axes_[0]], normal[axes_[1]], normal[axes_[2]]};
  // A plane along u is turned by 1e-12: its height over the rectangle is then a function.
  const double least = 1e-12 * (std::abs(n[1]) + std::abs(n[2]));
  if (std::abs(n[0]) < least) n[0] = n[0] < 0 ? -least : least;
  const bool above = n[0] < 0;  // the part above a plane is the whole less the part below
  if (above) {
    for (double& x : n) x = -x;
    d = -d;
  }
  const double slope_v = -n[1] / n[0], slope_w = -n[2] / n[0], height = d / n[0];
  Sum whole, below;
  Polygon3 one, two, under, over;
  const auto add = [&](const Polygon3& q, double weight) {
    const auto level = [&](const Point& p) {
      return p.u - (height + slope_v * p.v + slope_w * p.w);
    };
    double lowest = 1, highest = -1;  // a polygon in the plane belongs to one side only
    for (int i = 0; i < q.n; ++i) {
      const double s = level(q.p[i]);
      lowest = i == 0 ? s : std::min(lowest, s);
      highest = i == 0 ? s : std::max(highest, s);
    }
    if (highest <= 0) {
      below.add(q, weight, f.half[0]);
    } else {
      if (lowest < 0) {
        cut(q, level, under);
        below.add(under, weight, f.half[0]);
      }
      cut(
          q, [&](const Point& p) { return -level(p); }, over);
      for (int i = 0; i < over.n; ++i)
        over.p[i].u = height + slope_v * over.p[i].v + slope_w * over.p[i].w;
      below.add(over, weight, f.half[0]);
    }
    if (above) whole.add(q, weight, f.half[0]);
  };
  visit(f, [&](const Triangle& t) { add(*cut_to_rectangle(t, f, one, two), t.weight); });
  if (always_ != 0) {
    const double top = f.half[0], v = f.half[1], w = f.half[2];
    one.n = 4;
    one.p[0] = {top, -v, -w};
    one.p[1] = {top, v, -w};
    one.p[2] = {top, v, w};
    one.p[3] = {top, -v, w};
    add(one, always_);
  }
  return above ? whole.volume - below.volume : below.volume;
}

double TriangleColumns::face_area(const Cuboid& box, int axis, bool high) const {
  Frame f = frame_of(box);
  int along = 0;
  while (axes_[along] != axis) ++along;
  const double at = high ? f.half[along] : -f.half[along];
  if (along == 0) {
    Sum sum;
    Polygon3 one, two, part;
    visit(f, [&](const Triangle& t) {
      cut(
          *cut_to_rectangle(t, f, one, two), [at](const Point& p) { return at - p.u; }, part);
      sum.add_constant(part, t.weight, 1.0);
    });
    return sum.volume + always_ * 4 * f.half[1] * f.half[2];
  }
  const int other = 3 - along;
  // Section of the triangle by the face's plane: from where its border crosses the plane towards
  // higher v (w) to where it comes back.
  const double sign = along == 1 ? 1 : -1, half_u = f.half[0], reach = f.half[other];
  double area = 0;
  const auto height = [](double p0, double p1, double c) {  // mean of max(u - c, 0)
    const double a = p0 - c, b = p1 - c;
    if (a <= 0 && b <= 0) return 0.0;
    if (a >= 0 && b >= 0) return 0.5 * (a + b);
    const double top = std::max(a, b);
    return 0.5 * top * top / std::abs(a - b);
  };
  visit(f, [&](const Triangle& t) {
    double up_u = 0, up_s = 0, down_u = 0, down_s = 0;
    bool crosses = false;
    for (int e = 0; e < 3; ++e) {
      const double *p = t.x[e], *q = t.x[e == 2 ? 0 : e + 1];
      const double sp = p[along] - f.centre[along] - at, sq = q[along] - f.centre[along] - at;
      if ((sp > 0) == (sq > 0)) continue;
      crosses = true;
      const double k = sp / (sp - sq);
      const double u = p[0] + k * (q[0] - p[0]) - f.centre[0],
                   s = p[other] + k * (q[other] - p[other]) - f.centre[other];
      (sq > 0 ? up_u : down_u) = u;
      (sq > 0 ? up_s : down_s) = s;
    }
    if (!crosses || up_s == down_s) return;
    const double c0 = std::clamp(up_s, -reach, reach), c1 = std::clamp(down_s, -reach, reach);
    if (c0 == c1) return;
    const double slope = (down_u - up_u) / (down_s - up_s);
    const double u0 = up_u + slope * (c0 - up_s), u1 = down_u + slope * (c1 - down_s);
    area += sign * t.weight * (c1 - c0) * (height(u0, u1, -half_u) - height(u0, u1, half_u));
  });
  return area + always_ * 4 * half_u * reach;
}

}  // namespace seaway::hull
