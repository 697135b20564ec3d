// Where the mesh is fine: a list of boxes, each with the cell it wants.
#pragma once

#include <vector>

#include "core/mesh/forest.hpp"

namespace seaway::mesh {

template <int Dim>
struct RefinedBox {
  Vec<Dim> lower, upper;  ///< [m]; may be infinite
  double cell = 0;        ///< largest cell edge across the ship wanted inside [m]
};

/// Level whose largest cell edge across the ship (y, z) is not larger than `cell` by more than 12 % (what
/// make_tank_grid may stretch), seen from root cells `base`.
template <int Dim>
int level_for_cell(const Vec<Dim>& base, double cell);

/// Splits every block that overlaps a box and whose cells are larger than the box wants.
template <int Dim>
RefineRule<Dim> refine_boxes(const TankGrid<Dim>& grid, std::vector<RefinedBox<Dim>> boxes);

/// Finest level that the boxes ask for.
template <int Dim>
int finest_level(const TankGrid<Dim>& grid, const std::vector<RefinedBox<Dim>>& boxes);

}  // namespace seaway::mesh
