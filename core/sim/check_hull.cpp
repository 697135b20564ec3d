// Shape of the hull and its compartments.
#include <cmath>

#include "core/base/error.hpp"
#include "core/sim/build_hull.hpp"
#include "core/sim/findings.hpp"

namespace seaway::sim {

namespace {

/// Name of a member of SectionSpec in the case file: lengths carry their unit there.
std::string case_field(const std::string& where) {
  for (const char* length : {".y", ".z", ".wall_thickness"})
    if (where.ends_with(length)) return "hull." + where + "_m";
  return "hull." + where;
}

/// Fields of the outline that are wrong by themselves; then the geometry is not tried.
bool outline_numbers_ok(CheckState& s) {
  const Hull& hull = s.c.hull;
  Findings& f = s.findings;
  const int before = f.n_errors();
  switch (hull.shape) {
    case Hull::Shape::box:
      f.positive("hull.box.beam_m", hull.beam);
      f.positive("hull.box.height_m", hull.height);
      break;
    case Hull::Shape::rounded_box:
      f.positive("hull.rounded_box.beam_m", hull.beam);
      f.positive("hull.rounded_box.height_m", hull.height);
      f.not_negative("hull.rounded_box.corner_radius_m", hull.corner_radius);
      break;
    case Hull::Shape::offsets_section:
      if (hull.offsets_file.empty())
        f.error("hull.offsets_section.file", "no table of half-breadths is named", "name the file");
      f.finite("hull.offsets_section.station", hull.station);
      f.positive("hull.offsets_section.scale", hull.scale);
      f.not_negative("hull.offsets_section.extend_to_m", hull.extend_to);
      break;
    default:
      break;
  }
  return f.n_errors() == before;
}

struct Culprit {
  const char* field;
  const char* hint;
};

Culprit culprit_of(Hull::Shape shape) {
  switch (shape) {
    case Hull::Shape::polygon:
      return {"hull.polygon.vertices",
              "list the corners in order around the section, the first again at the end"};
    case Hull::Shape::rounded_box:
      return {"hull.rounded_box.corner_radius_m", "choose a smaller radius"};
    case Hull::Shape::offsets_section:
      return {"hull.offsets_section", "check the file, the station, the scale and extend_to_m"};
    default:
      break;
  }
  return {"hull.box", "check beam and height"};
}

}  // namespace

void check_compartment_use(CheckState& s) {
  for (std::size_t i = 0; i < s.c.hull.compartments.size(); ++i) {
    const Compartment& c = s.c.hull.compartments[i];
    const std::string field = fmt::format("hull.compartments[{}]", i);
    if (c.name.empty()) s.findings.error(field + ".name", "the compartment has no name", "name it");
    for (std::size_t j = 0; j < i; ++j)
      if (c.name == s.c.hull.compartments[j].name && !c.name.empty())
        s.findings.error(field + ".name", fmt::format("'{}' is used twice", c.name),
                         "give each compartment its own name");
    if (c.flooded && c.openings.empty())
      s.findings.warning(
          field + ".openings",
          fmt::format("'{}' is flooded but closed: it carries its water along, while the "
                      "hydrostatics count it as sea",
                      c.name),
          "add an opening, or flooded: false");
  }
}

void check_hull(CheckState& s) {
  if (!s.has_hull()) {
    if (!s.c.hull.compartments.empty())
      s.findings.error("hull", "it has compartments but no shape", "give a shape");
    return;
  }
  const bool numbers = outline_numbers_ok(s);
  check_compartment_use(s);
  if (!numbers) return;
  const hull::SectionSpec spec = section_spec(s.c.hull, s.c.folder);
  hull::Polygon outer;
  try {
    outer = hull::outer_polygon(spec);
  } catch (const Error& error) {
    const Culprit culprit = culprit_of(s.c.hull.shape);
    const bool no_file = error.code() == ErrorCode::not_found;
    s.findings.error(no_file ? "hull.offsets_section.file" : culprit.field, error.what(),
                     culprit.hint);
    return;
  }
  const auto problems = hull::find_compartment_problems(spec, outer);
  for (const hull::ShapeProblem& p : problems)
    s.findings.error(case_field(p.where), p.message, p.hint);
  if (problems.empty()) s.section = hull::build_section(spec);
}

}  // namespace seaway::sim
