#include "core/hull/surface_hull.hpp"

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

}  // namespace seaway::hull
