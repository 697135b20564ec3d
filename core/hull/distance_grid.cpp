#include "core/hull/distance_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"

namespace seaway::hull {

namespace {

constexpr double most_nodes = 2.5e7;

}  // namespace

/// Bricks of nodes are halved down to single ones; each hands down only the triangles that are not
/// farther from its middle than the nearest one by its size.
class DistanceGrid::Filler {
 public:
  Filler(DistanceGrid& grid, const SurfaceTree& walls) : g_(grid), walls_(walls) {}

  void run() {
    double limit = 1e300;  // from the brick before: the next one cannot be much farther
    for (int k = 0; k < g_.n_[2]; k += largest)
      for (int j = 0; j < g_.n_[1]; j += largest)
        for (int i = 0; i < g_.n_[0]; i += largest) {
          const Brick brick = brick_at(i, j, k, largest);
          const double nearest = walls_.distance(brick.middle, i == 0 ? 1e300 : limit);
          limit = 1.0001 * (nearest + largest * g_.spacing_);
          if (nearest > g_.margin_ + brick.reach) {
            fill_far(brick, nearest);
            continue;
          }
          auto& list = lists_[0];
          list.clear();
          walls_.find_in_column({brick.middle, Vec3::Constant(nearest + 2 * brick.reach),
                                 Eigen::Matrix3d::Identity()},
                                -1, list);
          squares_[0].assign(list.size(), 0.0);
          split(brick, 0, brick.middle);
        }
  }

