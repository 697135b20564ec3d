// Where the mesh of a stage is fine: a stage's mesh rule as boxes with a wanted cell each. Used by the mesh
// itself and by the estimate of its cost. Pure functions, thread-safe.
#pragma once

#include <optional>
#include <vector>

#include "core/hull/hull.hpp"
#include "core/mesh/refinement.hpp"
#include "core/sim/case.hpp"

namespace seaway::sim {

/// What the mesh rules need to know of the hull at the start of the run.
template <int Dim>
struct HullPlace {
  hull::Box<Dim> bounds;                ///< hull axes
  Vec<Dim> cog = Vec<Dim>::Zero();      ///< in hull axes [m]
  Vec<Dim> start = Vec<Dim>::Zero();    ///< of the cog, earth axes [m]
  double draft = 0;                     ///< [m]
};

/// Root blocks of a case's tank.
template <int Dim>
mesh::TankGrid<Dim> tank_grid(const Case& c);

/// Boxes in earth axes: the region that the hull's bounding box sweeps in roll and heave, bands about the
/// calm level (infinite where they have no end), boxes at fixed places.
template <int Dim>
std::vector<mesh::RefinedBox<Dim>> refined_regions(const MeshRule& rule, const std::optional<HullPlace<Dim>>& hull);

}  // namespace seaway::sim
