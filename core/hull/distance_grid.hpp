// Signed distance to the walls of a hull in three dimensions, tabulated on a grid fixed to it.
//
// Nodes hold the exact distance to the nearest triangle (> 0 in water and air, also inside
// compartments; < 0 in solid), in between it is trilinear. As a distance never changes faster than
// its argument, the interpolated value is nowhere wrong by more than 0.87 spacings; along flat
// walls it is exact. Farther than max(6 spacings, margin / 5 + 4 spacings) from the walls only
// every third node (beyond twice that, every seventh) is exact and those between are linear.
// Farther than `margin` nodes hold a lower bound that is at least the margin. Nodes are single
// precision. Const after construction, thread-safe.
#pragma once

#include <vector>

#include "core/hull/surface_tree.hpp"

namespace seaway::hull {

class DistanceGrid {
 public:
  /// spacing  of the nodes [m]: half the finest cell is enough
  /// margin   how far distances are exact and the table reaches beyond the surface [m]
  /// Throws Error(invalid_argument) if either is not positive or the table would exceed 2.5e7
  /// nodes (1e8 bytes; see finest_spacing). DTMB 5415 at 1:51, 5 mm, 0.1 m: 9 million nodes.
  DistanceGrid(const SurfaceTree& walls, double spacing, double margin);

  /// Smallest spacing that the table's size allows for a hull of these bounds.
  static double finest_spacing(const Box<3>& bounds, double margin);

  /// Distance [m]. Outside the table a lower bound of it that is at least the margin.
  double value(const Vec3& x) const;
  /// Gradient of the trilinear interpolant; outside the table the direction away from it.
  Vec3 gradient(const Vec3& x) const;

  double spacing() const { return spacing_; }
  double margin() const { return margin_; }
  /// Bound of |value(x) - distance(x)| inside the table where |value| < margin [m].
  double error_bound() const { return 0.87 * spacing_; }
  const IVec<3>& n_nodes() const { return n_; }

 private:
  class Filler;
  struct Cell {
    const float* corner;
    double s[3];  ///< position in the cell, 0..1
  };
  bool find_cell(const Vec3& x, Cell& cell) const;
  bool set_signs(const Surface& walls, double shift_y, double shift_z);
  Vec3 node(int i, int j, int k) const { return box_.lower + spacing_ * Vec3(i, j, k); }

  double spacing_, margin_;
  double exact_;  ///< nodes are exact up to this distance from the walls [m]
  Box<3> box_;
  IVec<3> n_{};
  std::size_t step_y_ = 0, step_z_ = 0;
  std::vector<float> nodes_;  // x fastest
};

}  // namespace seaway::hull
