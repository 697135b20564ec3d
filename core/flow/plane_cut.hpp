// The part of an interface plane inside its cell, for pictures: in index space, the cell is the unit cube.
// Pure functions.
#pragma once

#include <array>
#include <vector>

#include "core/flow/plic.hpp"

namespace seaway::flow {

/// Corners of the piece of normal . x = d inside the unit square (2, the ends of a line) or cube (3 to 6, in
/// order around it). Empty if the plane misses it or only touches it.
std::vector<std::array<double, 2>> cut_unit_cell(const Plane<2>& plane);
std::vector<std::array<double, 3>> cut_unit_cell(const Plane<3>& plane);

/// The line that a plane makes on the section of the cube across `axis` at `at` (0..1): the other two axes in
/// their order.
inline Plane<2> section_of(const Plane<3>& plane, std::size_t axis, double at) {
  Plane<2> out;
  std::size_t k = 0;
  for (std::size_t a = 0; a < 3; ++a)
    if (a != axis) out.normal[k++] = plane.normal[a];
  out.d = plane.d - plane.normal[axis] * at;
  return out;
}

}  // namespace seaway::flow
