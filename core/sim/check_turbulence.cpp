// Turbulence model, walls of the hull and of the tank.
#include <array>
#include <set>
#include <string>

#include "core/sim/findings.hpp"

namespace seaway::sim {
namespace {

void check_walls(CheckState& s) {
  const Turbulence& t = s.c.turbulence;
  Findings& f = s.findings;
  const bool laminar = !t.has_k_epsilon();
  if (t.walls == Turbulence::Walls::slip) return;
  const bool law = t.walls != Turbulence::Walls::no_slip;
  if (law && laminar)
    f.error("turbulence.walls", "a wall function was asked for without a turbulence model; it bridges a turbulent layer",
            "use model: stabilised, or walls: no_slip");
  if (!law && !laminar)
    f.error("turbulence.walls", "no_slip was asked for with k-epsilon, which does not hold in the sublayer at a wall",
            "use walls: wall_function or non_equilibrium, or model: laminar");
  if (!s.c.fluids.viscous)
    f.error("turbulence.walls", "friction was asked for with fluids.viscous: false", "remove one of them");
  if (!s.has_hull())
    f.warning("turbulence.walls", "has no effect without a hull: the tank's sides have their own, tank.no_slip",
              "remove it");
}

void check_tank_sides(CheckState& s) {
  constexpr std::array<const char*, 3> names{"x", "y", "z"};
  std::set<std::pair<int, bool>> seen;
  for (std::size_t i = 0; i < s.c.tank.no_slip.size(); ++i) {
    const Tank::NoSlip& side = s.c.tank.no_slip[i];
    const std::string field = fmt::format("tank.no_slip[{}]", i);
    Findings& f = s.findings;
    if (side.axis < s.first_axis() || side.axis > 2) {
      f.error(field + ".side", "this side does not exist in 2-D", "remove it");
      continue;
    }
    if (!seen.insert({side.axis, side.upper}).second)
      f.error(field + ".side", "is given twice", "give each side once");
    if (s.c.tank.periodic[static_cast<std::size_t>(side.axis)])
      f.error(field + ".side", fmt::format("the tank is periodic along {}: it has no wall there",
                                           names[static_cast<std::size_t>(side.axis)]), "remove it");
    if (side.axis == 2 && side.upper && s.c.tank.open_top)
      f.error(field + ".side", "the lid is open", "write open_top: false, or remove it");
    for (int a = s.first_axis(); a < 3; ++a) {
      const std::string component = fmt::format("{}.velocity_{}_m_per_s", field, names[static_cast<std::size_t>(a)]);
      if (f.finite(component, side.velocity[a]) && a == side.axis && side.velocity[a] != 0)
        f.error(component, "a wall can only move along itself", "remove it");
    }
    if (!s.c.fluids.viscous) f.error(field, "no-slip was asked for with fluids.viscous: false", "remove one of them");
  }
}

}  // namespace

void check_turbulence(CheckState& s) {
  const Turbulence& t = s.c.turbulence;
  Findings& f = s.findings;
  check_tank_sides(s);
  check_walls(s);
  if (!t.has_k_epsilon()) {
    if (t.buoyancy)
      f.error("turbulence.buoyancy", "there is no turbulence that it could damp", "give a model, or remove it");
    return;
  }
  f.above_to("turbulence.intensity", t.intensity, 0, 1);
  f.not_negative("turbulence.velocity_m_per_s", t.velocity);
  f.positive("turbulence.length_scale_m", t.length_scale);
  if (t.velocity == 0 && s.c.wave.kind == Wave::Kind::none)
    f.error("turbulence.velocity_m_per_s", "is needed in calm water: the intensity has nothing to refer to",
            "give a speed of the flow, for example that of the bilge");
  if (!s.c.fluids.viscous)
    f.error("turbulence.model", "a turbulence model was asked for with fluids.viscous: false", "remove one of them");
  if (t.model == Turbulence::Model::standard && s.c.wave.kind != Wave::Kind::none)
    f.warning("turbulence.model", "standard k-epsilon grows without bound under waves and takes their height",
              "use stabilised, unless that growth is what you want to see");
}

}  // namespace seaway::sim
