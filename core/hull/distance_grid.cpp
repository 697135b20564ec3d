#include "core/hull/distance_grid.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace seaway::hull {

namespace {

constexpr double most_nodes = 2.5e7;
constexpr int brick = 4;  // nodes along an edge of the group that shares its list of triangles

}  // namespace

double DistanceGrid::finest_spacing(const Box<3>& bounds, double margin) {
  const Vec3 size = bounds.upper - bounds.lower + Vec3::Constant(2 * margin);
  double spacing = std::cbrt(size.prod() / most_nodes);
  for (int i = 0; i < 50; ++i)  // two more nodes an axis
    spacing = std::cbrt((size + Vec3::Constant(3 * spacing)).prod() / most_nodes);
  return 1.001 * spacing;
}

DistanceGrid::DistanceGrid(const SurfaceTree& walls, double spacing, double margin)
    : spacing_(spacing), margin_(margin) {
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
  fill_distances(walls);
  bool ok = false;  // grid lines through edges of triangles may miscount: move them a little
  for (int i = 1; i < 20 && !ok; ++i)
    ok = set_signs(walls.surface(), 1.3e-7 * i * spacing, 0.7e-7 * i * i * spacing);
  if (!ok) fail(ErrorCode::invalid_argument, "the hull's surface is not closed: no inside found");
}

void DistanceGrid::fill_distances(const SurfaceTree& walls) {
  const Surface& s = walls.surface();
  const double reach = 0.5 * std::sqrt(3.0) * (brick - 1) * spacing_;
  struct Near {
    double at_centre;
    const Vec3 *a, *b, *c;
  };
  std::vector<Near> near;
  std::vector<int> found;
  double limit = 1e300;  // distance at the last brick: the next one cannot be much farther
  for (int k0 = 0; k0 < n_[2]; k0 += brick)
    for (int j0 = 0; j0 < n_[1]; j0 += brick) {
      limit = 1e300;
      for (int i0 = 0; i0 < n_[0]; i0 += brick) {
        const Vec3 centre =
            box_.lower + spacing_ * (Vec3(i0, j0, k0).array() + 0.5 * (brick - 1)).matrix();
        const double nearest = walls.distance(centre, limit);
        limit = 1.0001 * (nearest + brick * spacing_);
        const int i1 = std::min(i0 + brick, n_[0]), j1 = std::min(j0 + brick, n_[1]),
                  k1 = std::min(k0 + brick, n_[2]);
        const auto for_nodes = [&](const auto& value) {
          for (int k = k0; k < k1; ++k)
            for (int j = j0; j < j1; ++j)
              for (int i = i0; i < i1; ++i)
                nodes_[static_cast<std::size_t>(k) * step_z_ +
                       static_cast<std::size_t>(j) * step_y_ + static_cast<std::size_t>(i)] =
                    static_cast<float>(value(node(i, j, k)));
        };
        if (nearest > margin_ + reach) {
          for_nodes([&](const Vec3& x) { return nearest - (x - centre).norm(); });
          continue;
        }
        // Only triangles that are not farther than the nearest one by the brick's size can matter.
        found.clear();
        near.clear();
        const double within = nearest + 2 * reach;
        walls.find_in_column({centre, Vec3::Constant(within), Eigen::Matrix3d::Identity()}, -1,
                             found);
        for (const int t : found) {
          const auto& v = s.triangles[t];
          const Vec3 &a = s.vertices[v[0]], &b = s.vertices[v[1]], &c = s.vertices[v[2]];
          const double d = std::sqrt(squared_distance_to_triangle(centre, a, b, c));
          if (d <= within) near.push_back({d, &a, &b, &c});
        }
        std::sort(near.begin(), near.end(),
                  [](const Near& p, const Near& q) { return p.at_centre < q.at_centre; });
        for_nodes([&](const Vec3& x) {
          const double r = (x - centre).norm();
          double best = 1e300, best2 = 1e300;
          for (const Near& t : near) {
            if (t.at_centre - r > best) break;
            const double d2 = squared_distance_to_triangle(x, *t.a, *t.b, *t.c);
            if (d2 < best2) {
              best2 = d2;
              best = std::sqrt(d2);
            }
          }
          return best;
        });
      }
    }
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
