#include "core/hull/surface_cut.hpp"

#include <map>
#include <utility>

namespace seaway::hull {
namespace {

using Edge = std::pair<int, int>;  ///< lower vertex first

Edge edge_of(int a, int b) { return a < b ? Edge{a, b} : Edge{b, a}; }

}  // namespace

std::vector<std::vector<Vec3>> cut_surface(const Surface& surface, const Vec3& normal, double d) {
  std::vector<double> height;
  height.reserve(surface.vertices.size());
  for (const Vec3& x : surface.vertices) height.push_back(normal.dot(x) - d);
  const auto above = [&](int v) { return height[static_cast<std::size_t>(v)] > 0; };
  // Each crossed triangle leads from the edge where its boundary goes up through the plane to the one
  // where it comes down again.
  std::map<Edge, Edge> next;
  for (const auto& t : surface.triangles) {
    Edge up{-1, -1}, down{-1, -1};
    for (int e = 0; e < 3; ++e) {
      const int a = t[static_cast<std::size_t>(e)], b = t[static_cast<std::size_t>((e + 1) % 3)];
      if (!above(a) && above(b)) up = edge_of(a, b);
      if (above(a) && !above(b)) down = edge_of(a, b);
    }
    if (up.first >= 0) next[up] = down;
  }
  const auto point = [&](const Edge& e) {
    const double a = height[static_cast<std::size_t>(e.first)], b = height[static_cast<std::size_t>(e.second)];
    const Vec3& x = surface.vertices[static_cast<std::size_t>(e.first)];
    return Vec3(x + a / (a - b) * (surface.vertices[static_cast<std::size_t>(e.second)] - x));
  };
  std::vector<std::vector<Vec3>> loops;
  while (!next.empty()) {
    std::vector<Vec3> loop;
    for (auto at = next.begin(); at != next.end();) {
      loop.push_back(point(at->first));
      const Edge to = at->second;
      next.erase(at);
      at = next.find(to);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace seaway::hull
