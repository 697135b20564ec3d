#include "core/hull/ship_shape.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/hull/boolean3.hpp"
#include "core/hull/stl_file.hpp"
#include "core/hull/surface_shapes.hpp"

namespace seaway::hull {

namespace {

constexpr double nothing = 1e-12;  // [m3] less than this is no volume
constexpr double touch = 1e-6;     // [m] how near an opening must come to count as touching
constexpr double largest = 1e4;    // [m] of a compartment's coordinates
constexpr const char* thinner =
    "make the wall thinner than the smallest radius of the hull there, or keep the box away from "
    "narrow parts";

Box<3> grown(const Box<3>& box) { return {box.lower.array() - touch, box.upper.array() + touch}; }

double volume_of(const Surface& s) { return enclosed_volume(s); }

Surface space_of(const ShipCompartmentSpec& c, const Surface& outer) {
  const Surface inner =
      c.wall_thickness > 0 ? shrunk_within(outer, c.box, c.wall_thickness) : outer;
  return intersect(inner, surface_of(c.box));
}

class ProblemFinder {
 public:
  ProblemFinder(const ShipSpec& spec, const Surface& outer) : spec_(spec), outer_(outer) {}

  std::vector<ShapeProblem> run() {
    for (std::size_t i = 0; i < spec_.compartments.size(); ++i) check_compartment(i);
    if (problems_.empty()) check_overlaps();
    if (problems_.empty()) {
      walls_ = outer_;
      for (const Surface& space : spaces_) walls_ = subtract(walls_, space);
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
    const ShipCompartmentSpec& c = spec_.compartments[i];
    const std::string where = fmt::format("compartments[{}]", i);
    spaces_.emplace_back();
    const auto wrong = find_number_problems<3>(where, c, touch, largest);
    problems_.insert(problems_.end(), wrong.begin(), wrong.end());
    if (!wrong.empty()) return;
    try {
      spaces_.back() = space_of(c, outer_);
    } catch (const Error& error) {
      add(where + ".wall_thickness",
          fmt::format("{} m: the space of '{}' cannot be made ({})", c.wall_thickness, c.name,
                      error.what()),
          thinner);
      return;
    }
    if (volume_of(spaces_.back()) <= nothing) {
      const Box<3> hull = bounds_of(outer_);
      add(where,
          fmt::format(
              "box {} of compartment '{}' lies outside the hull shrunk by its wall of {} m; "
              "hull: {}",
              text(c.box), c.name, c.wall_thickness, text(hull)),
          "move the box inside the hull or make the wall thinner");
      return;
    }
    if (const auto crossing = first_crossing(spaces_.back())) {
      const Surface& s = spaces_.back();
      const Vec3 at = s.vertices[s.triangles[crossing->first][0]];
      add(where + ".wall_thickness",
          fmt::format(
              "a wall of {} m is thicker than the hull's shape allows in '{}' near ({:.4g}, "
              "{:.4g}, {:.4g})",
              c.wall_thickness, c.name, at.x(), at.y(), at.z()),
          thinner);
    }
  }

  void check_overlaps() {
    for (std::size_t i = 0; i < spaces_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double common = volume_of(intersect(spaces_[i], spaces_[j]));
        if (common > nothing)
          add(fmt::format("compartments[{}]", i),
              fmt::format("'{}' overlaps compartment '{}' by {:.3g} m3", spec_.compartments[i].name,
                          spec_.compartments[j].name, common),
              "compartments may touch but not overlap");
      }
  }

  void check_opening(std::size_t i, std::size_t k) {
    const ShipCompartmentSpec& c = spec_.compartments[i];
    const ShipOpeningSpec& opening = c.openings[k];
    const std::string where = fmt::format("compartments[{}].openings[{}]", i, k);
    if (volume_of(intersect(walls_, surface_of(opening.box))) <= nothing) {
      add(where,
          fmt::format("opening '{}', box {}, touches no wall", opening.name, text(opening.box)),
          "place it across a wall of the compartment; it may reach out on both sides");
      return;
    }
    const Surface reach = surface_of(grown(opening.box));
    if (volume_of(intersect(spaces_[i], reach)) <= 0)
      add(where,
          fmt::format("opening '{}', box {}, does not reach compartment '{}'", opening.name,
                      text(opening.box), c.name),
          "make the box overlap the inside of the compartment");
    bool leads_out = volume_of(subtract(reach, outer_)) > 0;
    for (std::size_t j = 0; j < spaces_.size() && !leads_out; ++j)
      leads_out = j != i && volume_of(intersect(spaces_[j], reach)) > 0;
    if (!leads_out)
      add(where,
          fmt::format("opening '{}', box {}, leads neither out of the hull nor into another "
                      "compartment",
                      opening.name, text(opening.box)),
          "make the box reach through the whole wall");
  }

  const ShipSpec& spec_;
  const Surface& outer_;
  std::vector<Surface> spaces_;
  Surface walls_;
  std::vector<ShapeProblem> problems_;
};

}  // namespace

Surface surface_of(const Box<3>& box) {
  const Vec3 size = box.upper - box.lower, low = box.lower;
  Surface s = box_surface(size.x(), size.y(), size.z());
  for (int i = 0; i < 8; ++i)  // exactly the given numbers: boxes that touch share their planes
    for (int a = 0; a < 3; ++a) s.vertices[i][a] = (i >> a) & 1 ? box.upper[a] : low[a];
  return s;
}

namespace {

Surface described_surface(const ShipSpec& spec) {
  switch (spec.shape) {
    case ShipSpec::Shape::box:
      return box_surface(spec.length, spec.beam, spec.height);
    case ShipSpec::Shape::rounded_box:
      return spec.corner_radius > 0
                 ? rounded_box_surface(spec.length, spec.beam, spec.height, spec.corner_radius)
                 : box_surface(spec.length, spec.beam, spec.height);
    case ShipSpec::Shape::cylinder:
      return cylinder_surface(spec.length, spec.radius);
    case ShipSpec::Shape::sphere:
      return sphere_surface(spec.radius);
    case ShipSpec::Shape::wigley:
      return wigley_surface(spec.length, spec.beam, spec.design_draft, spec.height);
    case ShipSpec::Shape::offsets: {
      SEAWAY_CHECK(!spec.file.empty(), "no offsets file is named; give the table of half-breadths");
      OffsetsHullSpec offsets;
      offsets.scale = spec.scale;
      offsets.origin = spec.amidships;
      offsets.extend_to = spec.extend_to;
      return offsets_surface(read_offsets_table(spec.file), offsets);
    }
    case ShipSpec::Shape::stl: {
      Surface s = read_stl(spec.file, spec.unit);
      return transformed(s, 1.0, Eigen::Matrix3d::Identity(),
                         Vec3(-spec.amidships * spec.unit, 0, 0));
    }
  }
  fail(ErrorCode::internal, "unknown shape of a ship {}", static_cast<int>(spec.shape));
}

}  // namespace

Surface outer_surface(const ShipSpec& spec) {
  Surface outer = described_surface(spec);
  if (const auto crossing = first_crossing(outer)) {
    const Vec3 at = outer.vertices[outer.triangles[crossing->first][0]];
    fail(ErrorCode::invalid_argument,
         "the hull's surface crosses itself near ({:.4g}, {:.4g}, {:.4g}); repair it there", at.x(),
         at.y(), at.z());
  }
  return outer;
}

Surface shrunk_within(const Surface& outer, const Box<3>& box, double distance) {
  std::vector<bool> moves(outer.vertices.size(), false);
  for (const auto& t : outer.triangles) {
    Vec3 low = outer.vertices[t[0]], high = low;
    for (const int v : t) {
      low = low.cwiseMin(outer.vertices[v]);
      high = high.cwiseMax(outer.vertices[v]);
    }
    // Facets that come near the box before or after they move.
    if ((low.array() - 2 * distance > box.upper.array()).any() ||
        (high.array() + 2 * distance < box.lower.array()).any())
      continue;
    for (const int v : t) moves[static_cast<std::size_t>(v)] = true;
  }
  // Each vertex: displacement d with n.d = -distance for all facets around it, least squares
  // weighted by their angles; directions that the facets leave open do not move.
  std::vector<Eigen::Matrix3d> matrix(outer.vertices.size(), Eigen::Matrix3d::Zero());
  std::vector<Vec3> right(outer.vertices.size(), Vec3::Zero());
  for (const auto& t : outer.triangles) {
    const Vec3* x[3] = {&outer.vertices[t[0]], &outer.vertices[t[1]], &outer.vertices[t[2]]};
    const Vec3 n = (*x[1] - *x[0]).cross(*x[2] - *x[0]).normalized();
    if (!n.allFinite()) continue;
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = (*x[(i + 1) % 3] - *x[i]).normalized(),
                 b = (*x[(i + 2) % 3] - *x[i]).normalized();
      const double angle = std::acos(std::clamp(a.dot(b), -1.0, 1.0));
      matrix[t[i]] += angle * n * n.transpose();
      right[t[i]] -= angle * distance * n;
    }
  }
  Surface out = outer;
  constexpr double open_direction = 0.02;  // facets within 16 degrees count as one plane
  for (std::size_t v = 0; v < out.vertices.size(); ++v) {
    if (!moves[v]) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(matrix[v]);
    Vec3 d = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      const double value = parts.eigenvalues()[i];
      if (value < open_direction * parts.eigenvalues()[2]) continue;
      const Vec3 e = parts.eigenvectors().col(i);
      d += e.dot(right[v]) / value * e;
    }
    out.vertices[v] += d;
  }
  return out;
}

