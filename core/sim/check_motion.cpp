// Mass, freedom and prescribed motion of the hull; how and where it floats.
#include <cmath>
#include <set>

#include "core/hull/hydrostatics.hpp"
#include "core/motion/pose.hpp"
#include "core/sim/build_hull.hpp"
#include "core/sim/findings.hpp"
#include "core/sim/tank_sides.hpp"

namespace seaway::sim {

namespace {

bool exists(const CheckState& s, Dof dof) {
  return s.c.dim == 3 || dof == Dof::sway || dof == Dof::heave || dof == Dof::roll;
}

void check_freedoms(CheckState& s) {
  Findings& f = s.findings;
  const Body& body = s.c.body;
  std::set<Dof> seen;
  for (std::size_t i = 0; i < body.free.size(); ++i) {
    const std::string field = fmt::format("body.free[{}]", i);
    if (!exists(s, body.free[i]))
      f.error(field, fmt::format("a section has no {}", to_string(body.free[i])),
              "allowed: sway, heave, roll");
    if (!seen.insert(body.free[i]).second)
      f.error(field, fmt::format("{} is listed twice", to_string(body.free[i])),
              "list each motion once");
  }
  std::set<Dof> prescribed;
  for (std::size_t i = 0; i < body.prescribed.size(); ++i) {
    const Body::Prescribed& p = body.prescribed[i];
    const std::string field = fmt::format("body.prescribed[{}]", i);
    if (!exists(s, p.dof))
      f.error(field + ".dof", fmt::format("a section has no {}", to_string(p.dof)),
              "allowed: sway, heave, roll");
    if (s.is_free(p.dof))
      f.error(field + ".dof", fmt::format("{} is both free and prescribed", to_string(p.dof)),
              "remove it from one of them");
    if (!prescribed.insert(p.dof).second)
      f.error(field + ".dof", fmt::format("{} is prescribed twice", to_string(p.dof)),
              "keep one of them");
    f.finite(field + (p.dof >= Dof::roll ? ".amplitude_deg" : ".amplitude_m"), p.amplitude);
    f.positive(field + ".period_s", p.period);
    f.not_negative(field + ".ramp_s", p.ramp);
  }
}

void check_release(CheckState& s) {
  Findings& f = s.findings;
  const Body& body = s.c.body;
  if (body.release == Body::Release::at_time)
    f.not_negative("body.release.at_time.time_s", body.release_time);
  if (body.release != Body::Release::converged) return;
  f.above_to("body.release.converged.tolerance", body.release_tolerance, 0, 1);
  f.whole_in_range("body.release.converged.min_periods", body.release_min_periods, 1, 1000);
  f.whole_in_range("body.release.converged.max_periods", body.release_max_periods,
                   body.release_min_periods, 1000);
}

/// What the hull takes of the tank at the start, (x, y, z).
hull::Box<3> start_box(const CheckState& s) {
  const HullPlace<3>& place = *s.place;
  const auto pose = motion::make_pose<3>(
      place.start, {s.c.body.angles.x(), s.c.body.angles.y(), s.c.body.angles.z()});
  hull::Box<3> box{Vec3::Constant(1e300), Vec3::Constant(-1e300)};
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 x;
    for (int a = 0; a < 3; ++a)
      x[a] = ((corner >> a) & 1) ? place.bounds.upper[a] : place.bounds.lower[a];
    const Vec3 y = motion::to_earth<3>(pose, x - place.cog);
    box.lower = box.lower.cwiseMin(y);
    box.upper = box.upper.cwiseMax(y);
  }
  return box;
}

void check_given_draft(CheckState& s, double capacity, double afloat) {
  const Body& body = s.c.body;
  const double top = hull::bounds_of(s.section->outer).upper.y();
  if (body.draft > top)
    s.findings.error(
        "body.draft_m", fmt::format("{} m cannot float: the hull is {} m high", body.draft, top),
        "give a draft below the hull's height; to start it under water use body.offset.z_m");
  else if (body.mass > capacity)
    s.findings.warning("body.mass_kg_per_m",
                       fmt::format("{} kg/m is more than the hull can displace, {:.6g} "
                                   "kg/m: it will sink",
                                   body.mass, capacity),
                       "lower the mass if it is meant to float");
  else if (s.is_free(Dof::heave) && std::abs(body.draft - afloat) > 0.02 * afloat)
    s.findings.warning("body.draft_m",
                       fmt::format("{} m is not where it floats, {:.4g} m; heave starts with "
                                   "the difference",
                                   body.draft, afloat),
                       "leave draft_m out to start at equilibrium");
}

void fill_summary(CheckState& s, const std::vector<hull::WeightedLoop>& open, double area,
                  double draft) {
  HydrostaticsSummary& h = s.report.hydrostatics;
  const Vec2 cog = from_vec3<2>(s.c.body.cog);
  const hull::Hydrostatics water = hull::hydrostatics(open, {draft, 0.0});
  h.valid = true;
  h.mass = s.c.body.mass;
  h.displaced_volume = water.area;
  h.draft = draft;
  h.kb = water.buoyancy_centre.y();
  h.bm = water.bm;
  h.gm = hull::metacentric_height(open, {draft, 0.0}, cog);
  h.heel = hull::find_equilibrium(open, area, cog, true).at.heel;
  const auto intact =
      hull::buoyant_loops(*s.section, std::vector<bool>(s.section->compartments.size(), false));
  const hull::Equilibrium e = hull::find_equilibrium(intact, area, cog, false);
  h.intact_draft = e.at.waterline;
  h.intact_gm = e.floats ? e.gm : 0.0;
  const double gravity = s.c.fluids.gravity;
  if (h.gm > 0 && s.c.body.gyradii.x() > 0)
    h.natural_roll_period_dry = 2 * pi * s.c.body.gyradii.x() / std::sqrt(gravity * h.gm);
  if (s.is_free(Dof::roll)) s.roll_period = h.natural_roll_period_dry;
  // Added mass about as large as the mass.
  if (s.is_free(Dof::heave) && water.waterplane_breadth > 0)
    s.heave_period = 2 * pi * std::sqrt(2 * area / (gravity * water.waterplane_breadth));
}

void check_section_numbers(CheckState& s) {
  Findings& f = s.findings;
  const Body& body = s.c.body;
  f.positive("body.mass_kg_per_m", body.mass);
  f.finite("body.cog.y_m", body.cog.y());
  f.finite("body.cog.z_m", body.cog.z());
  if (s.is_free(Dof::roll))
    f.positive("body.gyradii.x_m", body.gyradii.x());
  else
    f.not_negative("body.gyradii.x_m", body.gyradii.x());
}

void check_ship_numbers(CheckState& s) {
  Findings& f = s.findings;
  const Body& body = s.c.body;
  f.positive("body.mass_kg", body.mass);
  bool positive = true;
  for (int axis = 0; axis < 3; ++axis) {
    f.finite(fmt::format("body.cog.{}_m", "xyz"[axis]), body.cog[axis]);
    positive &= f.positive(fmt::format("body.gyradii.{}_m", "xyz"[axis]), body.gyradii[axis]);
  }
  f.finite("body.offset.x_m", body.offset.x());
  f.in_range("body.angles.pitch_deg", body.angles.y() / degree, -90, 90);
  f.in_range("body.angles.yaw_deg", body.angles.z() / degree, -180, 180);
  if (!positive) return;
  const Vec3 k2 = body.gyradii.cwiseProduct(body.gyradii);
  for (int axis = 0; axis < 3; ++axis)
    if (k2[axis] > k2.sum() - k2[axis])
      f.error(fmt::format("body.gyradii.{}_m", "xyz"[axis]),
              fmt::format("{} m: its square exceeds the sum of the other two, which no body has",
                          body.gyradii[axis]),
              "check the radii of gyration; they are about the centre of gravity");
}

}  // namespace

