// Signed distance to the walls of a section, tabulated on a grid fixed to the hull.
//
// Nodes hold the exact distance to the nearest edge (> 0 in water and air, also inside
// compartments; < 0 inside walls), in between it is bilinear. As a distance never changes faster
// than its argument, the interpolated value is nowhere wrong by more than 0.71 spacings, whatever
// the shape; along straight walls it is exact but for the cells that see two walls (corners,
// midlines of walls). Const after construction, thread-safe.
#pragma once

#include <vector>

#include "core/hull/polygon.hpp"

namespace seaway::hull {

class DistanceTable {
 public:
  /// spacing  of the nodes [m]; half the finest cell is enough (cost: nodes times nearby edges)
  /// margin   how far the table reaches beyond the bounds of the loops [m]
  /// Throws Error(invalid_argument) if either is not positive or the table would exceed 4e7 nodes,
  /// or if the loops have no edge.
  DistanceTable(const std::vector<Polygon>& walls, double spacing, double margin);

  /// Distance [m]. Outside the table a lower bound of it that is at least the margin.
  double value(const Vec2& x) const;
  /// Gradient of the bilinear interpolant; outside the table the direction away from it.
  Vec2 gradient(const Vec2& x) const;

  double spacing() const { return spacing_; }
  /// Bound of |value(x) - distance(x)| inside the table [m].
  double error_bound() const { return 0.71 * spacing_; }
  int n_nodes(int axis) const { return axis == 0 ? n_y_ : n_z_; }

 private:
  struct Cell {
    const double* corner;  ///< lower left node; the others at +1, +n_y, +n_y + 1
    double s, t;           ///< position in the cell, 0..1
  };
  bool find_cell(const Vec2& x, Cell& cell) const;
  void fill_distances(const std::vector<Polygon>& walls);
  void set_signs(const std::vector<Polygon>& walls);

  double spacing_, margin_;
  Box<2> box_;
  int n_y_ = 0, n_z_ = 0;
  std::vector<double> nodes_;  // y fastest
};

}  // namespace seaway::hull