 private:
  static constexpr int largest = 16, n_levels = 6;
  struct Brick {
    int i, j, k, size;
    Vec3 middle;
    double reach;  ///< from the middle to its corner nodes
  };
  Brick brick_at(int i, int j, int k, int size) const {
    const double half = 0.5 * (size - 1);
    return {i,
            j,
            k,
            size,
            g_.node(i, j, k) + Vec3::Constant(half * g_.spacing_),
            std::sqrt(3.0) * half * g_.spacing_};
  }
  float& at(int i, int j, int k) {
    return g_.nodes_[static_cast<std::size_t>(k) * g_.step_z_ +
                     static_cast<std::size_t>(j) * g_.step_y_ + static_cast<std::size_t>(i)];
  }
  void fill_far(const Brick& b, double nearest) {
    for (int k = b.k; k < std::min(b.k + b.size, g_.n_[2]); ++k)
      for (int j = b.j; j < std::min(b.j + b.size, g_.n_[1]); ++j)
        for (int i = b.i; i < std::min(b.i + b.size, g_.n_[0]); ++i)
          at(i, j, k) = static_cast<float>(nearest - (g_.node(i, j, k) - b.middle).norm());
  }
  double distance2(int triangle, const Vec3& x) const {
    const Surface& s = walls_.surface();
    const auto& t = s.triangles[triangle];
    return squared_distance_to_triangle(x, s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]);
  }
  /// The nodes of a brick of two a side; squares_[level] are from its middle.
  void fill_last(const Brick& b, int level) {
    const auto& list = lists_[static_cast<std::size_t>(level)];
    const auto& d2 = squares_[static_cast<std::size_t>(level)];
    for (int c = 0; c < 8; ++c) {
      const int i = b.i + (c & 1), j = b.j + ((c >> 1) & 1), k = b.k + (c >> 2);
      if (i >= g_.n_[0] || j >= g_.n_[1] || k >= g_.n_[2]) continue;
      const Vec3 x = g_.node(i, j, k);
      double best = distance2(list[0], x);
      double reach = std::sqrt(best) + b.reach, reach2 = reach * reach;
      for (std::size_t n = 1; n < list.size(); ++n) {
        if (d2[n] >= reach2) continue;  // then it is farther from the node than `best`
        const double d = distance2(list[n], x);
        if (d >= best) continue;
        best = d;
        reach = std::sqrt(best) + b.reach;
        reach2 = reach * reach;
      }
      at(i, j, k) = static_cast<float>(std::sqrt(best));
    }
  }
  /// Far from the walls: exact at the corner nodes, linear between them.
  void fill_linear(const Brick& b, int level) {
    const double last = b.size - 1;
    double corner[8];
    for (int c = 0; c < 8; ++c) {
      const Vec3 x =
          g_.node(b.i, b.j, b.k) + last * g_.spacing_ * Vec3(c & 1, (c >> 1) & 1, c >> 2);
      double best = std::numeric_limits<double>::infinity();
      for (const int t : lists_[static_cast<std::size_t>(level)])
        best = std::min(best, distance2(t, x));
      corner[c] = std::sqrt(best);
    }
    const auto mix = [](double t, double p, double q) { return p + t * (q - p); };
    for (int k = 0; k < std::min(b.size, g_.n_[2] - b.k); ++k)
      for (int j = 0; j < std::min(b.size, g_.n_[1] - b.j); ++j)
        for (int i = 0; i < std::min(b.size, g_.n_[0] - b.i); ++i) {
          const double u = i / last, v = j / last, w = k / last;
          const double low = mix(v, mix(u, corner[0], corner[1]), mix(u, corner[2], corner[3]));
          const double high = mix(v, mix(u, corner[4], corner[5]), mix(u, corner[6], corner[7]));
          at(b.i + i, b.j + j, b.k + k) = static_cast<float>(mix(w, low, high));
        }
  }
  /// Of the triangles lists_[level], with their squares_[level] from `parent`, hands on those that
  /// can be nearest somewhere in the brick.
  void split(const Brick& b, int level, const Vec3& parent) {
    const auto l = static_cast<std::size_t>(level);
    const double slack = (b.middle - parent).norm() + 2 * b.reach;
    auto& next = lists_[l + 1];
    auto& next_d2 = squares_[l + 1];
    next.clear();
    next_d2.clear();
    double least = std::numeric_limits<double>::infinity(), bound2 = least;
    for (std::size_t n = 0; n < lists_[l].size(); ++n) {
      if (squares_[l][n] > bound2) continue;
      const double d2 = distance2(lists_[l][n], b.middle);
      next.push_back(lists_[l][n]);
      next_d2.push_back(d2);
      if (d2 >= least) continue;
      least = d2;
      bound2 = (std::sqrt(least) + slack) * (std::sqrt(least) + slack);
      std::swap(next.front(), next.back());  // the nearest first
      std::swap(next_d2.front(), next_d2.back());
    }
    const double nearest = std::sqrt(least);
    if (nearest > g_.margin_ + b.reach) return fill_far(b, nearest);
    const double within = (nearest + 2 * b.reach) * (nearest + 2 * b.reach);
    std::size_t kept = 0;
    for (std::size_t n = 0; n < next.size(); ++n) {
      if (next_d2[n] > within) continue;
      next[kept] = next[n];
      next_d2[kept++] = next_d2[n];
    }
    next.resize(kept);
    next_d2.resize(kept);
    if (b.size > 2 && b.size <= 8 && nearest - b.reach > g_.exact_ * (b.size / 4))
      return fill_linear(b, level + 1);
    if (b.size == 2) return fill_last(b, level + 1);
    const int half = b.size / 2;
    for (int c = 0; c < 8; ++c) {
      const int i = b.i + (c & 1) * half, j = b.j + ((c >> 1) & 1) * half,
                k = b.k + (c >> 2) * half;
      if (i < g_.n_[0] && j < g_.n_[1] && k < g_.n_[2])
        split(brick_at(i, j, k, half), level + 1, b.middle);
    }
  }

  DistanceGrid& g_;
  const SurfaceTree& walls_;
  std::vector<int> lists_[n_levels];
  std::vector<double> squares_[n_levels];
};