void check_place(CheckState& s) {
  if (!s.tank_ok) return;
  const hull::Box<3> box = start_box(s);
  const Tank& tank = s.c.tank;
  for (int axis = s.first_axis(); axis < 3; ++axis) {
    const double low = tank.lower[axis], high = tank.upper[axis];
    if (box.lower[axis] > low && box.upper[axis] < high) continue;
    s.findings.error(
        fmt::format("tank.{}_m", "xyz"[axis]),
        fmt::format(
            "the hull at its start reaches from {:.4g} to {:.4g} m, outside the tank: {} to "
            "{} m",
            box.lower[axis], box.upper[axis], low, high),
        "enlarge the tank, or check the hull's size, draft and body.offset");
  }
  const auto sides = tank_sides(s.c);
  for (int axis = s.first_axis(); axis < 2; ++axis) {
    const auto& [lower, upper] = sides[static_cast<std::size_t>(axis)];
    if (tank.periodic[static_cast<std::size_t>(axis)] || lower.zone + upper.zone == 0) continue;
    const double low = tank.lower[axis] + lower.zone, high = tank.upper[axis] - upper.zone;
    if (low < high && (box.lower[axis] < low || box.upper[axis] > high))
      s.findings.error(
          "zones",
          fmt::format("the hull from {:.4g} to {:.4g} m in {} stands in a zone; free of zones: "
                      "{:.4g} to {:.4g} m",
                      box.lower[axis], box.upper[axis], axis_names[axis], low, high),
          "shorten the zones, lengthen the tank or move the hull (body.offset)");
  }
}