std::vector<ShapeProblem> find_compartment_problems(const ShipSpec& spec, const Surface& outer) {
  return ProblemFinder(spec, outer).run();
}

Ship build_ship(const ShipSpec& spec, Surface outer) {
  Ship ship;
  ship.outer = std::move(outer);
  for (const ShipCompartmentSpec& c : spec.compartments) {
    ShipCompartment space{c.name, c.permeability, space_of(c, ship.outer), {}, 0};
    space.volume = enclosed_volume(space.space);
    for (const ShipOpeningSpec& opening : c.openings) space.openings.push_back(opening.box);
    ship.compartments.push_back(std::move(space));
  }
  ship.solid = buoyant_surfaces(ship, std::vector<bool>(ship.compartments.size(), true));
  return ship;
}

Ship build_ship(const ShipSpec& spec) {
  Surface outer = outer_surface(spec);
  const auto problems = find_compartment_problems(spec, outer);
  if (!problems.empty())
    fail(ErrorCode::invalid_argument, "{}: {}; {}", problems[0].where, problems[0].message,
         problems[0].hint);
  return build_ship(spec, std::move(outer));
}

Solid buoyant_surfaces(const Ship& ship, const std::vector<bool>& open) {
  SEAWAY_CHECK(open.size() == ship.compartments.size(),
               "{} flags for {} compartments; one each is needed", open.size(),
               ship.compartments.size());
  Solid solid{{ship.outer, 1.0}};
  Surface& walls = solid.front().surface;
  for (std::size_t i = 0; i < open.size(); ++i)
    if (open[i]) walls = subtract(walls, ship.compartments[i].space);
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (!open[i]) continue;
    for (const Box<3>& box : ship.compartments[i].openings) {
      Surface cut = surface_of(box);
      // An opening takes away walls, never the (solid) inside of a closed compartment.
      for (std::size_t j = 0; j < open.size(); ++j)
        if (!open[j]) cut = subtract(cut, ship.compartments[j].space);
      walls = subtract(walls, cut);
    }
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    const ShipCompartment& c = ship.compartments[i];
    if (open[i] && c.permeability < 1) solid.push_back({c.space, 1.0 - c.permeability});
  }
  return solid;
}

}  // namespace seaway::hull
