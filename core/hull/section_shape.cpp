#include "core/hull/section_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/hull/offsets_table.hpp"

namespace seaway::hull {

namespace {

constexpr double raster = 1e-9;  // [m] of the set operations; nearer points are the same point
constexpr double touch = 1e-7;   // [m] how near an opening must come to count as touching
constexpr double largest = 1e6;  // [m] beyond it the raster overflows
constexpr int chords_per_corner = 16;

void check_length(const char* what, double value) {
  SEAWAY_CHECK(std::isfinite(value) && value > 0,
               "{} is {}; it must be a positive length in metres", what, value);
}

Polygon rounded_box(double beam, double height, double radius) {
  SEAWAY_CHECK(
      radius >= 0 && radius <= std::min(0.5 * beam, height),
      "corner radius is {} m; allowed: 0 to the smaller of half the beam and the height, {} m",
      radius, std::min(0.5 * beam, height));
  const double y = 0.5 * beam;
  Polygon port;  // from the keel upwards
  for (int i = 0; i <= chords_per_corner; ++i) {
    const double angle = 0.5 * pi * (static_cast<double>(i) / chords_per_corner - 1.0);
    port.emplace_back(y - radius + radius * std::cos(angle), radius + radius * std::sin(angle));
  }
  port.emplace_back(y, height);
  Polygon p;
  for (const Vec2& x : port)
    if (p.empty() || (x - p.back()).norm() > raster) p.push_back(x);
  for (auto x = port.rbegin(); x != port.rend(); ++x) {
    const Vec2 mirrored(-x->x(), x->y());
    if ((mirrored - p.back()).norm() > raster) p.push_back(mirrored);
  }
  if ((p.front() - p.back()).norm() <= raster) p.pop_back();
  return p;
}

Polygon closed_polygon(const Polygon& vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    SEAWAY_CHECK(vertices[i].allFinite(),
                 "polygon corner {} is ({}, {}); both must be finite numbers", i, vertices[i].x(),
                 vertices[i].y());
  SEAWAY_CHECK(vertices.size() >= 4,
               "polygon has {} corners; at least 3 and the first one again are needed",
               vertices.size());
  SEAWAY_CHECK(
      (vertices.front() - vertices.back()).norm() <= raster,
      "polygon is open: it starts at ({}, {}) and ends at ({}, {}); repeat the first corner "
      "at the end",
      vertices.front().x(), vertices.front().y(), vertices.back().x(), vertices.back().y());
  Polygon p(vertices.begin(), vertices.end() - 1);
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    SEAWAY_CHECK((p[i + 1] - p[i]).norm() > raster,
                 "polygon corners {} and {} are the same point ({}, {}); remove one", i, i + 1,
                 p[i].x(), p[i].y());
  const Box<2> box = bounds_of(p);
  SEAWAY_CHECK(box.lower.minCoeff() > -largest && box.upper.maxCoeff() < largest,
               "polygon reaches from ({}, {}) to ({}, {}); coordinates are metres and below 1e6",
               box.lower.x(), box.lower.y(), box.upper.x(), box.upper.y());
  if (const auto crossing = first_self_intersection(p))
    fail(
        ErrorCode::invalid_argument,
        "polygon crosses or touches itself: edge {} (from corner {}) and edge {} (from corner {}); "
        "give the corners in order around the section",
        crossing->first, crossing->first, crossing->second, crossing->second);
  if (signed_area(p) < 0) std::reverse(p.begin(), p.end());
  SEAWAY_CHECK(signed_area(p) > raster, "polygon encloses {} m2; it must enclose a positive area",
               signed_area(p));
  return p;
}

Polygon offsets_polygon(const SectionSpec& spec) {
  SEAWAY_CHECK(std::isfinite(spec.scale) && spec.scale > 0, "scale is {}; it must be positive",
               spec.scale);
  SEAWAY_CHECK(std::isfinite(spec.station), "station is {}; it must be a finite number",
               spec.station);
  SEAWAY_CHECK(!spec.offsets_file.empty(),
               "no offsets file is named; give the table of half-breadths");
  const auto half = half_section_at(read_offsets_table(spec.offsets_file), spec.station);
  Polygon port;  // from the keel upwards
  for (const auto& [z, y] : half) {
    const Vec2 x(y / spec.scale, z / spec.scale);
    if (port.empty() || (x - port.back()).norm() > raster) port.push_back(x);
  }
  SEAWAY_CHECK(std::isfinite(spec.extend_to), "extend_to is {}; it must be a finite number",
               spec.extend_to);
  if (spec.extend_to != 0) {
    SEAWAY_CHECK(
        spec.extend_to > port.back().y() + raster,
        "extend_to is {} m; it must lie above the top of the section, {} m (0: no extension)",
        spec.extend_to, port.back().y());
    port.emplace_back(port.back().x(), spec.extend_to);
  }
  Polygon p = port;
  for (auto x = port.rbegin(); x != port.rend(); ++x)
    if (x->x() > raster) p.emplace_back(-x->x(), x->y());
  p.push_back(p.front());
  return closed_polygon(p);
}

Polygon grown(const Box<2>& box) {
  return box_polygon({box.lower.array() - touch, box.upper.array() + touch});
}

Polygons space_of(const CompartmentSpec& c, const Polygon& outer) {
  Polygons inner = c.wall_thickness > 0 ? shrink(outer, c.wall_thickness) : Polygons{outer};
  return intersect({box_polygon(c.box)}, inner);
}

class ProblemFinder {
 public:
  ProblemFinder(const SectionSpec& spec, const Polygon& outer) : spec_(spec), outer_(outer) {}