void check_body(CheckState& s) {
  Findings& f = s.findings;
  const Body& body = s.c.body;
  const int before = f.n_errors();
  if (!s.has_hull()) {
    if (!body.free.empty() || !body.prescribed.empty())
      f.error("body", "motions are given but there is no hull", "add a hull or remove the body");
    return;
  }
  if (s.c.dim == 2) check_section_numbers(s);
  else check_ship_numbers(s);
  f.not_negative("body.draft_m", body.draft);
  f.finite("body.offset.y_m", body.offset.y());
  f.finite("body.offset.z_m", body.offset.z());
  f.in_range("body.angles.roll_deg", body.angles.x() / degree, -180, 180);
  check_freedoms(s);
  check_release(s);
  s.body_ok = f.n_errors() == before;
}

void check_floating(CheckState& s) {
  if (!s.section || !s.body_ok || !s.fluids_ok) return;
  const Body& body = s.c.body;
  const double rho = s.c.fluids.rho_water, area = body.mass / rho;
  const auto open = hull::buoyant_loops(*s.section, open_compartments(s.c.hull));
  const auto afloat = hull::find_waterline(open, 0.0, area);
  const double capacity = rho * hull::hydrostatics(open, {1e9, 0.0}).area;
  if (body.draft > 0) {
    check_given_draft(s, capacity, afloat.value_or(0.0));
  } else if (!afloat) {
    s.findings.error(
        "body.mass_kg_per_m",
        fmt::format("{} kg/m cannot float: the hull displaces at most {:.6g} kg/m{}", body.mass,
                    capacity,
                    s.c.hull.compartments.empty() ? "" : " with its flooded compartments"),
        "lower the mass, enlarge the hull, or give body.draft_m to let it sink");
  }
  if (body.draft > 0 || afloat) {
    const double draft = body.draft > 0 ? body.draft : *afloat;
    const hull::Box<2> box = hull::bounds_of(s.section->outer);
    s.place = HullPlace<3>{{to_vec3<2>(box.lower), to_vec3<2>(box.upper)}, body.cog, body.cog, draft};
    s.place->start += body.offset - Vec3(0, 0, draft);
    check_place(s);
  }
  if (!afloat) return;
  fill_summary(s, open, area, *afloat);
  const HydrostaticsSummary& h = s.report.hydrostatics;
  if (!s.is_free(Dof::roll)) return;
  if (!(h.gm > 0))
    s.findings.warning(
        "body.cog.z_m",
        fmt::format("KG = {} m gives GM = {:.4g} m at draft {:.4g} m: upright it is not stable",
                    body.cog.z(), h.gm, h.draft),
        fmt::format("KM is {:.4g} m; lower the centre of gravity", h.kb + h.bm));
  else if (std::abs(h.heel) > 0.1 * degree)
    s.findings.warning("body.cog.y_m",
                       fmt::format("the hull does not float upright: it comes to rest at {:.3g} "
                                   "degrees of roll",
                                   h.heel / degree),
                       "start it there with body.angles.roll_deg, or balance it");
}

}  // namespace seaway::sim
