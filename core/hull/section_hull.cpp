#include "core/hull/section_hull.hpp"

#include <cmath>
#include <limits>

#include "core/hull/section_patch.hpp"
#include "core/hull/spaced_patch.hpp"

namespace seaway::hull {

namespace {

std::vector<Polygon> walls_of(const Section& section) {
  std::vector<Polygon> walls;
  for (const WeightedLoop& loop : section.solid)
    if (loop.weight == 1.0) walls.push_back(loop.points);
  return walls;
}

bool holds(const Box<2>& box, const Vec2& x) {
  return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
}

std::vector<WeightedLoop> solid_of(const Polygons& loops) {
  std::vector<WeightedLoop> solid;
  for (const Polygon& p : loops) solid.push_back({p, 1.0});
  return solid;
}

double distance_to(const Polygons& loops, const Vec2& x) {
  double d2 = std::numeric_limits<double>::infinity();
  for (const Polygon& p : loops)
    for (std::size_t i = 0; i < p.size(); ++i)
      d2 = std::min(d2, squared_distance_to_edge(x, p[i], p[(i + 1) % p.size()]));
  return std::sqrt(d2);
}

}  // namespace

SectionHull::SectionHull(Section section, double spacing, double margin, double opening_reach)
    : section_(std::move(section)),
      bounds_(bounds_of(section_.outer)),
      table_(std::make_shared<DistanceTable>(walls_of(section_), spacing, margin)) {
  for (const CompartmentSpace& c : section_.compartments) {
    Box<2> box = bounds_of(c.space.front());
    for (const Polygon& p : c.space) {
      const Box<2> b = bounds_of(p);
      box = {box.lower.cwiseMin(b.lower), box.upper.cwiseMax(b.upper)};
    }
    compartment_bounds_.push_back(box);
    for (const Polygon& p : c.openings) {
      opening_boxes_.push_back(bounds_of(p));
      extended_.push_back(extended_opening(opening_boxes_.back(), opening_reach));
    }
  }
}

std::unique_ptr<HullPatch<2>> SectionHull::patch(const OrientedBox<2>& block) const {
  const Vec2 reach = block.axes.cwiseAbs() * block.half;
  const Box<2> box{block.centre - reach, block.centre + reach};
  auto solid = std::make_unique<SectionPatch>(section_.solid, box, table_);
  if (section_.compartments.empty()) return solid;
  std::vector<SpacedPatch<2>::Space> spaces;
  for (std::size_t i = 0; i < section_.compartments.size(); ++i) {
    const CompartmentSpace& c = section_.compartments[i];
    spaces.push_back({nullptr, c.permeability});
    if (meets(compartment_bounds_[i], block))
      spaces.back().patch = std::make_unique<SectionPatch>(solid_of(c.space), box, nullptr);
  }
  std::vector<WeightedLoop> near;
  for (const Box<2>& opening : extended_)
    if (meets(opening, block)) near.push_back({box_polygon(opening), 1.0});
  std::unique_ptr<SectionPatch> openings;
  if (!near.empty()) openings = std::make_unique<SectionPatch>(near, box, nullptr);
  return std::make_unique<SpacedPatch<2>>(std::move(solid), std::move(spaces), std::move(openings));
}

Box<2> SectionHull::compartment_bounds() const {
  Box<2> all = Hull<2>::compartment_bounds();
  for (const Box<2>& b : compartment_bounds_)
    all = {all.lower.cwiseMin(b.lower), all.upper.cwiseMax(b.upper)};
  return all;
}

int SectionHull::compartment_at(const Vec2& x) const {
  for (std::size_t i = 0; i < compartment_bounds_.size(); ++i) {
    const Box<2>& box = compartment_bounds_[i];
    const bool near =
        (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
    if (near && contains(section_.compartments[i].space, x)) return static_cast<int>(i);
  }
  return -1;
}

int SectionHull::space_near(const Vec2& x) const {
  if (section_.compartments.empty()) return 0;
  for (const Box<2>& box : opening_boxes_)
    if (holds(box, x)) return -1;
  const int inside = compartment_at(x);
  if (inside >= 0) return 1 + inside;
  if (!contains(section_.outer, x)) return 0;
  int best = 0;
  double nearest = distance_to({section_.outer}, x);
  for (std::size_t i = 0; i < section_.compartments.size(); ++i) {
    const double d = distance_to(section_.compartments[i].space, x);
    if (d < nearest) {
      nearest = d;
      best = static_cast<int>(i) + 1;
    }
  }
  return best;
}

}  // namespace seaway::hull
