#include "core/hull/box_lattice.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::hull {

/// A convex polygon: a triangle cut by at most six planes. Coordinates in units of the lattice.
struct LatticeSum::Piece {
  int n = 0;
  double p[10][3];

  void push(const double* x) {
    p[n][0] = x[0];
    p[n][1] = x[1];
    p[n][2] = x[2];
    ++n;
  }
  double least(int axis) const {
    double x = p[0][axis];
    for (int i = 1; i < n; ++i) x = std::min(x, p[i][axis]);
    return x;
  }
  double most(int axis) const {
    double x = p[0][axis];
    for (int i = 1; i < n; ++i) x = std::max(x, p[i][axis]);
    return x;
  }
  /// Into the parts below and above a plane across an axis.
  void split(int axis, double plane, Piece& below, Piece& above) const {
    below.n = above.n = 0;
    const double* a = p[n - 1];
    double sa = a[axis] - plane;
    for (int i = 0; i < n; ++i) {
      const double* b = p[i];
      const double sb = b[axis] - plane;
      if ((sa <= 0) != (sb <= 0)) {
        const double t = sa / (sa - sb);
        double x[3];
        for (int k = 0; k < 3; ++k) x[k] = a[k] + t * (b[k] - a[k]);
        x[axis] = plane;
        below.push(x);
        above.push(x);
      }
      (sb <= 0 ? below : above).push(b);
      a = b;
      sa = sb;
    }
  }
  /// act(index, part) for the part of the polygon in each unit interval [index, index + 1] of an axis, 0 <= index < n.
  template <class Act>
  void for_slabs(int axis, int slabs, const Act& act) const {
    const double low = least(axis), high = most(axis);
    if (high <= 0 || low >= slabs) return;
    Piece one, two, part;
    const Piece* rest = this;
    int i = 0;
    if (low < 0) {
      split(axis, 0, part, one);
      rest = &one;
    } else {
      i = std::min(static_cast<int>(low), slabs - 1);
    }
    for (; i < slabs; ++i) {
      if (high <= i + 1) {
        if (rest->n >= 3) act(i, *rest);
        return;
      }
      Piece& above = rest == &one ? two : one;
      rest->split(axis, i + 1, part, above);
      if (part.n >= 3) act(i, part);
      rest = &above;
      if (rest->n < 3) return;
    }
  }
};

LatticeSum::LatticeSum(const BoxLattice& lattice, const std::array<int, 3>& axes) : lattice_(lattice), axes_(axes) {
  for (int a = 0; a < 3; ++a) {
    const int axis = axes_[static_cast<std::size_t>(a)];
    n_[a] = lattice_.n[axis];
    lower_[a] = lattice_.lower[axis];
    scale_[a] = 1 / lattice_.edge[axis];
  }
  entries_.resize(static_cast<std::size_t>(n_[0] + 1) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]));
}

void LatticeSum::add_area(const Piece& q, int v, int w, double weight, Entry& e) {
  const double v0 = v + 0.5, w0 = w + 0.5;
  const double* a = q.p[0];
  for (int i = 1; i + 1 < q.n; ++i) {
    const double *b = q.p[i], *c = q.p[i + 1];
    const double area = 0.5 * weight * ((b[1] - a[1]) * (c[2] - a[2]) - (c[1] - a[1]) * (b[2] - a[2]));
    e.area += area;
    e.area_v += area * ((a[1] + b[1] + c[1]) * (1.0 / 3.0) - v0);
    e.area_w += area * ((a[2] + b[2] + c[2]) * (1.0 / 3.0) - w0);
  }
}

