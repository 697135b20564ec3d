// Solid parts of all boxes of a lattice in one pass over the triangles of a surface.
//
// A mesh block asks for the solid part of each of its cells and of each of the control volumes around its faces. These
// tile space, so that a triangle need not be clipped again for every box above which it lies: it is split by the
// lattice's planes, each piece adds its integral to the box that holds it and its projected area to a running sum for all boxes
// below. Same integrals as in core/hull/triangle_columns.hpp, exact.
#pragma once

#include <vector>

#include "core/base/vec.hpp"

namespace seaway::hull {

/// Boxes side by side along the axes of a block; positions from the block's centre.
struct BoxLattice {
  Vec3 lower = Vec3::Zero();  ///< corner of the first box [m]
  Vec3 edge = Vec3::Ones();   ///< of a box [m]
  IVec<3> n{};                ///< boxes along each axis

  std::size_t size() const { return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]); }
  std::size_t at(const IVec<3>& i) const {
    return static_cast<std::size_t>((i[2] * n[1] + i[1]) * n[0] + i[0]);
  }
};

/// Volume of the solid in a box [m3] and its first moment about the box's centre [m4], along the block's axes.
struct BoxMoments {
  double volume = 0;
  Vec3 first = Vec3::Zero();
};

/// Adds up the pieces of triangles. Coordinates (u, v, w): u is the axis along which a triangle acts on all boxes below.
class LatticeSum {
 public:
  /// `axes`: the block's axes that are u, v, w, in cyclic order.
  LatticeSum(const BoxLattice& lattice, const std::array<int, 3>& axes);

  /// A triangle with corners (u, v, w) from the block's centre [m], of a solid of density `weight`, that looks out of it.
  void add(const double corners[3][3], double weight);

  /// Moments of every box, by BoxLattice::at. `beyond`: density of what lies above the lattice and is not made of added triangles.
  std::vector<BoxMoments> moments(double beyond) const;

 private:
  struct Piece;
  /// In units of the box's edges.
  struct Entry {
    double volume = 0, u = 0, v = 0, w = 0;  ///< of the part of the pieces' shadows in the box itself
    double area = 0, area_v = 0, area_w = 0;  ///< of the pieces, seen along u: what boxes below get over their height
  };
  void add_column(const Piece& q, int v, int w, double weight);
  static void add_area(const Piece& q, int v, int w, double weight, Entry& e);
  static void add_part(const Piece& q, int u, int v, int w, double weight, Entry& e);
  Entry& entry(int u, int v, int w) {
    return entries_[static_cast<std::size_t>((w * n_[1] + v) * (n_[0] + 1) + u)];
  }

  BoxLattice lattice_;
  std::array<int, 3> axes_;
  int n_[3];                    ///< boxes along u, v, w
  double lower_[3], scale_[3];  ///< [m], [1/m]
  std::vector<Entry> entries_;  ///< u fastest; one more at the end for pieces above the lattice
};

}  // namespace seaway::hull
