// The piece of a section inside a box, ready for many exact queries by small rotated boxes.
//
// Areas come from Green's theorem in slices: in the axes (u, v) of the control volume |u| <= a,
// |v| <= b, the solid part has
//     area = closed integral of clamp(u, -a, a) dv over the boundary cut to |v| <= b,
// likewise its moments with clamp(u)^2 / 2 and v clamp(u). Each edge adds its share on its own: no
// clipped polygon is built, nothing is allocated, and the areas of boxes that tile a region add up
// to the region's whatever lies on their edges. Const after construction, thread-safe.
#pragma once

#include <memory>
#include <vector>

#include "core/hull/distance_table.hpp"
#include "core/hull/polygon.hpp"

namespace seaway::hull {

class SectionPatch final : public HullPatch<2> {
 public:
  /// `table` belongs to the walls (weight 1) among `loops` and serves to reject boxes without
  /// walls; may be null.
  SectionPatch(const std::vector<WeightedLoop>& loops, const Box<2>& box,
               std::shared_ptr<const DistanceTable> table);

  SolidPart<2> solid_part(const OrientedBox<2>& cv) const override;
  double solid_volume_below(const OrientedBox<2>& cv, const HalfSpace<2>& water) const override;
  double solid_face_fraction(const OrientedBox<2>& cv, int axis, bool high) const override;

  int n_edges() const { return static_cast<int>(points_.size() - loops_.size()); }

 private:
  struct Loop {
    int begin, end;  ///< corners points_[begin] .. points_[end - 1], the first repeated at the end
    double weight;
  };
  enum class Seen { fluid, solid, unknown };
  Seen look(const Vec2& centre, double radius) const;

  std::vector<Vec2> points_;
  std::vector<Loop> loops_;
  bool porous_ = false;  // then a box far from walls may still hold some solid
  std::shared_ptr<const DistanceTable> table_;
};

}  // namespace seaway::hull
