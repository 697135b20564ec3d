// Closed triangle surfaces in hull axes (x forward, y port, z up) [m]: measures, checks, building.
//
// Corners of a triangle run anticlockwise seen from outside, so that normals point out of the
// solid. Measures are exact for the polyhedron (divergence theorem). Pure functions, thread-safe.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/hull/hull.hpp"

namespace seaway::hull {

struct Surface {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// A closed surface around a solid of density `weight`; a solid is a list of them, weights add.
struct WeightedSurface {
  Surface surface;
  double weight = 1;
};

using Solid = std::vector<WeightedSurface>;

/// Enclosed volume, negative if the triangles look inwards [m3].
double enclosed_volume(const Surface& s);
/// Integral of x over the enclosed volume [m4].
Vec3 volume_moment(const Surface& s);
/// Area of all triangles [m2].
double area_of(const Surface& s);
/// Smallest upright box. Before: not empty.
Box<3> bounds_of(const Surface& s);

/// x -> rotation (scale x) + shift. Before: scale > 0, rotation proper.
Surface transformed(const Surface& s, double scale, const Eigen::Matrix3d& rotation,
                    const Vec3& shift);
/// Every triangle turned round.
Surface flipped(Surface s);
/// One surface out of two that do not meet.
Surface joined(const Surface& a, const Surface& b);

struct SurfaceProblem {
  enum class Kind { empty, not_finite, bad_index, degenerate, open, orientation, inverted };
  Kind kind;
  std::string message;  ///< what and where
  std::string hint;     ///< what to do
};

/// Empty if every edge belongs to exactly two triangles in opposite sense, all numbers are finite,
/// no triangle repeats a corner and the enclosed volume is positive. At most one problem a kind.
/// Crossing triangles are not looked for here (first_crossing in boolean3.hpp).
std::vector<SurfaceProblem> find_surface_problems(const Surface& s);

/// neighbours[t][e]: triangle across the edge from corner e to e + 1. Before: closed.
std::vector<std::array<int, 3>> neighbours_of(const Surface& s);

/// Collects triangles and makes one vertex of points that fall on the same node of a raster.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(double raster = 1e-9) : raster_(raster) {}
  int vertex(const Vec3& x);
  /// Nothing if two corners are the same vertex.
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c);
  /// Cut along the shorter diagonal.
  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
  /// The quad and its mirror image at y = 0, turned round. Not all corners at y = 0.
  void mirrored_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
  Surface take() { return std::move(surface_); }

 private:
  struct Key {
    std::int64_t x, y, z;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const;
  };
  double raster_;
  Surface surface_;
  std::unordered_map<Key, int, Hash> known_;
};

}  // namespace seaway::hull