/// With g the height over the box's foot: integrals of g, (g^2 - g) / 2 [the moment of the column below about the middle],
/// v g and w g over the projected piece; and its area.
void LatticeSum::add_part(const Piece& q, int u, int v, int w, double weight, Entry& e) {
  const double v0 = v + 0.5, w0 = w + 0.5;
  const double *a = q.p[0], ga = a[0] - u, va = a[1] - v0, wa = a[2] - w0;
  for (int i = 1; i + 1 < q.n; ++i) {
    const double *b = q.p[i], *c = q.p[i + 1];
    const double gb = b[0] - u, gc = c[0] - u, g = ga + gb + gc;
    const double vb = b[1] - v0, vc = c[1] - v0, wb = b[2] - w0, wc = c[2] - w0;
    const double area = 0.5 * weight * ((vb - va) * (wc - wa) - (vc - va) * (wb - wa));
    e.volume += area * g * (1.0 / 3.0);
    e.u += area * ((ga * ga + gb * gb + gc * gc + ga * gb + gb * gc + gc * ga) * (1.0 / 12.0) - g * (1.0 / 6.0));
    e.v += area * ((va + vb + vc) * g + va * ga + vb * gb + vc * gc) * (1.0 / 12.0);
    e.w += area * ((wa + wb + wc) * g + wa * ga + wb * gb + wc * gc) * (1.0 / 12.0);
    e.area += area;
    e.area_v += area * (va + vb + vc) * (1.0 / 3.0);
    e.area_w += area * (wa + wb + wc) * (1.0 / 3.0);
  }
}

void LatticeSum::add_column(const Piece& q, int v, int w, double weight) {
  const double high = q.most(0);
  if (high <= 0) return;  // below all boxes
  const int top = n_[0];
  if (q.least(0) >= top) return add_area(q, v, w, weight, entry(top, v, w));
  if (high <= top) {
    q.for_slabs(0, top, [&](int u, const Piece& part) { add_part(part, u, v, w, weight, entry(u, v, w)); });
    return;
  }
  Piece inside, above;
  q.split(0, top, inside, above);
  if (above.n >= 3) add_area(above, v, w, weight, entry(top, v, w));
  if (inside.n >= 3)
    inside.for_slabs(0, top, [&](int u, const Piece& part) { add_part(part, u, v, w, weight, entry(u, v, w)); });
}

void LatticeSum::add(const double corners[3][3], double weight) {
  Piece triangle;
  triangle.n = 3;
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < 3; ++a) triangle.p[i][a] = (corners[i][a] - lower_[a]) * scale_[a];
  if (triangle.most(0) <= 0) return;
  triangle.for_slabs(1, n_[1], [&](int v, const Piece& strip) {
    strip.for_slabs(2, n_[2], [&](int w, const Piece& q) { add_column(q, v, w, weight); });
  });
}

std::vector<BoxMoments> LatticeSum::moments(double beyond) const {
  std::vector<BoxMoments> out(lattice_.size());
  const double volume = lattice_.edge.prod();
  const auto axis = [&](int a) { return axes_[static_cast<std::size_t>(a)]; };
  const double du = volume * lattice_.edge[axis(0)], dv = volume * lattice_.edge[axis(1)], dw = volume * lattice_.edge[axis(2)];
  IVec<3> i{};
  for (i[axis(2)] = 0; i[axis(2)] < n_[2]; ++i[axis(2)])
    for (i[axis(1)] = 0; i[axis(1)] < n_[1]; ++i[axis(1)]) {
      const Entry* column = &entries_[static_cast<std::size_t>((i[axis(2)] * n_[1] + i[axis(1)]) * (n_[0] + 1))];
      double area = beyond + column[n_[0]].area, area_v = column[n_[0]].area_v, area_w = column[n_[0]].area_w;
      for (int u = n_[0] - 1; u >= 0; --u) {
        const Entry& e = column[u];
        i[axis(0)] = u;
        BoxMoments& m = out[lattice_.at(i)];
        m.volume = volume * (e.volume + area);
        m.first[axis(0)] = du * e.u;
        m.first[axis(1)] = dv * (e.v + area_v);
        m.first[axis(2)] = dw * (e.w + area_w);
        area += e.area;
        area_v += e.area_v;
        area_w += e.area_w;
      }
    }
  return out;
}

}  // namespace seaway::hull
