// The hull of a ship's case: its shape and compartments, how it floats and where it is in the tank.
#include <fmt/format.h>

#include <cmath>

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

const char* shape_field(Hull::Shape shape) {
  switch (shape) {
    case Hull::Shape::box:
      return "hull.box";
    case Hull::Shape::rounded_box:
      return "hull.rounded_box";
    case Hull::Shape::cylinder:
      return "hull.cylinder";
    case Hull::Shape::sphere:
      return "hull.sphere";
    case Hull::Shape::wigley:
      return "hull.wigley";
    case Hull::Shape::offsets_hull:
      return "hull.offsets_hull";
    case Hull::Shape::stl:
      return "hull.stl";
    default:
      return "hull";
  }
}

void check_given_draft(CheckState& s, double afloat) {
  const Body& body = s.c.body;
  const double top = hull::bounds_of(s.ship->outer).upper.z();
  if (body.draft > top)
    s.findings.error("body.draft_m", fmt::format("{} m cannot float: the hull is {:.4g} m high", body.draft, top),
                     "give a draft below the hull's height; to start it under water use body.offset.z_m");
  else if (afloat > 0 && s.is_free(Dof::heave) && std::abs(body.draft - afloat) > 0.02 * afloat)
    s.findings.warning("body.draft_m",
                       fmt::format("{} m is not where it floats, {:.4g} m; heave starts with the difference",
                                   body.draft, afloat),
                       "leave draft_m out to start at equilibrium");
}

void fill_summary(CheckState& s, double draft) {
  HydrostaticsSummary& h = s.report.hydrostatics;
  const Vec3& cog = s.c.body.cog;
  const double volume = s.c.body.mass / s.c.fluids.rho_water;
  const auto open = hull::buoyant_surfaces(*s.ship, open_compartments(s.c.hull));
  const auto water = hull::hydrostatics(open, {draft, 0, 0});
  h.valid = true;
  h.mass = s.c.body.mass;
  h.displaced_volume = water.volume;
  h.draft = draft;
  h.kb = water.buoyancy_centre.z();
  h.bm = water.bm;
  h.gm = hull::metacentric_heights(water, {draft, 0, 0}, cog).transverse;
  h.heel = hull::find_equilibrium(open, volume, cog, true, false).at.heel;
  const auto intact = hull::buoyant_surfaces(*s.ship, std::vector<bool>(s.ship->compartments.size(), false));
  if (const auto intact_draft = hull::find_waterline(intact, 0, 0, volume)) {
    h.intact_draft = *intact_draft;
    h.intact_gm = hull::metacentric_heights(hull::hydrostatics(intact, {*intact_draft, 0, 0}),
                                            {*intact_draft, 0, 0}, cog)
                      .transverse;
  }
  if (h.gm > 0) h.natural_roll_period_dry = 2 * pi * s.c.body.gyradii.x() / std::sqrt(s.c.fluids.gravity * h.gm);
  // A ship that is held in pitch may be out of trim; a free one would swing about another attitude.
  const double lever = water.buoyancy_centre.x() - cog.x();
  if (s.is_free(Dof::pitch) && std::abs(lever) > 0.002 * (hull::bounds_of(s.ship->outer).upper.x() -
                                                          hull::bounds_of(s.ship->outer).lower.x()))
    s.findings.warning("body.cog.x_m",
                       fmt::format("{:.5g} m is {:.3g} m from the centre of buoyancy at {:.5g} m: the ship will trim",
                                   cog.x(), lever, water.buoyancy_centre.x()),
                       "give the centre of buoyancy's x, or start at the trim with body.angles.pitch_deg");
}

}  // namespace

void check_ship_hull(CheckState& s) {
  const Hull& hull = s.c.hull;
  if (!s.has_hull()) {
    if (!hull.compartments.empty()) s.findings.error("hull", "it has compartments but no shape", "give a shape");
    return;
  }
  check_compartment_use(s);
  const std::string field = shape_field(hull.shape);
  const bool from_file = hull.shape == Hull::Shape::offsets_hull || hull.shape == Hull::Shape::stl;
  try {
    const hull::ShipSpec spec = ship_spec(hull, s.c.folder);
    const hull::Surface outer = hull::outer_surface(spec);
    const auto problems = hull::find_compartment_problems(spec, outer);
    for (const auto& p : problems) s.findings.error(case_field(p.where), p.message, p.hint);
    if (problems.empty()) s.ship = hull::build_ship(spec);
  } catch (const Error& error) {
    s.findings.error(from_file && error.code() == ErrorCode::not_found ? field + ".file" : field, error.what(),
                     from_file ? "check the file, amidships and its scale or unit" : "check its sizes");
  }
}

void check_ship_floating(CheckState& s) {
  if (!s.ship || !s.body_ok || !s.fluids_ok) return;
  const Body& body = s.c.body;
  const auto open = hull::buoyant_surfaces(*s.ship, open_compartments(s.c.hull));
  const auto afloat = hull::find_waterline(open, 0, 0, body.mass / s.c.fluids.rho_water);
  const double capacity = s.c.fluids.rho_water * hull::hydrostatics(open, {1e3, 0, 0}).volume;
  if (body.draft > 0) {
    check_given_draft(s, afloat.value_or(0.0));
    if (!afloat)
      s.findings.warning("body.mass_kg",
                         fmt::format("{} kg is more than the hull can displace, {:.6g} kg: it will sink", body.mass,
                                     capacity),
                         "lower the mass if it is meant to float");
  } else if (!afloat) {
    s.findings.error("body.mass_kg",
                     fmt::format("{} kg cannot float: the hull displaces at most {:.6g} kg{}", body.mass, capacity,
                                 s.c.hull.compartments.empty() ? "" : " with its flooded compartments"),
                     "lower the mass, enlarge the hull, or give body.draft_m to let it sink");
  }
  const double draft = body.draft > 0 ? body.draft : afloat.value_or(0.0);
  if (!(draft > 0)) return;
  s.place = HullPlace<3>{hull::bounds_of(s.ship->outer), body.cog, body.cog + body.offset - Vec3(0, 0, draft), draft};
  check_place(s);
  const NaturalPeriods natural = natural_periods(s.c, *s.ship, draft);
  s.heave_period = natural.heave;
  s.roll_period = natural.roll;
  if (!afloat) return;
  fill_summary(s, *afloat);
  const HydrostaticsSummary& h = s.report.hydrostatics;
  if (s.is_free(Dof::roll) && !(h.gm > 0))
    s.findings.warning("body.cog.z_m",
                       fmt::format("KG = {} m gives GM = {:.4g} m at draft {:.4g} m: upright it is not stable",
                                   body.cog.z(), h.gm, h.draft),
                       fmt::format("KM is {:.4g} m; lower the centre of gravity", h.kb + h.bm));
}

}  // namespace seaway::sim
