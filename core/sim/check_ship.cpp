// The hull of a ship's case: its shape and compartments, where it floats and where it is in the tank.
#include <fmt/format.h>

#include <cmath>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/sim/build_hull.hpp"
#include "core/sim/build_ship.hpp"
#include "core/sim/findings.hpp"

namespace seaway::sim {

namespace {

/// Name of a member of ShipSpec in the case file: lengths carry their unit there.
std::string case_field(const std::string& where) {
  for (const char* length : {".x", ".y", ".z", ".wall_thickness"})
    if (where.ends_with(length)) return "hull." + where + "_m";
  return "hull." + where;
}

struct Culprit {
  const char* field;
  const char* hint;
};

Culprit culprit_of(Hull::Shape shape) {
  switch (shape) {
    case Hull::Shape::offsets_hull:
      return {"hull.offsets_hull", "check the file, amidships, the scale and extend_to_m"};
    case Hull::Shape::stl:
      return {"hull.stl", "check the file and its unit"};
    case Hull::Shape::wigley:
      return {"hull.wigley", "check its sizes"};
    case Hull::Shape::cylinder:
      return {"hull.cylinder", "check its sizes"};
    case Hull::Shape::sphere:
      return {"hull.sphere", "check its size"};
    case Hull::Shape::rounded_box:
      return {"hull.rounded_box", "check its sizes"};
    case Hull::Shape::box:
      return {"hull.box", "check its sizes"};
    case Hull::Shape::polygon:
    case Hull::Shape::offsets_section:
    case Hull::Shape::none:
      break;
  }
  return {"hull", "give the shape of a ship"};
}

bool is_from_file(Hull::Shape shape) {
  return shape == Hull::Shape::offsets_hull || shape == Hull::Shape::stl;
}

void check_draft(CheckState& s, const hull::Solid& solid, double capacity, double afloat) {
  const Body& body = s.c.body;
  const double rho = s.c.fluids.rho_water;
  const double top = hull::bounds_of(s.ship->outer).upper.z();
  if (body.draft > top) {
    s.findings.error("body.draft_m", fmt::format("{} m cannot float: the hull's top is at {:.4g} m", body.draft, top),
                     "give a draft below the hull's height; to start it under water use body.offset.z_m");
  } else if (body.mass > capacity) {
    s.findings.warning(
        "body.mass_kg",
        fmt::format("{} kg is more than the hull can displace, {:.6g} kg: it will sink", body.mass, capacity),
        "lower the mass if it is meant to float");
  } else if (s.is_free(Dof::heave) && std::abs(body.draft - afloat) > 0.02 * afloat) {
    s.findings.warning(
        "body.draft_m",
        fmt::format("at {} m the hull displaces {:.5g} kg; with its mass of {:.5g} kg it floats at {:.4g} m and heave "
                    "starts with the difference",
                    body.draft, rho * hull::hydrostatics(solid, {body.draft, 0, 0}).volume, body.mass, afloat),
        fmt::format("set draft_m to {:.4g} to start at equilibrium", afloat));
  }
}

void fill_summary(CheckState& s, const hull::Solid& open, double volume, double draft) {
  HydrostaticsSummary& h = s.report.hydrostatics;
  const Body& body = s.c.body;
  const hull::ShipAttitude upright{draft, 0, 0};
  const hull::ShipHydrostatics water = hull::hydrostatics(open, upright);
  h.valid = true;
  h.mass = body.mass;
  h.displaced_volume = water.volume;
  h.draft = draft;
  h.kb = water.buoyancy_centre.z();
  h.bm = water.bm;
  h.gm = hull::metacentric_heights(water, upright, body.cog).transverse;
  h.lcb = water.buoyancy_centre.x();
  h.wetted_surface = water.wetted_surface;
  const hull::ShipEquilibrium rest = hull::find_equilibrium(open, volume, body.cog, true, true);
  h.heel = rest.at.heel;
  h.trim = rest.at.trim;
  const auto intact = hull::buoyant_surfaces(*s.ship, std::vector<bool>(s.ship->compartments.size(), false));
  const hull::ShipEquilibrium e = hull::find_equilibrium(intact, volume, body.cog, false, false);
  h.intact_draft = e.at.waterline;
  h.intact_gm = e.floats ? e.gm.transverse : 0.0;
  const double gravity = s.c.fluids.gravity;
  if (h.gm > 0 && body.gyradii.x() > 0)
    h.natural_roll_period_dry = 2 * pi * body.gyradii.x() / std::sqrt(gravity * h.gm);
  if (s.is_free(Dof::roll)) s.roll_period = h.natural_roll_period_dry;
  // Added mass about as large as the mass.
  if (s.is_free(Dof::heave) && water.waterplane_area > 0)
    s.heave_period = 2 * pi * std::sqrt(2 * volume / (gravity * water.waterplane_area));
}

void check_attitude(CheckState& s) {
  const HydrostaticsSummary& h = s.report.hydrostatics;
  const Body& body = s.c.body;
  if (s.is_free(Dof::roll) && !(h.gm > 0)) {
    s.findings.warning("body.cog.z_m",
                       fmt::format("KG = {} m gives GM = {:.4g} m at draft {:.4g} m: upright it is not stable",
                                   body.cog.z(), h.gm, h.draft),
                       fmt::format("KM is {:.4g} m; lower the centre of gravity", h.kb + h.bm));
  } else if (s.is_free(Dof::roll) && std::abs(h.heel) > 0.1 * degree) {
    s.findings.warning(
        "body.cog.y_m",
        fmt::format("the hull does not float upright: it comes to rest at {:.3g} degrees of roll", h.heel / degree),
        "start it there with body.angles.roll_deg, or balance it");
  }
  if (s.is_free(Dof::pitch) && std::abs(h.trim - body.angles.y()) > 0.1 * degree)
    s.findings.warning("body.cog.x_m",
                       fmt::format("x = {} m of the centre of gravity against LCB = {:.4g} m on even keel: the ship "
                                   "comes to rest at {:.3g} degrees of pitch",
                                   body.cog.x(), h.lcb, h.trim / degree),
                       "start it there with body.angles.pitch_deg, or balance it");
}

}  // namespace

void check_ship_hull(CheckState& s) {
  if (!s.has_hull()) {
    if (!s.c.hull.compartments.empty())
      s.findings.error("hull", "it has compartments but no shape", "give a shape");
    return;
  }
  check_compartment_use(s);
  try {
    const hull::ShipSpec spec = ship_spec(s.c.hull, s.c.folder);
    hull::Surface outer = hull::outer_surface(spec);
    const auto problems = hull::find_compartment_problems(spec, outer);
    for (const hull::ShapeProblem& p : problems) s.findings.error(case_field(p.where), p.message, p.hint);
    if (problems.empty()) s.ship = hull::build_ship(spec, std::move(outer));
  } catch (const Error& error) {
    const Culprit culprit = culprit_of(s.c.hull.shape);
    const bool no_file = error.code() == ErrorCode::not_found && is_from_file(s.c.hull.shape);
    s.findings.error(no_file ? std::string(culprit.field) + ".file" : culprit.field, error.what(), culprit.hint);
  }
}

void check_ship_floating(CheckState& s) {
  if (!s.ship || !s.body_ok || !s.fluids_ok) return;
  const Body& body = s.c.body;
  const double rho = s.c.fluids.rho_water, volume = body.mass / rho;
  const hull::Solid open = hull::buoyant_surfaces(*s.ship, open_compartments(s.c.hull));
  const auto afloat = hull::find_waterline(open, 0, 0, volume);
  const double capacity = rho * hull::hydrostatics(open, {1e9, 0, 0}).volume;
  if (body.draft > 0) {
    check_draft(s, open, capacity, afloat.value_or(0.0));
  } else if (!afloat) {
    s.findings.error("body.mass_kg",
                     fmt::format("{} kg cannot float: the hull displaces at most {:.6g} kg{}", body.mass, capacity,
                                 s.c.hull.compartments.empty() ? "" : " with its flooded compartments"),
                     "lower the mass, enlarge the hull, or give body.draft_m to let it sink");
  }
  if (const double draft = body.draft > 0 ? body.draft : afloat.value_or(0.0); draft > 0) {
    s.place =
        HullPlace<3>{hull::bounds_of(s.ship->outer), body.cog, body.cog + body.offset - Vec3(0, 0, draft), draft};
    check_place(s);
  }
  if (!afloat) return;
  fill_summary(s, open, volume, *afloat);
  check_attitude(s);
}

}  // namespace seaway::sim
