// SPDX-License-Identifier: GPL-3.0-or-later
// Hull and body of a case.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "server/convert/case_parts.hpp"

namespace seaway::convert {
namespace {

double signed_area(const std::vector<std::array<double, 2>>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % corners.size()];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return 0.5 * twice;
}

void read_polygon(const v1::PolygonShape& m, sim::Hull& hull, Checker& check) {
  const std::string path = "hull.polygon.vertices";
  check.entries(path, m.vertices_size(), 4, 10000);
  for (const v1::Vertex& v : m.vertices()) hull.vertices.push_back({v.y_m(), v.z_m()});
  if (hull.vertices.size() < 4 || !check.ok()) return;
  if (hull.vertices.front() != hull.vertices.back()) {
    check.problem(fmt::format("{}[{}]", path, hull.vertices.size() - 1), "the outline is open: its last corner is not its first",
                  "end the list with the first corner again");
    return;
  }
  if (signed_area(hull.vertices) == 0)
    check.problem(path, "the corners enclose no area", "give the corners of a closed outline");
}

void read_length(const std::string& path, double length, int dim, sim::Hull& hull, Checker& check) {
  if (dim == 3) hull.length = check.number(path, length, positive);
  else if (length != 0) check.problem(path, "x does not exist in 2-D", "remove it");
}

/// What the shapes from a table have in common.
template <class Shape>
void read_offsets(const Shape& m, const std::string& path, sim::Hull& hull, Checker& check) {
  if (m.file().empty() || m.file().size() > 1000)
    check.problem(path + ".file", m.file().empty() ? "is missing" : "is too long", "name the table of half-breadths");
  hull.offsets_file = m.file();
  if (m.has_scale()) hull.scale = check.number(path + ".scale", m.scale(), positive);
  if (m.has_extend_to_m()) hull.extend_to = check.number(path + ".extend_to_m", m.extend_to_m(), positive);
}

void read_shape(const v1::Hull& m, int dim, sim::Hull& hull, Checker& check) {
  switch (m.shape_case()) {
    case v1::Hull::kBox:
      hull.shape = sim::Hull::Shape::box;
      hull.beam = check.number("hull.box.beam_m", m.box().beam_m(), positive);
      hull.height = check.number("hull.box.height_m", m.box().height_m(), positive);
      read_length("hull.box.length_m", m.box().length_m(), dim, hull, check);
      break;
    case v1::Hull::kRoundedBox:
      hull.shape = sim::Hull::Shape::rounded_box;
      hull.beam = check.number("hull.rounded_box.beam_m", m.rounded_box().beam_m(), positive);
      hull.height = check.number("hull.rounded_box.height_m", m.rounded_box().height_m(), positive);
      hull.corner_radius = check.number("hull.rounded_box.corner_radius_m", m.rounded_box().corner_radius_m(),
                                        {0, 0.5 * std::max(0.0, m.rounded_box().beam_m())});
      read_length("hull.rounded_box.length_m", m.rounded_box().length_m(), dim, hull, check);
      break;
    case v1::Hull::kPolygon:
      hull.shape = sim::Hull::Shape::polygon;
      read_polygon(m.polygon(), hull, check);
      break;
    case v1::Hull::kOffsetsSection:
      hull.shape = sim::Hull::Shape::offsets_section;
      read_offsets(m.offsets_section(), "hull.offsets_section", hull, check);
      hull.station = check.number("hull.offsets_section.station", m.offsets_section().station(), any_finite);
      break;
    case v1::Hull::kCylinder:
      hull.shape = sim::Hull::Shape::cylinder;
      hull.length = check.number("hull.cylinder.length_m", m.cylinder().length_m(), positive);
      hull.radius = check.number("hull.cylinder.radius_m", m.cylinder().radius_m(), positive);
      break;
    case v1::Hull::kSphere:
      hull.shape = sim::Hull::Shape::sphere;
      hull.radius = check.number("hull.sphere.radius_m", m.sphere().radius_m(), positive);
      break;
    case v1::Hull::kWigley:
      hull.shape = sim::Hull::Shape::wigley;
      hull.length = check.number("hull.wigley.length_m", m.wigley().length_m(), positive);
      hull.beam = check.number("hull.wigley.beam_m", m.wigley().beam_m(), positive);
      hull.design_draft = check.number("hull.wigley.draft_m", m.wigley().draft_m(), positive);
      hull.height = check.number("hull.wigley.height_m", m.wigley().height_m(), positive);
      if (hull.height < hull.design_draft)
        check.problem("hull.wigley.height_m", fmt::format("{} m is below the draft, {} m", hull.height, hull.design_draft),
                      "give the height of the deck above the baseline");
      break;
    case v1::Hull::kOffsetsHull:
      hull.shape = sim::Hull::Shape::offsets_hull;
      read_offsets(m.offsets_hull(), "hull.offsets_hull", hull, check);
      hull.station = check.number("hull.offsets_hull.amidships", m.offsets_hull().amidships(), any_finite);
      break;
    case v1::Hull::kStl: {
      const v1::StlShape& stl = m.stl();
      hull.shape = sim::Hull::Shape::stl;
      if (stl.file().empty() || stl.file().size() > 1000)
        check.problem("hull.stl.file", stl.file().empty() ? "is missing" : "is too long", "name the STL file");
      hull.offsets_file = stl.file();
      if (!(stl.unit_m() > 0))
        check.problem("hull.stl.unit_m", fmt::format("{} is not a unit", stl.unit_m()),
                      "an STL file does not say its unit: give the metres in it, for example 0.001");
      hull.unit = stl.unit_m();
      if (stl.has_amidships()) hull.station = check.number("hull.stl.amidships", stl.amidships(), any_finite);
      break;
    }
    case v1::Hull::SHAPE_NOT_SET:
      check.problem("hull", "has no shape",
                    dim == 2 ? "give one of box, rounded_box, polygon, offsets_section"
                             : "give one of box, rounded_box, cylinder, sphere, wigley, offsets_hull, stl");
      return;
  }
  const bool in_2d = hull.shape == sim::Hull::Shape::box || hull.shape == sim::Hull::Shape::rounded_box ||
                     hull.shape == sim::Hull::Shape::polygon || hull.shape == sim::Hull::Shape::offsets_section;
  const bool in_3d = hull.shape != sim::Hull::Shape::polygon && hull.shape != sim::Hull::Shape::offsets_section;
  if (dim == 3 && !in_3d) check.problem("hull", "this shape is a section", "use dimension 2");
  if (dim == 2 && !in_2d) check.problem("hull", "this shape is a body in space", "use dimension 3");
}

}  // namespace

