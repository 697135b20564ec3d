// Bounding-box tree over the triangles of a closed surface: which triangles can meet a column or
// lie near a point. Const after construction, thread-safe.
#pragma once

#include <vector>

#include "core/hull/surface.hpp"

namespace seaway::hull {

class SurfaceTree {
 public:
  /// Before: `surface` is closed (find_surface_problems). `weight`: density of the solid.
  explicit SurfaceTree(Surface surface, double weight = 1);

  const Surface& surface() const { return surface_; }
  const std::vector<std::array<int, 3>>& neighbours() const { return neighbours_; }
  double weight() const { return weight_; }

  struct Node {
    Vec3 centre, half;
    int left;        ///< children left and left + 1; -1: a leaf
    int begin, end;  ///< triangles order()[begin] .. order()[end - 1]
  };
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<int>& order() const { return order_; }

  /// Triangles whose boxes meet the column: the box (centre, half along the columns of `axes`)
  /// without end along axis `open` (-1: the box itself). Appended to `out`; may hold a few more.
  void find_in_column(const OrientedBox<3>& box, int open, std::vector<int>& out) const;

  /// Closest distance of x from the surface [m] if below `limit`, else `limit`; `triangle` gets
  /// the one that is closest.
  double distance(const Vec3& x, double limit, int* triangle = nullptr) const;

  /// Whether the surface encloses x: crossings of a ray, counted with their sign. Points on the
  /// surface: either answer.
  bool contains(const Vec3& x) const;

 private:
  int crossings(const Vec3& x, const Vec3& direction) const;
  void build(int node, int begin, int end, std::vector<Vec3>& centroids);

  Surface surface_;
  double weight_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<Node> nodes_;
  std::vector<int> order_;
};

/// Square of the distance of x from the triangle abc [m2].
double squared_distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace seaway::hull