double DistanceGrid::finest_spacing(const Box<3>& bounds, double margin) {
  const Vec3 size = bounds.upper - bounds.lower + Vec3::Constant(2 * margin);
  double spacing = std::cbrt(size.prod() / most_nodes);
  for (int i = 0; i < 50; ++i)  // two more nodes an axis
    spacing = std::cbrt((size + Vec3::Constant(3 * spacing)).prod() / most_nodes);
  return 1.001 * spacing;
}

DistanceGrid::DistanceGrid(const SurfaceTree& walls, double spacing, double margin)
    : spacing_(spacing),
      margin_(margin),
      exact_(std::max(6 * spacing, 0.2 * margin + 4 * spacing)) {
  SEAWAY_CHECK(std::isfinite(spacing) && spacing > 0 && std::isfinite(margin) && margin > 0,
               "distance table with spacing {} m and margin {} m; both must be positive", spacing,
               margin);
  const Box<3> bounds = bounds_of(walls.surface());
  SEAWAY_CHECK(spacing >= 0.999 * finest_spacing(bounds, margin),
               "distance table of {} x {} x {} m with spacing {} m exceeds 25 million nodes; use a "
               "spacing of {} m or a smaller margin",
               bounds.upper.x() - bounds.lower.x() + 2 * margin,
               bounds.upper.y() - bounds.lower.y() + 2 * margin,
               bounds.upper.z() - bounds.lower.z() + 2 * margin, spacing,
               finest_spacing(bounds, margin));
  box_.lower = bounds.lower.array() - margin;
  for (int a = 0; a < 3; ++a)
    n_[a] = static_cast<int>(std::ceil((bounds.upper[a] + margin - box_.lower[a]) / spacing)) + 1;
  box_.upper = box_.lower + spacing * Vec3(n_[0] - 1, n_[1] - 1, n_[2] - 1);
  step_y_ = static_cast<std::size_t>(n_[0]);
  step_z_ = step_y_ * static_cast<std::size_t>(n_[1]);
  nodes_.resize(step_z_ * static_cast<std::size_t>(n_[2]));
  Filler(*this, walls).run();
  bool ok = false;  // grid lines through edges of triangles may miscount: move them a little
  for (int i = 1; i < 20 && !ok; ++i)
    ok = set_signs(walls.surface(), 1.3e-7 * i * spacing, 0.7e-7 * i * i * spacing);
  if (!ok) fail(ErrorCode::invalid_argument, "the hull's surface is not closed: no inside found");
}