  std::vector<ShapeProblem> run() {
    for (std::size_t i = 0; i < spec_.compartments.size(); ++i) check_compartment(i);
    if (problems_.empty()) {
      check_overlaps();
      for (std::size_t i = 0; i < spaces_.size(); ++i)
        for (std::size_t k = 0; k < spec_.compartments[i].openings.size(); ++k) check_opening(i, k);
    }
    return std::move(problems_);
  }

 private:
  void add(std::string where, std::string message, std::string hint) {
    problems_.push_back({std::move(where), std::move(message), std::move(hint)});
  }

  void check_compartment(std::size_t i) {
    const CompartmentSpec& c = spec_.compartments[i];
    const std::string where = fmt::format("compartments[{}]", i);
    spaces_.emplace_back();
    const auto wrong = find_number_problems<2>(where, c, raster, largest);
    problems_.insert(problems_.end(), wrong.begin(), wrong.end());
    if (!wrong.empty()) return;
    spaces_.back() = space_of(c, outer_);
    if (area_of(spaces_.back()) <= raster)
      add(where,
          fmt::format("box {} of compartment '{}' lies outside the hull shrunk by its wall of "
                      "{} m; hull: {}",
                      text(c.box), c.name, c.wall_thickness, text(bounds_of(outer_))),
          "move the box inside the hull or make the wall thinner");
  }

  void check_overlaps() {
    for (std::size_t i = 0; i < spaces_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double common = area_of(intersect(spaces_[i], spaces_[j]));
        if (common > raster)
          add(fmt::format("compartments[{}]", i),
              fmt::format("'{}' overlaps compartment '{}' by {:.3g} m2", spec_.compartments[i].name,
                          spec_.compartments[j].name, common),
              "compartments may touch but not overlap");
      }
  }

