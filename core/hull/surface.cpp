#include "core/hull/surface.hpp"

#include <fmt/format.h>

#include <cmath>

namespace seaway::hull {

namespace {

/// Directed edges are keyed by both vertex numbers.
std::uint64_t edge_key(int a, int b) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) |
         static_cast<std::uint32_t>(b);
}

}  // namespace

double enclosed_volume(const Surface& s) {
  if (s.vertices.empty()) return 0;
  const Vec3 o = s.vertices.front();  // near the surface: little cancellation
  double six = 0;
  for (const auto& t : s.triangles) {
    const Vec3 a = s.vertices[t[0]] - o, b = s.vertices[t[1]] - o, c = s.vertices[t[2]] - o;
    six += a.dot(b.cross(c));
  }
  return six / 6;
}

Vec3 volume_moment(const Surface& s) {
  if (s.vertices.empty()) return Vec3::Zero();
  const Vec3 o = s.vertices.front();
  Vec3 moment = Vec3::Zero();
  double six = 0;
  for (const auto& t : s.triangles) {
    const Vec3 a = s.vertices[t[0]] - o, b = s.vertices[t[1]] - o, c = s.vertices[t[2]] - o;
    const double v = a.dot(b.cross(c));
    six += v;
    moment += v * (a + b + c);  // centroid of the tetrahedron is the quarter of this
  }
  return moment / 24 + six / 6 * o;
}

double area_of(const Surface& s) {
  double twice = 0;
  for (const auto& t : s.triangles) {
    const Vec3& a = s.vertices[t[0]];
    twice += (s.vertices[t[1]] - a).cross(s.vertices[t[2]] - a).norm();
  }
  return 0.5 * twice;
}

Box<3> bounds_of(const Surface& s) {
  Box<3> box{s.vertices.front(), s.vertices.front()};
  for (const Vec3& x : s.vertices) box = {box.lower.cwiseMin(x), box.upper.cwiseMax(x)};
  return box;
}

Surface transformed(const Surface& s, double scale, const Eigen::Matrix3d& rotation,
                    const Vec3& shift) {
  Surface out = s;
  for (Vec3& x : out.vertices) x = (rotation * (scale * x) + shift).eval();
  return out;
}

Surface flipped(Surface s) {
  for (auto& t : s.triangles) std::swap(t[1], t[2]);
  return s;
}

Surface joined(const Surface& a, const Surface& b) {
  Surface out = a;
  const int first = static_cast<int>(a.vertices.size());
  out.vertices.insert(out.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles)
    out.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return out;
}

std::vector<SurfaceProblem> find_surface_problems(const Surface& s) {
  using Kind = SurfaceProblem::Kind;
  std::vector<SurfaceProblem> problems;
  const auto add = [&](Kind kind, std::string message, std::string hint) {
    for (const auto& p : problems)
      if (p.kind == kind) return;
    problems.push_back({kind, std::move(message), std::move(hint)});
  };
  if (s.triangles.size() < 4) {
    add(Kind::empty,
        fmt::format("the surface has {} triangles; a solid needs at least 4", s.triangles.size()),
        "export the whole closed hull");
    return problems;
  }
  for (std::size_t i = 0; i < s.vertices.size(); ++i)
    if (!s.vertices[i].allFinite())
      add(Kind::not_finite, fmt::format("vertex {} has a coordinate that is not a number", i),
          "repair the file where it was made");
  for (std::size_t i = 0; i < s.triangles.size(); ++i) {
    const auto& t = s.triangles[i];
    for (const int v : t)
      if (v < 0 || v >= static_cast<int>(s.vertices.size()))
        add(Kind::bad_index,
            fmt::format("triangle {} names vertex {} of {}", i, v, s.vertices.size()),
            "repair the file");
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      add(Kind::degenerate, fmt::format("triangle {} has two equal corners", i),
          "remove triangles without area");
  }
  if (!problems.empty()) return problems;

  std::unordered_map<std::uint64_t, int> edges;  // directed
  edges.reserve(3 * s.triangles.size());
  for (const auto& t : s.triangles)
    for (int e = 0; e < 3; ++e) ++edges[edge_key(t[e], t[(e + 1) % 3])];
  std::size_t n_open = 0, n_turned = 0;
  Vec3 where_open = Vec3::Zero(), where_turned = Vec3::Zero();
  for (const auto& t : s.triangles)
    for (int e = 0; e < 3; ++e) {
      const int a = t[e], b = t[(e + 1) % 3];
      const int there = edges[edge_key(a, b)];
      const auto back = edges.find(edge_key(b, a));
      const int n_back = back == edges.end() ? 0 : back->second;
      const Vec3 middle = 0.5 * (s.vertices[a] + s.vertices[b]);
      if (there == 1 && n_back == 1) continue;
      if (there == 2 && n_back == 0) {
        if (n_turned++ == 0) where_turned = middle;
      } else {
        if (n_open++ == 0) where_open = middle;
      }
    }
  if (n_open > 0)
    add(Kind::open,
        fmt::format("the surface is not closed: {} edges do not join exactly two triangles, the "
                    "first near ({:.4g}, {:.4g}, {:.4g})",
                    n_open, where_open.x(), where_open.y(), where_open.z()),
        "close the deck, the transom and all gaps, and remove inner walls and doubled faces");
  if (n_turned > 0)
    add(Kind::orientation,
        fmt::format("neighbouring triangles look to different sides at {} edges, the first near "
                    "({:.4g}, {:.4g}, {:.4g})",
                    n_turned, where_turned.x(), where_turned.y(), where_turned.z()),
        "make all normals point out of the hull");
  if (problems.empty() && !(enclosed_volume(s) > 0))
    add(Kind::inverted,
        fmt::format("the normals point inwards: enclosed volume {:.4g} m3", enclosed_volume(s)),
        "flip all normals");
  return problems;
}

