// The triangles of a surface above and in a mesh block, ready for exact integrals over boxes along the block's axes.
//
// All control volumes of a block have its axes, so the triangles are turned once into grid axes
// (u, v, w) about the block's centre; u is the axis with the fewest triangles in the block's
// column. In a control volume |v| and |w| in a rectangle, a <= u <= b, the solid volume is
//
//     sum over triangles of  integral of clamp(u, a, b) dv dw  over the projected triangle
//
// signed by the side that it looks to, over the whole column along u; moments likewise with
// clamp(u)^2 / 2, v clamp(u), w clamp(u). Below a plane u <= L(v, w) the integrand is
// clamp(min(u, L), a, b). Triangles are cut to the rectangle and where the integrand kinks; then
// it is linear and integrated exactly. There is no inside or outside to decide: every integral is
// continuous in the triangles' corners, shared edges cancel, so that positions on grid planes are
// harmless and boxes that tile a region add up to it. As the surface is closed, `- a` may be added
// to the integrand: then triangles below the control volume count nothing, and those beyond the
// block act together as a whole number times the rectangle if their border does not show in it.
//
// Const after construction, thread-safe.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/hull/box_lattice.hpp"
#include "core/hull/surface_tree.hpp"

namespace seaway::hull {

/// Triangles of one solid in the column of a block.
class TriangleColumns {
 public:
  /// A control volume along the block's axes, centre from the block's centre.
  struct Cuboid {
    Vec3 centre, half;
  };
  using Moments = BoxMoments;

  /// `block`: its half edges hold the margin in which queries may lie.
  TriangleColumns(const std::vector<std::shared_ptr<const SurfaceTree>>& solids,
                  const OrientedBox<3>& block);

  bool empty() const { return triangles_.empty() && always_ == 0; }
  int n_triangles() const { return static_cast<int>(triangles_.size()); }

  Moments moments(const Cuboid& box) const;
  /// The same for all boxes of a lattice within the block.
  std::vector<Moments> moments(const BoxLattice& lattice) const;
  /// Part of the volume where normal.x <= d, x from the control volume's centre.
  double volume_below(const Cuboid& box, const Vec3& normal, double d) const;
  /// Solid area of the face on side `high` of the control volume's axis.
  double face_area(const Cuboid& box, int axis, bool high) const;

 private:
  struct Triangle {
    double x[3][3];         ///< corners, (u, v, w)
    double weight;          ///< density, negative if u runs backwards
    float low[3], high[3];  ///< bounds, rounded outwards
    signed char first_bin[2];
  };
  /// A control volume in (u, v, w).
  struct Frame {
    double centre[3], half[3];
  };
  Frame frame_of(const Cuboid& box) const;
  template <class Visit>
  void visit(const Frame& f, const Visit& act) const;
  void gather(const SurfaceTree& solid, const std::vector<int>& found, const OrientedBox<3>& block);
  void fill_bins();
  int bin_of(double x, int side) const;

  static constexpr int n_bins = 12;
  int axes_[3] = {0, 1, 2};     ///< block axes that are u, v, w
  double turn_ = 1;             ///< -1: u runs backwards
  double half_[3] = {0, 0, 0};  ///< of the block along (u, v, w)
  double always_ = 0;           ///< density of what lies beyond the block's upper end along u
  double bins_per_metre_[2] = {0, 0};
  std::vector<Triangle> triangles_;
  std::array<int, n_bins * n_bins + 1> begin_{};
  std::vector<int> members_;  ///< triangle numbers by bin
};

}  // namespace seaway::hull
