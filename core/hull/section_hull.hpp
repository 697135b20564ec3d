// A hull section as the flow solver sees it: distances from a table, exact areas from its polygons.
// Const after construction, thread-safe. Patches may outlive the hull.
#pragma once

#include <memory>
#include <vector>

#include "core/hull/distance_table.hpp"
#include "core/hull/section_shape.hpp"

namespace seaway::hull {

class SectionHull final : public Hull<2> {
 public:
  /// spacing  of the distance table [m]: half the finest cell
  /// margin   reach of the table beyond the hull [m]
  /// Throws as DistanceTable. A table of 0.9 x 0.8 m at 2.5 mm takes about 0.05 s and 1 MB.
  /// opening_reach  how far opening_part extends each opening along its thinnest direction [m]
  SectionHull(Section section, double spacing, double margin = 0.25, double opening_reach = 0);

  double signed_distance(const Vec2& x) const override { return table_->value(x); }
  Vec2 distance_gradient(const Vec2& x) const override { return table_->gradient(x); }
  /// Queries of a patch must lie inside the upright box around `block`; what reaches out of it is
  /// seen as fluid. They may have other axes than the block.
  std::unique_ptr<HullPatch<2>> patch(const OrientedBox<2>& block) const override;
  Box<2> bounds() const override { return bounds_; }
  /// A point in an opening belongs to no compartment (-1), nor does one inside a wall.
  int compartment_at(const Vec2& x) const override;
  int n_compartments() const override { return static_cast<int>(section_.compartments.size()); }
  Box<2> compartment_bounds() const override;

  bool has_porous_space() const override {
    for (const auto& c : section_.compartments)
      if (c.permeability < 1) return true;
    return false;
  }
  int space_near(const Vec2& x) const override;
  const Section& section() const { return section_; }

 private:
  Section section_;
  Box<2> bounds_;
  std::vector<Box<2>> compartment_bounds_;
  std::vector<Box<2>> opening_boxes_, extended_;
  std::shared_ptr<const DistanceTable> table_;
};

}  // namespace seaway::hull
