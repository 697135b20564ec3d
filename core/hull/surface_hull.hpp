// A ship's hull as the flow solver sees it: distances from a table, exact volumes from its closed
// surface. Const after construction, thread-safe. Patches may outlive the hull.
#pragma once

#include <memory>
#include <vector>

#include "core/hull/distance_grid.hpp"
#include "core/hull/surface_tree.hpp"

namespace seaway::hull {

class SurfaceHull final : public Hull<3> {
 public:
  /// surface  closed (find_surface_problems gives nothing), else Error(invalid_argument)
  /// spacing  of the distance table [m]: half the finest cell, at least
  ///          DistanceGrid::finest_spacing
  /// margin   reach of the table beyond the hull [m]
  SurfaceHull(Surface surface, double spacing, double margin);

  double signed_distance(const Vec3& x) const override { return table_->value(x); }
  Vec3 distance_gradient(const Vec3& x) const override { return table_->gradient(x); }
  std::unique_ptr<HullPatch<3>> patch(const OrientedBox<3>& block) const override;
  Box<3> bounds() const override { return bounds_; }
  int compartment_at(const Vec3&) const override { return -1; }
  int n_compartments() const override { return 0; }

 private:
  Box<3> bounds_;
  std::vector<std::shared_ptr<const SurfaceTree>> solids_;
  std::shared_ptr<const DistanceGrid> table_;
};

}  // namespace seaway::hull
