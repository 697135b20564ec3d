#include "core/hull/surface_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace seaway::hull {

namespace {

constexpr int leaf_size = 4;

}  // namespace

SurfaceTree::SurfaceTree(Surface surface, double weight)
    : surface_(std::move(surface)), weight_(weight), neighbours_(neighbours_of(surface_)) {
  const int n = static_cast<int>(surface_.triangles.size());
  std::vector<Vec3> centroids;
  centroids.reserve(surface_.triangles.size());
  for (const auto& t : surface_.triangles)
    centroids.push_back(
        (surface_.vertices[t[0]] + surface_.vertices[t[1]] + surface_.vertices[t[2]]) / 3);
  order_.resize(surface_.triangles.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(surface_.triangles.size());
  nodes_.emplace_back();
  build(0, 0, n, centroids);
}

void SurfaceTree::build(int node, int begin, int end, std::vector<Vec3>& centroids) {
  Vec3 low = Vec3::Constant(1e300), high = -low, low_c = low, high_c = high;
  for (int i = begin; i < end; ++i) {
    for (const int v : surface_.triangles[order_[i]]) {
      low = low.cwiseMin(surface_.vertices[v]);
      high = high.cwiseMax(surface_.vertices[v]);
    }
    low_c = low_c.cwiseMin(centroids[order_[i]]);
    high_c = high_c.cwiseMax(centroids[order_[i]]);
  }
  nodes_[node] = {0.5 * (low + high), 0.5 * (high - low), -1, begin, end};
  if (end - begin <= leaf_size) return;
  int axis = 0;
  (high_c - low_c).maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) {
                     const double x = centroids[a][axis], y = centroids[b][axis];
                     return x < y || (x == y && a < b);
                   });
  const int left = static_cast<int>(nodes_.size());
  nodes_[node].left = left;
  nodes_.emplace_back();
  nodes_.emplace_back();
  build(left, begin, middle, centroids);
  build(left + 1, middle, end, centroids);
}

void SurfaceTree::find_in_column(const OrientedBox<3>& box, int open, std::vector<int>& out) const {
  const Eigen::Matrix3d turn = box.axes.transpose(), spread = turn.cwiseAbs();
  const auto meets = [&](const Vec3& centre, const Vec3& half) {
    const Vec3 c = turn * (centre - box.centre), h = spread * half;
    for (int a = 0; a < 3; ++a)
      if (a != open && std::abs(c[a]) > h[a] + box.half[a]) return false;
    return true;
  };
  int stack[128], n = 0;
  stack[n++] = 0;
  while (n > 0) {
    const Node& node = nodes_[stack[--n]];
    if (!meets(node.centre, node.half)) continue;
    if (node.left >= 0) {
      stack[n++] = node.left;
      stack[n++] = node.left + 1;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) out.push_back(order_[i]);
  }
}

double SurfaceTree::distance(const Vec3& x, double limit, int* triangle) const {
  double best = limit * limit;
  const auto to_node = [&](const Node& node) {
    return ((x - node.centre).cwiseAbs() - node.half).cwiseMax(0.0).squaredNorm();
  };
  int stack[128], n = 0;
  stack[n++] = 0;
  while (n > 0) {
    const Node& node = nodes_[stack[--n]];
    if (to_node(node) >= best) continue;
    if (node.left >= 0) {  // the nearer child first
      const bool left_first = to_node(nodes_[node.left]) < to_node(nodes_[node.left + 1]);
      stack[n++] = left_first ? node.left + 1 : node.left;
      stack[n++] = left_first ? node.left : node.left + 1;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const auto& t = surface_.triangles[order_[i]];
      const double d2 = squared_distance_to_triangle(
          x, surface_.vertices[t[0]], surface_.vertices[t[1]], surface_.vertices[t[2]]);
      if (d2 < best) {
        best = d2;
        if (triangle != nullptr) *triangle = order_[i];
      }
    }
  }
  return std::sqrt(best);
}

int SurfaceTree::crossings(const Vec3& x, const Vec3& direction) const {
  int sum = 0;
  int stack[128], n = 0;
  stack[n++] = 0;
  while (n > 0) {
    const Node& node = nodes_[stack[--n]];
    double t0 = 0, t1 = 1e300;
    for (int a = 0; a < 3; ++a) {  // no component of the directions below is 0
      const double inverse = 1 / direction[a];
      const double p = (node.centre[a] - node.half[a] - x[a]) * inverse,
                   q = (node.centre[a] + node.half[a] - x[a]) * inverse;
      t0 = std::max(t0, std::min(p, q));
      t1 = std::min(t1, std::max(p, q));
    }
    if (t0 > t1 * (1 + 1e-12) + 1e-12) continue;
    if (node.left >= 0) {
      stack[n++] = node.left;
      stack[n++] = node.left + 1;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const auto& t = surface_.triangles[order_[i]];
      const Vec3 a = surface_.vertices[t[0]] - x, b = surface_.vertices[t[1]] - x,
                 c = surface_.vertices[t[2]] - x;
      const double wa = direction.dot(b.cross(c)), wb = direction.dot(c.cross(a)),
                   wc = direction.dot(a.cross(b));
      const bool left = wa > 0 && wb > 0 && wc > 0, right = wa < 0 && wb < 0 && wc < 0;
      if (!left && !right) continue;
      if (a.dot((b - a).cross(c - a)) / (wa + wb + wc) < 0) continue;  // behind
      sum += left ? 1 : -1;
    }
  }
  return sum;
}

bool SurfaceTree::contains(const Vec3& x) const {
  // A ray through an edge or corner may miscount: the majority of three decides.
  static const Vec3 directions[3] = {Vec3(0.7413, 0.5219, 0.4231), Vec3(-0.3571, 0.6113, -0.7062),
                                     Vec3(0.1877, -0.8231, 0.5359)};
  const bool one = crossings(x, directions[0]) > 0, two = crossings(x, directions[1]) > 0;
  return one == two ? one : crossings(x, directions[2]) > 0;
}

// By the regions of the triangle's plane.
double squared_distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return ax.squaredNorm();
  const Vec3 bx = x - b;
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return bx.squaredNorm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ax - d1 / (d1 - d3) * ab).squaredNorm();
  const Vec3 cx = x - c;
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return cx.squaredNorm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ax - d2 / (d2 - d6) * ac).squaredNorm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return (bx - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).squaredNorm();
  const double sum = va + vb + vc;
  return sum > 0 ? (ax - vb / sum * ab - vc / sum * ac).squaredNorm()
                 : std::min({ax.squaredNorm(), bx.squaredNorm(), cx.squaredNorm()});
}

}  // namespace seaway::hull
