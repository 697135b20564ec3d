// A patch of a hull with compartments out of patches of its parts: walls, each compartment's space,
// openings. Answers by connected space, see HullPatch.
//
// The sea is all that is neither wall nor compartment, so that the parts outside it add up: solid
// (which holds 1 - p of each porous space) plus p times each space. Const after construction,
// thread-safe.
#pragma once

#include <memory>
#include <vector>

#include "core/hull/hull.hpp"

namespace seaway::hull {

template <int Dim>
class SpacedPatch final : public HullPatch<Dim> {
 public:
  struct Space {
    std::unique_ptr<HullPatch<Dim>> patch;  ///< the space as a solid; null: far from this block
    double permeability = 1;
  };
  /// `openings`: the extended boxes as solids, or null.
  SpacedPatch(std::unique_ptr<HullPatch<Dim>> solid, std::vector<Space> spaces,
              std::unique_ptr<HullPatch<Dim>> openings)
      : solid_(std::move(solid)), spaces_(std::move(spaces)), openings_(std::move(openings)) {}

  SolidPart<Dim> solid_part(const OrientedBox<Dim>& cv) const override {
    return solid_->solid_part(cv);
  }
  double solid_volume_below(const OrientedBox<Dim>& cv,
                            const HalfSpace<Dim>& water) const override {
    return solid_->solid_volume_below(cv, water);
  }
  double solid_face_fraction(const OrientedBox<Dim>& cv, int axis, bool high) const override {
    return solid_->solid_face_fraction(cv, axis, high);
  }
  SolidPart<Dim> outside_space(const OrientedBox<Dim>& cv, int space) const override;
  double outside_space_below(const OrientedBox<Dim>& cv, const HalfSpace<Dim>& water,
                             int space) const override;
  double outside_space_face_fraction(const OrientedBox<Dim>& cv, int axis, bool high,
                                     int space) const override;
  SolidPart<Dim> opening_part(const OrientedBox<Dim>& cv) const override {
    return openings_ != nullptr ? openings_->solid_part(cv) : SolidPart<Dim>{};
  }

 private:
  std::unique_ptr<HullPatch<Dim>> solid_;
  std::vector<Space> spaces_;
  std::unique_ptr<HullPatch<Dim>> openings_;
};

/// Volume of the part of the control volume in the half space, exact.
template <int Dim>
double box_volume_below(const OrientedBox<Dim>& cv, const HalfSpace<Dim>& water);

/// `box` extended along its shortest edge by `reach` on both sides.
template <int Dim>
Box<Dim> extended_opening(Box<Dim> box, double reach) {
  int thin = 0;
  (box.upper - box.lower).minCoeff(&thin);
  box.lower[thin] -= reach;
  box.upper[thin] += reach;
  return box;
}

/// Whether the upright box meets the upright box around `block`.
template <int Dim>
bool meets(const Box<Dim>& box, const OrientedBox<Dim>& block) {
  const Vec<Dim> reach = block.axes.cwiseAbs() * block.half;
  return (box.lower.array() <= (block.centre + reach).array()).all() &&
         (box.upper.array() >= (block.centre - reach).array()).all();
}

extern template class SpacedPatch<2>;
extern template class SpacedPatch<3>;

}  // namespace seaway::hull