/// Winding number along lines in x. False if a line leaves the hull with a number other than 0.
bool DistanceGrid::set_signs(const Surface& walls, double shift_y, double shift_z) {
  struct Crossing {
    int line;
    float turn;
    double x;
  };
  std::vector<Crossing> crossings;
  const double y0 = box_.lower.y() + shift_y, z0 = box_.lower.z() + shift_z;
  for (const auto& t : walls.triangles) {
    const Vec3 &a = walls.vertices[t[0]], &b = walls.vertices[t[1]], &c = walls.vertices[t[2]];
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    const int j0 = std::max(0, static_cast<int>(std::ceil((low.y() - y0) / spacing_))),
              j1 = std::min(n_[1] - 1, static_cast<int>(std::floor((high.y() - y0) / spacing_))),
              k0 = std::max(0, static_cast<int>(std::ceil((low.z() - z0) / spacing_))),
              k1 = std::min(n_[2] - 1, static_cast<int>(std::floor((high.z() - z0) / spacing_)));
    const auto side = [](const Vec3& p, const Vec3& q, double y, double z) {
      return (q.y() - p.y()) * (z - p.z()) - (q.z() - p.z()) * (y - p.y());
    };
    for (int k = k0; k <= k1; ++k)
      for (int j = j0; j <= j1; ++j) {
        const double y = y0 + spacing_ * j, z = z0 + spacing_ * k;
        const double wa = side(b, c, y, z), wb = side(c, a, y, z), wc = side(a, b, y, z);
        const bool left = wa > 0 && wb > 0 && wc > 0, right = wa < 0 && wb < 0 && wc < 0;
        if (!left && !right) continue;
        const double x = (wa * a.x() + wb * b.x() + wc * c.x()) / (wa + wb + wc);
        crossings.push_back({k * n_[1] + j, left ? -1.0f : 1.0f, x});
      }
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& p, const Crossing& q) {
    return p.line != q.line ? p.line < q.line : p.x < q.x;
  });
  std::vector<std::size_t> begin(static_cast<std::size_t>(n_[1]) * n_[2] + 1, 0);
  for (std::size_t i = 0; i < crossings.size();) {  // check every line before any sign is set
    float sum = 0;
    const int line = crossings[i].line;
    for (; i < crossings.size() && crossings[i].line == line; ++i) sum += crossings[i].turn;
    if (sum != 0) return false;
    begin[static_cast<std::size_t>(line) + 1] = i;
  }
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] = std::max(begin[i], begin[i - 1]);
  for (std::size_t line = 0; line + 1 < begin.size(); ++line) {
    std::size_t next = begin[line];
    if (next == begin[line + 1]) continue;
    float* row = &nodes_[line * step_y_];
    float winding = 0;
    for (int i = 0; i < n_[0]; ++i) {
      const double x = box_.lower.x() + spacing_ * i;
      while (next < begin[line + 1] && crossings[next].x < x) winding += crossings[next++].turn;
      if (winding != 0) row[i] = -row[i];
    }
  }
  return true;
}

bool DistanceGrid::find_cell(const Vec3& x, Cell& cell) const {
  const double scale = 1 / spacing_;
  std::size_t at = 0;
  const std::size_t step[3] = {1, step_y_, step_z_};
  for (int a = 0; a < 3; ++a) {
    const double u = (x[a] - box_.lower[a]) * scale;
    if (!(u >= 0 && u <= n_[a] - 1)) return false;
    const int i = std::min(static_cast<int>(u), n_[a] - 2);
    cell.s[a] = u - i;
    at += static_cast<std::size_t>(i) * step[a];
  }
  cell.corner = &nodes_[at];
  return true;
}

double DistanceGrid::value(const Vec3& x) const {
  Cell c;
  if (!find_cell(x, c)) return margin_ + (x - x.cwiseMax(box_.lower).cwiseMin(box_.upper)).norm();
  const auto along = [&](std::size_t i) {
    const double a = c.corner[i], b = c.corner[i + 1];
    return a + c.s[0] * (b - a);
  };
  const double p = along(0), q = along(step_y_), r = along(step_z_), t = along(step_y_ + step_z_);
  const double low = p + c.s[1] * (q - p), high = r + c.s[1] * (t - r);
  return low + c.s[2] * (high - low);
}

Vec3 DistanceGrid::gradient(const Vec3& x) const {
  Cell c;
  if (!find_cell(x, c)) {
    const Vec3 away = x - x.cwiseMax(box_.lower).cwiseMin(box_.upper);
    return away / away.norm();
  }
  double g[3] = {0, 0, 0};
  for (int corner = 0; corner < 8; ++corner) {
    const int b[3] = {corner & 1, (corner >> 1) & 1, corner >> 2};
    const double value = c.corner[(b[0] ? 1 : 0) + (b[1] ? step_y_ : 0) + (b[2] ? step_z_ : 0)];
    const auto part = [&](int a) { return b[a] ? c.s[a] : 1 - c.s[a]; };
    g[0] += (b[0] ? value : -value) * part(1) * part(2);
    g[1] += (b[1] ? value : -value) * part(0) * part(2);
    g[2] += (b[2] ? value : -value) * part(0) * part(1);
  }
  return Vec3(g[0], g[1], g[2]) / spacing_;
}

}  // namespace seaway::hull
