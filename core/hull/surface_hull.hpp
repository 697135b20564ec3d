// A ship's hull as the flow solver sees it: distances from a table, exact volumes from its closed
// surfaces. Const after construction, thread-safe. Patches may outlive the hull.
#pragma once

#include <memory>
#include <vector>

#include "core/hull/distance_grid.hpp"
#include "core/hull/ship_shape.hpp"
#include "core/hull/space_map.hpp"
#include "core/hull/surface_tree.hpp"

namespace seaway::hull {

class SurfaceHull final : public Hull<3> {
 public:
  /// spacing        of the distance table [m]: half the finest cell, at least
  ///                DistanceGrid::finest_spacing. A wall thinner than it is still exact in the
  ///                patches, but the distance hardly shows it: work by connected spaces then
  /// margin         reach of the table beyond the hull [m]
  /// opening_reach  how far opening_part extends each opening along its thinnest direction [m]
  SurfaceHull(Ship ship, double spacing, double margin, double opening_reach = 0);
  /// A hull without compartments. Throws Error(invalid_argument) if the surface is not closed.
  SurfaceHull(Surface surface, double spacing, double margin);

  double signed_distance(const Vec3& x) const override { return table_->value(x); }
  Vec3 distance_gradient(const Vec3& x) const override { return table_->gradient(x); }
  std::unique_ptr<HullPatch<3>> patch(const OrientedBox<3>& block) const override;
  Box<3> bounds() const override { return bounds_; }
  /// A point in a wall's opening belongs to no compartment (-1), nor does one inside a wall.
  int compartment_at(const Vec3& x) const override;
  int n_compartments() const override { return static_cast<int>(ship_.compartments.size()); }
  Box<3> compartment_bounds() const override;
  bool has_porous_space() const override { return porous_; }
  int space_near(const Vec3& x) const override;

  const Ship& ship() const { return ship_; }

  /// Closed surfaces whose densities add up to the solid: what pictures show.
  const std::vector<std::shared_ptr<const SurfaceTree>>& solids() const { return solids_; }

 private:
  using Trees = std::vector<std::shared_ptr<const SurfaceTree>>;
  struct Space {
    Box<3> bounds;
    Trees tree;  ///< one
    double permeability;
  };
  int find_space(const Vec3& x) const;
  int common_space(const Vec3& x, double radius) const;

  Ship ship_;
  Box<3> bounds_;
  bool porous_ = false;
  Trees solids_;
  std::shared_ptr<const SurfaceTree> outer_;
  std::vector<Space> spaces_;
  Trees openings_;  ///< extended
  std::vector<Box<3>> opening_boxes_, extended_;
  std::shared_ptr<const DistanceGrid> table_;
  SpaceMap map_;
};

}  // namespace seaway::hull
