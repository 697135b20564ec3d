#include "core/hull/distance_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"

namespace seaway::hull {

namespace {

struct Edge {
  Vec2 a, b;
};

std::vector<Edge> edges_of(const std::vector<Polygon>& loops) {
  std::vector<Edge> edges;
  for (const Polygon& p : loops)
    for (std::size_t i = 0; i < p.size(); ++i) edges.push_back({p[i], p[(i + 1) % p.size()]});
  return edges;
}

}  // namespace

DistanceTable::DistanceTable(const std::vector<Polygon>& walls, double spacing, double margin)
    : spacing_(spacing), margin_(margin) {
  SEAWAY_CHECK(std::isfinite(spacing) && spacing > 0 && std::isfinite(margin) && margin > 0,
               "distance table with spacing {} m and margin {} m; both must be positive", spacing,
               margin);
  SEAWAY_CHECK(!walls.empty() && !walls.front().empty(), "distance table of a hull without walls");
  box_ = bounds_of(walls.front());
  for (const Polygon& p : walls) {
    const Box<2> b = bounds_of(p);
    box_ = {box_.lower.cwiseMin(b.lower), box_.upper.cwiseMax(b.upper)};
  }
  box_.lower.array() -= margin;
  const Vec2 size = box_.upper - box_.lower + Vec2::Constant(margin);
  SEAWAY_CHECK(
      size.x() * size.y() < 4e7 * spacing * spacing,
      "distance table of {} x {} m with spacing {} m exceeds 40 million nodes; use a larger "
      "spacing or a smaller margin",
      size.x(), size.y(), spacing);
  n_y_ = static_cast<int>(std::ceil(size.x() / spacing)) + 1;
  n_z_ = static_cast<int>(std::ceil(size.y() / spacing)) + 1;
  box_.upper = box_.lower + spacing * Vec2(n_y_ - 1, n_z_ - 1);
  nodes_.resize(static_cast<std::size_t>(n_y_) * static_cast<std::size_t>(n_z_));
  fill_distances(walls);
  set_signs(walls);
}

void DistanceTable::fill_distances(const std::vector<Polygon>& walls) {
  const std::vector<Edge> edges = edges_of(walls);
  constexpr int tile = 16;
  const double reach = 0.5 * std::sqrt(2.0) * tile * spacing_;  // from a tile's centre to its nodes
  std::vector<double> at_centre(edges.size());
  std::vector<Edge> near;
  for (int k0 = 0; k0 < n_z_; k0 += tile)
    for (int j0 = 0; j0 < n_y_; j0 += tile) {
      // Only edges that are not farther than the nearest one by the tile's size can matter.
      const Vec2 centre = box_.lower + spacing_ * Vec2(j0 + 0.5 * tile, k0 + 0.5 * tile);
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < edges.size(); ++i) {
        at_centre[i] = std::sqrt(squared_distance_to_edge(centre, edges[i].a, edges[i].b));
        nearest = std::min(nearest, at_centre[i]);
      }
      near.clear();
      for (std::size_t i = 0; i < edges.size(); ++i)
        if (at_centre[i] <= nearest + 2 * reach) near.push_back(edges[i]);
      for (int k = k0; k < std::min(k0 + tile, n_z_); ++k)
        for (int j = j0; j < std::min(j0 + tile, n_y_); ++j) {
          const Vec2 x = box_.lower + spacing_ * Vec2(j, k);
          double d2 = std::numeric_limits<double>::infinity();
          for (const Edge& e : near) d2 = std::min(d2, squared_distance_to_edge(x, e.a, e.b));
          nodes_[static_cast<std::size_t>(k) * n_y_ + j] = std::sqrt(d2);
        }
    }
}

void DistanceTable::set_signs(const std::vector<Polygon>& walls) {
  struct Crossing {
    double y;
    int turn;
  };
  const std::vector<Edge> edges = edges_of(walls);
  std::vector<Crossing> row;
  for (int k = 0; k < n_z_; ++k) {
    const double z = box_.lower.y() + spacing_ * k;
    row.clear();
    for (const Edge& e : edges) {
      if ((e.a.y() > z) == (e.b.y() > z)) continue;
      const double t = (z - e.a.y()) / (e.b.y() - e.a.y());
      row.push_back({e.a.x() + t * (e.b.x() - e.a.x()), e.b.y() > e.a.y() ? -1 : 1});
    }
    std::sort(row.begin(), row.end(),
              [](const Crossing& a, const Crossing& b) { return a.y < b.y; });
    std::size_t next = 0;
    int winding = 0;
    for (int j = 0; j < n_y_; ++j) {
      const double y = box_.lower.x() + spacing_ * j;
      while (next < row.size() && row[next].y < y) winding += row[next++].turn;
      double& d = nodes_[static_cast<std::size_t>(k) * n_y_ + j];
      if (winding != 0) d = -d;
    }
  }
}

bool DistanceTable::find_cell(const Vec2& x, Cell& cell) const {
  const double u = (x.x() - box_.lower.x()) / spacing_, v = (x.y() - box_.lower.y()) / spacing_;
  if (!(u >= 0 && v >= 0 && u <= n_y_ - 1 && v <= n_z_ - 1)) return false;
  const int j = std::min(static_cast<int>(u), n_y_ - 2),
            k = std::min(static_cast<int>(v), n_z_ - 2);
  cell = {&nodes_[static_cast<std::size_t>(k) * n_y_ + j], u - j, v - k};
  return true;
}

double DistanceTable::value(const Vec2& x) const {
  Cell c;
  if (!find_cell(x, c)) return margin_ + (x - x.cwiseMax(box_.lower).cwiseMin(box_.upper)).norm();
  const double low = c.corner[0] + c.s * (c.corner[1] - c.corner[0]);
  const double high = c.corner[n_y_] + c.s * (c.corner[n_y_ + 1] - c.corner[n_y_]);
  return low + c.t * (high - low);
}

Vec2 DistanceTable::gradient(const Vec2& x) const {
  Cell c;
  if (!find_cell(x, c)) {
    const Vec2 away = x - x.cwiseMax(box_.lower).cwiseMin(box_.upper);
    return away / away.norm();
  }
  const double a = c.corner[0], b = c.corner[1], d = c.corner[n_y_], e = c.corner[n_y_ + 1];
  return Vec2((b - a) + c.t * ((e - d) - (b - a)), (d - a) + c.s * ((e - b) - (d - a))) / spacing_;
}

}  // namespace seaway::hull
