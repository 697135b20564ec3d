// The hull of a ship's case: its shape, where it floats and where it is in the tank.
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/sim/build_ship.hpp"
#include "core/sim/findings.hpp"

namespace seaway::sim {

void check_ship_hull(CheckState& s) {
  if (!s.has_hull()) {
    if (!s.c.hull.compartments.empty())
      s.findings.error("hull", "it has compartments but no shape", "give a shape");
    return;
  }
  if (!s.c.hull.compartments.empty())
    s.findings.error("hull.compartments", "this version runs ships without compartments",
                     "leave them out, or run a section (dimension 2)");
  try {
    hull::Surface surface = outer_surface(s.c.hull, s.c.folder);
    const auto problems = hull::find_surface_problems(surface);
    for (const auto& problem : problems) s.findings.error("hull", problem.message, problem.hint);
    if (problems.empty()) s.ship = std::move(surface);
  } catch (const Error& error) {
    const bool table = s.c.hull.shape == Hull::Shape::offsets_hull;
    s.findings.error(table ? "hull.offsets_hull.file" : "hull", error.what(),
                     table ? "check the file, amidships, the scale and extend_to_m" : "check its sizes");
  }
}

void check_ship_floating(CheckState& s) {
  if (!s.ship || !s.body_ok || !s.fluids_ok) return;
  const Body& body = s.c.body;
  const hull::Box<3> box = hull::bounds_of(*s.ship);
  if (!(body.draft > 0)) {
    s.findings.error("body.draft_m", "is missing", "give the draft at which the ship starts");
    return;
  }
  const double capacity = s.c.fluids.rho_water * hull::enclosed_volume(*s.ship);
  if (body.mass > capacity)
    s.findings.warning("body.mass_kg",
                       fmt::format("{} kg is more than the hull can displace, {:.6g} kg: it will sink", body.mass,
                                   capacity),
                       "lower the mass if it is meant to float");
  s.place = HullPlace<3>{box, body.cog, body.cog + body.offset - Vec3(0, 0, body.draft), body.draft};
  check_place(s);
}

}  // namespace seaway::sim
