// Interface transport alone: a shape of water in the unit box, carried by a given velocity until it should be where it began.
#pragma once

#include <functional>
#include <vector>

#include "core/base/vec.hpp"
#include "tests/validation/results.hpp"

namespace seaway::validation {

template <int Dim>
struct CarriedShape {
  std::function<bool(const Vec<Dim>&)> inside;
  int samples = 16;  ///< samples^Dim points of a cell say how full it is at the start
  /// Mean of the velocity along an axis over the face of edges h with its middle at x, at time t; solenoidal over cells.
  std::function<double(const Vec<Dim>& x, const Vec<Dim>& h, int axis, double t)> velocity;
  double duration = 1;
  double formal_order = 1;
};

/// Carries the shape on meshes of so many equal cells along an edge (whole blocks), in sub-steps of a Courant number of at
/// most 0.4. Reports shape_error_N (sum of |vof - vof_start| over the shape's volume), volume_change (relative) and overshoot
/// (largest vof above 1 or below 0), both at most 1e-11, and the grid convergence. Returns the errors mesh by mesh.
template <int Dim>
std::vector<double> carry_on_meshes(const CarriedShape<Dim>& shape, const std::vector<int>& meshes, int threads, Results& results);

}  // namespace seaway::validation