  void check_opening(std::size_t i, std::size_t k) {
    const CompartmentSpec& c = spec_.compartments[i];
    const OpeningSpec& opening = c.openings[k];
    const std::string where = fmt::format("compartments[{}].openings[{}]", i, k);
    Polygons walls = {outer_};
    for (const Polygons& space : spaces_) walls = subtract(walls, space);
    if (area_of(intersect(walls, {box_polygon(opening.box)})) <= raster * raster) {
      add(where,
          fmt::format("opening '{}', box {}, touches no wall", opening.name, text(opening.box)),
          "place it across a wall of the compartment; it may reach out on both sides");
      return;
    }
    const Polygon reach = grown(opening.box);
    if (area_of(intersect(spaces_[i], {reach})) <= 0)
      add(where,
          fmt::format("opening '{}', box {}, does not reach compartment '{}'", opening.name,
                      text(opening.box), c.name),
          "make the box overlap the inside of the compartment");
    bool leads_out = area_of(subtract({reach}, {outer_})) > 2 * touch * touch;
    for (std::size_t j = 0; j < spaces_.size() && !leads_out; ++j)
      leads_out = j != i && area_of(intersect(spaces_[j], {reach})) > 0;
    if (!leads_out)
      add(where,
          fmt::format("opening '{}', box {}, leads neither out of the hull nor into another "
                      "compartment",
                      opening.name, text(opening.box)),
          "make the box reach through the whole wall");
  }

  const SectionSpec& spec_;
  const Polygon& outer_;
  std::vector<Polygons> spaces_;
  std::vector<ShapeProblem> problems_;
};

}  // namespace

Polygon outer_polygon(const SectionSpec& spec) {
  switch (spec.shape) {
    case SectionSpec::Shape::box:
      check_length("beam", spec.beam);
      check_length("height", spec.height);
      return box_polygon({{-0.5 * spec.beam, 0.0}, {0.5 * spec.beam, spec.height}});
    case SectionSpec::Shape::rounded_box:
      check_length("beam", spec.beam);
      check_length("height", spec.height);
      return rounded_box(spec.beam, spec.height, spec.corner_radius);
    case SectionSpec::Shape::polygon:
      return closed_polygon(spec.vertices);
    case SectionSpec::Shape::offsets:
      return offsets_polygon(spec);
  }
  fail(ErrorCode::internal, "unknown section shape {}", static_cast<int>(spec.shape));
}

std::vector<ShapeProblem> find_compartment_problems(const SectionSpec& spec,
                                                      const Polygon& outer) {
  return ProblemFinder(spec, outer).run();
}

Section build_section(const SectionSpec& spec) {
  Section section;
  section.outer = outer_polygon(spec);
  const auto problems = find_compartment_problems(spec, section.outer);
  if (!problems.empty())
    fail(ErrorCode::invalid_argument, "{}: {}; {}", problems[0].where, problems[0].message,
         problems[0].hint);
  for (const CompartmentSpec& c : spec.compartments) {
    CompartmentSpace space{c.name, c.permeability, space_of(c, section.outer), {}, 0};
    space.area = area_of(space.space);
    for (const OpeningSpec& opening : c.openings)
      space.openings.push_back(box_polygon(opening.box));
    section.compartments.push_back(std::move(space));
  }
  section.solid = buoyant_loops(section, std::vector<bool>(section.compartments.size(), true));
  return section;
}

std::vector<WeightedLoop> buoyant_loops(const Section& section, const std::vector<bool>& open) {
  SEAWAY_CHECK(open.size() == section.compartments.size(),
               "{} flags for {} compartments; one each is needed", open.size(),
               section.compartments.size());
  Polygons removed;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (!open[i]) continue;
    removed = unite(removed, section.compartments[i].space);
    Polygons cuts = section.compartments[i].openings;
    // An opening takes away walls, never the (solid) inside of a closed compartment.
    for (std::size_t j = 0; j < open.size(); ++j)
      if (!open[j]) cuts = subtract(cuts, section.compartments[j].space);
    removed = unite(removed, cuts);
  }
  std::vector<WeightedLoop> loops;
  if (removed.empty()) {
    loops.push_back({section.outer, 1.0});
    return loops;
  }
  for (Polygon& p : subtract({section.outer}, removed)) loops.push_back({std::move(p), 1.0});
  for (std::size_t i = 0; i < open.size(); ++i) {
    const CompartmentSpace& c = section.compartments[i];
    if (!open[i] || c.permeability >= 1) continue;
    for (const Polygon& p : c.space) loops.push_back({p, 1.0 - c.permeability});
  }
  return loops;
}

}  // namespace seaway::hull