void read_hull(const v1::Hull& m, int dim, sim::Hull& hull, Checker& check) {
  read_shape(m, dim, hull, check);
  check.entries("hull.compartments", m.compartments_size(), 0, 64);
  std::set<std::string> names;
  for (int i = 0; i < m.compartments_size(); ++i) {
    const v1::Compartment& from = m.compartments(i);
    const std::string path = fmt::format("hull.compartments[{}]", i);
    sim::Compartment to;
    to.name = from.name();
    check.name(path + ".name", from.name());
    if (!names.insert(from.name()).second)
      check.problem(path + ".name", fmt::format("'{}' is used twice", from.name()),
                    "give each compartment its own name");
    read_box(from.x_m(), from.y_m(), from.z_m(), path, dim, to.lower, to.upper, check);
    to.wall_thickness = check.number(path + ".wall_thickness_m", from.wall_thickness_m(), positive);
    if (from.has_permeability())
      to.permeability = check.number(path + ".permeability", from.permeability(), {0, 1, true});
    if (from.has_flooded()) to.flooded = from.flooded();
    check.entries(path + ".openings", from.openings_size(), 0, 32);
    for (int k = 0; k < from.openings_size(); ++k) {
      const v1::Opening& hole = from.openings(k);
      sim::Opening opening;
      opening.name = hole.name();
      check.line(fmt::format("{}.openings[{}].name", path, k), hole.name(), 40);
      read_box(hole.x_m(), hole.y_m(), hole.z_m(), fmt::format("{}.openings[{}]", path, k), dim, opening.lower,
               opening.upper, check);
      to.openings.push_back(std::move(opening));
    }
    hull.compartments.push_back(std::move(to));
  }
}