std::vector<std::array<int, 3>> neighbours_of(const Surface& s) {
  std::unordered_map<std::uint64_t, int> edges;
  edges.reserve(3 * s.triangles.size());
  for (std::size_t i = 0; i < s.triangles.size(); ++i)
    for (int e = 0; e < 3; ++e)
      edges[edge_key(s.triangles[i][e], s.triangles[i][(e + 1) % 3])] = static_cast<int>(i);
  std::vector<std::array<int, 3>> out(s.triangles.size(), {-1, -1, -1});
  for (std::size_t i = 0; i < s.triangles.size(); ++i)
    for (int e = 0; e < 3; ++e) {
      const auto it = edges.find(edge_key(s.triangles[i][(e + 1) % 3], s.triangles[i][e]));
      if (it != edges.end()) out[i][e] = it->second;
    }
  return out;
}

std::size_t SurfaceBuilder::Hash::operator()(const Key& k) const {
  std::uint64_t h = 0x9e3779b97f4a7c15ULL;
  for (const std::int64_t v : {k.x, k.y, k.z}) {
    h ^= static_cast<std::uint64_t>(v);
    h *= 0xff51afd7ed558ccdULL;
    h ^= h >> 32;
  }
  return static_cast<std::size_t>(h);
}

int SurfaceBuilder::vertex(const Vec3& x) {
  const Key key{std::llround(x.x() / raster_), std::llround(x.y() / raster_),
                std::llround(x.z() / raster_)};
  const auto [it, is_new] = known_.emplace(key, static_cast<int>(surface_.vertices.size()));
  if (is_new) surface_.vertices.push_back(x);
  return it->second;
}

void SurfaceBuilder::triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const int i = vertex(a), j = vertex(b), k = vertex(c);
  if (i != j && j != k && k != i) surface_.triangles.push_back({i, j, k});
}

void SurfaceBuilder::quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if ((c - a).squaredNorm() <= (d - b).squaredNorm()) {
    triangle(a, b, c);
    triangle(a, c, d);
  } else {
    triangle(a, b, d);
    triangle(b, c, d);
  }
}

void SurfaceBuilder::mirrored_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto m = [](const Vec3& x) { return Vec3(x.x(), -x.y(), x.z()); };
  const auto flat = [](const Vec3& p, const Vec3& q, const Vec3& r) {
    return p.y() == 0 && q.y() == 0 && r.y() == 0;
  };
  // The same diagonal on both sides, and no triangle in the centre plane: it would be there twice.
  const bool ac =
      flat(a, b, d) || flat(b, c, d) ||
      ((c - a).squaredNorm() <= (d - b).squaredNorm() && !flat(a, b, c) && !flat(a, c, d));
  const auto both = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    triangle(p, q, r);
    triangle(m(p), m(r), m(q));
  };
  if (ac) {
    both(a, b, c);
    both(a, c, d);
  } else {
    both(a, b, d);
    both(b, c, d);
  }
}

}  // namespace seaway::hull
