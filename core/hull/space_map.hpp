// Connected spaces of points, tabulated on a grid fixed to the hull: which cells of the grid lie wholly in one space. A point
// in another cell has to be asked for itself. Const after construction, thread-safe.
#pragma once

#include <functional>
#include <vector>

#include "core/hull/hull.hpp"

namespace seaway::hull {

class SpaceMap {
 public:
  /// The space that all points within `radius` of x have in common, or `unknown`.
  using Common = std::function<int(const Vec3& x, double radius)>;
  static constexpr int unknown = -2;

  SpaceMap() = default;
  /// `spacing` of the grid [m]; made larger where the box would need more than 4 million cells.
  SpaceMap(const Box<3>& box, double spacing, const Common& common);

  /// The space at x, or `unknown`: near a wall, outside the box.
  int at(const Vec3& x) const;

 private:
  void fill(const IVec<3>& first, int size, const Common& common);

  Box<3> box_{Vec3::Zero(), Vec3::Zero()};
  double spacing_ = 1;
  IVec<3> n_{};
  std::vector<signed char> spaces_;
};

}  // namespace seaway::hull
