#include "core/hull/section_hull.hpp"

#include "core/hull/section_patch.hpp"

namespace seaway::hull {

namespace {

std::vector<Polygon> walls_of(const Section& section) {
  std::vector<Polygon> walls;
  for (const WeightedLoop& loop : section.solid)
    if (loop.weight == 1.0) walls.push_back(loop.points);
  return walls;
}

}  // namespace

SectionHull::SectionHull(Section section, double spacing, double margin)
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
  }
}

std::unique_ptr<HullPatch<2>> SectionHull::patch(const OrientedBox<2>& block) const {
  const Vec2 reach = block.axes.cwiseAbs() * block.half;
  const Box<2> box{block.centre - reach, block.centre + reach};
  return std::make_unique<SectionPatch>(section_.solid, box, table_);
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

}  // namespace seaway::hull