namespace {

void read_prescribed(const v1::Body& m, int dim, const std::set<int>& free, sim::Body& body, Checker& check) {
  check.entries("body.prescribed", m.prescribed_size(), 0, 6);
  for (int i = 0; i < m.prescribed_size(); ++i) {
    const v1::PrescribedMotion& from = m.prescribed(i);
    const std::string path = fmt::format("body.prescribed[{}]", i);
    sim::Body::Prescribed to;
    if (from.dof() == v1::DOF_UNSPECIFIED) check.problem(path + ".dof", "is missing", "name the motion, for example roll");
    if (from.dof() == v1::DOF_UNSPECIFIED || !v1::Dof_IsValid(from.dof())) continue;
    to.dof = static_cast<sim::Dof>(from.dof() - 1);
    if (!dof_exists(to.dof, dim))
      check.problem(path + ".dof", "does not exist in 2-D", "sway, heave and roll do");
    if (free.count(from.dof()) > 0)
      check.problem(path + ".dof", "is both free and prescribed", "remove it from one of them");
    const bool rotation = to.dof >= sim::Dof::roll;
    if (from.amplitude_case() !=
        (rotation ? v1::PrescribedMotion::kAmplitudeDeg : v1::PrescribedMotion::kAmplitudeM))
      check.problem(path, rotation ? "needs amplitude_deg" : "needs amplitude_m",
                    "rotations are in degrees, displacements in metres");
    to.amplitude = rotation ? from.amplitude_deg() * degree : from.amplitude_m();
    to.period = check.number(path + ".period_s", from.period_s(), positive);
    to.ramp = check.number(path + ".ramp_s", from.ramp_s(), not_negative);
    body.prescribed.push_back(to);
  }
}

void read_release(const v1::Release& m, sim::Body& body, Checker& check) {
  switch (m.when_case()) {
    case v1::Release::kAtStart:
    case v1::Release::WHEN_NOT_SET: break;
    case v1::Release::kAtTime:
      body.release = sim::Body::Release::at_time;
      body.release_time = check.number("body.release.at_time.time_s", m.at_time().time_s(), not_negative);
      break;
    case v1::Release::kConverged: {
      const v1::ReleaseConverged& r = m.converged();
      const std::string path = "body.release.converged.";
      body.release = sim::Body::Release::converged;
      if (r.has_tolerance()) body.release_tolerance = check.number(path + "tolerance", r.tolerance(), {0, 1, true});
      if (r.has_min_periods())
        body.release_min_periods = check.count(path + "min_periods", r.min_periods(), 1, 1000);
      if (r.has_max_periods() || r.has_min_periods())
        body.release_max_periods =
            check.count(path + "max_periods",
                        r.has_max_periods() ? r.max_periods()
                                            : std::max(body.release_max_periods, body.release_min_periods),
                        body.release_min_periods, 1000);
      break;
    }
  }
}

}  // namespace

void read_body(const v1::Case& message, sim::Body& body, Checker& check) {
  if (!message.has_body()) {
    if (message.has_hull()) check.problem("body", "is missing", "a hull needs body.mass and body.cog");
    return;
  }
  if (!message.has_hull()) {
    check.problem("body", "has no effect without a hull", "give a hull or remove the body");
    return;
  }
  const v1::Body& m = message.body();
  const int dim = message.dimension() == 3 ? 3 : 2;
  const auto wanted = dim == 2 ? v1::Body::kMassKgPerM : v1::Body::kMassKg;
  const std::string mass = dim == 2 ? "body.mass_kg_per_m" : "body.mass_kg";
  if (m.mass_case() != wanted)
    check.problem(mass, "is missing", dim == 2 ? "a section has a mass per metre" : "a ship has a whole mass");
  else
    body.mass = check.number(mass, dim == 2 ? m.mass_kg_per_m() : m.mass_kg(), positive);
  if (!m.has_cog()) check.problem("body.cog", "is missing", "give at least z_m, the height above the baseline (KG)");
  body.cog = read_vector(m.cog());
  body.gyradii = read_vector(m.gyradii());
  for (int axis = 0; axis < 3; ++axis)
    check.number(fmt::format("body.gyradii.{}_m", "xyz"[axis]), body.gyradii[axis], not_negative);
  std::set<int> free;
  for (int i = 0; i < m.free_size(); ++i) {
    const std::string path = fmt::format("body.free[{}]", i);
    if (m.free(i) == v1::DOF_UNSPECIFIED) check.problem(path, "names no motion", "for example roll");
    if (m.free(i) == v1::DOF_UNSPECIFIED || !v1::Dof_IsValid(m.free(i))) continue;  // Checker::finite has told the unknown ones
    const auto dof = static_cast<sim::Dof>(m.free(i) - 1);
    if (!dof_exists(dof, dim)) check.problem(path, "does not exist in 2-D", "sway, heave and roll do");
    if (!free.insert(m.free(i)).second) check.problem(path, "is given twice", "remove it");
    static constexpr std::array<const char*, 3> about{"x_m", "y_m", "z_m"};
    if (dof >= sim::Dof::roll) {
      const int axis = static_cast<int>(dof) - static_cast<int>(sim::Dof::roll);
      if (!(body.gyradii[axis] > 0))
        check.problem(fmt::format("body.gyradii.{}", about[static_cast<std::size_t>(axis)]), "is missing",
                      "a free rotation needs its radius of gyration in metres");
    }
    body.free.push_back(dof);
  }
  if (m.has_draft_m()) body.draft = check.number("body.draft_m", m.draft_m(), positive);
  body.offset = read_vector(m.offset());
  static constexpr Range half_turn{-180, 180};
  body.angles = Vec3{check.number("body.angles.roll_deg", m.angles().roll_deg(), half_turn),
                     check.number("body.angles.pitch_deg", m.angles().pitch_deg(), half_turn),
                     check.number("body.angles.yaw_deg", m.angles().yaw_deg(), half_turn)} *
                degree;
  read_prescribed(m, dim, free, body, check);
  read_release(m.release(), body, check);
}

}  // namespace seaway::convert
