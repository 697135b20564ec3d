#include "core/hull/surface_hull.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/hull/spaced_patch.hpp"
#include "core/hull/surface_patch.hpp"

namespace seaway::hull {

namespace {

Ship bare(Surface surface) {
  const auto problems = find_surface_problems(surface);
  if (!problems.empty())
    fail(ErrorCode::invalid_argument, "{}; {}", problems[0].message, problems[0].hint);
  Ship ship;
  ship.outer = std::move(surface);
  ship.solid = {{ship.outer, 1.0}};
  return ship;
}

bool holds(const Box<3>& box, const Vec3& x) {
  return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
}

}  // namespace

SurfaceHull::SurfaceHull(Surface surface, double spacing, double margin)
    : SurfaceHull(bare(std::move(surface)), spacing, margin) {}

SurfaceHull::SurfaceHull(Ship ship, double spacing, double margin, double opening_reach)
    : ship_(std::move(ship)), bounds_(bounds_of(ship_.outer)) {
  for (const WeightedSurface& s : ship_.solid) {
    solids_.push_back(std::make_shared<SurfaceTree>(s.surface, s.weight));
    porous_ = porous_ || s.weight != 1;
  }
  outer_ =
      ship_.compartments.empty() ? solids_.front() : std::make_shared<SurfaceTree>(ship_.outer);
  for (const ShipCompartment& c : ship_.compartments) {
    spaces_.push_back(
        {bounds_of(c.space), {std::make_shared<SurfaceTree>(c.space)}, c.permeability});
    for (const Box<3>& box : c.openings) {
      opening_boxes_.push_back(box);
      extended_.push_back(extended_opening(box, opening_reach));
      openings_.push_back(std::make_shared<SurfaceTree>(surface_of(extended_.back())));
    }
  }
  table_ = std::make_shared<DistanceGrid>(*solids_.front(), spacing, margin);
  if (spaces_.empty()) return;
  Box<3> box = compartment_bounds();
  const Vec3 around = Vec3::Constant(24 * spacing);  // as far as cells of the solver ask, if they are not longer than 4 spacings
  box = {(box.lower - around).cwiseMax(bounds_.lower), (box.upper + around).cwiseMin(bounds_.upper)};
  map_ = SpaceMap(box, spacing, [this](const Vec3& x, double radius) { return common_space(x, radius); });
}

std::unique_ptr<HullPatch<3>> SurfaceHull::patch(const OrientedBox<3>& block) const {
  auto solid = std::make_unique<SurfacePatch>(solids_, block, table_, porous_);
  if (spaces_.empty()) return solid;
  std::vector<SpacedPatch<3>::Space> spaces;
  for (const Space& s : spaces_) {
    spaces.push_back({nullptr, s.permeability});
    if (meets(s.bounds, block))
      spaces.back().patch = std::make_unique<SurfacePatch>(s.tree, block, nullptr, false);
  }
  Trees near;
  for (std::size_t i = 0; i < openings_.size(); ++i)
    if (meets(extended_[i], block)) near.push_back(openings_[i]);
  std::unique_ptr<SurfacePatch> openings;
  if (!near.empty()) openings = std::make_unique<SurfacePatch>(near, block, nullptr, false);
  return std::make_unique<SpacedPatch<3>>(std::move(solid), std::move(spaces), std::move(openings));
}

Box<3> SurfaceHull::compartment_bounds() const {
  Box<3> all = Hull<3>::compartment_bounds();
  for (const Space& s : spaces_)
    all = {all.lower.cwiseMin(s.bounds.lower), all.upper.cwiseMax(s.bounds.upper)};
  return all;
}

int SurfaceHull::compartment_at(const Vec3& x) const {
  for (std::size_t i = 0; i < spaces_.size(); ++i)
    if (holds(spaces_[i].bounds, x) && spaces_[i].tree[0]->contains(x)) return static_cast<int>(i);
  return -1;
}

int SurfaceHull::space_near(const Vec3& x) const {
  if (spaces_.empty()) return 0;
  const int mapped = map_.at(x);
  return mapped != SpaceMap::unknown ? mapped : find_space(x);
}

int SurfaceHull::find_space(const Vec3& x) const {
  for (const Box<3>& box : opening_boxes_)
    if (holds(box, x)) return -1;
  const int inside = compartment_at(x);
  if (inside >= 0) return 1 + inside;
  if (!holds(bounds_, x) || !outer_->contains(x)) return 0;
  int best = 0;
  double nearest = outer_->distance(x, 1e300);
  for (std::size_t i = 0; i < spaces_.size(); ++i) {
    const double d = spaces_[i].tree[0]->distance(x, nearest);
    if (d < nearest) {
      nearest = d;
      best = static_cast<int>(i) + 1;
    }
  }
  return best;
}

/// The space of all points within `radius` of x, or SpaceMap::unknown: no wall's surface and no side of an opening's box comes
/// that near, and within solid the nearest space stays the nearest.
int SurfaceHull::common_space(const Vec3& x, double radius) const {
  for (const Box<3>& box : opening_boxes_) {
    const Vec3 inside = (x - box.lower).cwiseMin(box.upper - x);
    const double outside = (-inside).cwiseMax(0.0).norm();
    if (outside <= radius && inside.minCoeff() <= radius) return SpaceMap::unknown;
    if (outside == 0) return -1;
  }
  double nearest = outer_->distance(x, 1e300), second = 1e300;
  bool in_space = false;
  for (const Space& s : spaces_) {
    const double d = s.tree[0]->distance(x, 1e300);
    second = std::min(second, std::max(d, nearest));
    nearest = std::min(nearest, d);
    in_space = in_space || s.tree[0]->contains(x);
  }
  if (nearest <= radius) return SpaceMap::unknown;
  const bool solid = !in_space && outer_->contains(x);
  if (solid && second - nearest <= 2 * radius) return SpaceMap::unknown;
  return find_space(x);
}

}  // namespace seaway::hull
