// The damaged midship section in beam waves, as in the example case.
#pragma once

#include <limits>
#include <tuple>

#include "core/sim/case.hpp"

namespace seaway::sim {

inline Compartment wing(const char* name, double side) {
  const auto extent = [side](double y0, double y1, double z0, double z1) {
    return std::pair{Vec3(0, side > 0 ? y0 : -y1, z0), Vec3(0, side > 0 ? y1 : -y0, z1)};
  };
  Compartment c;
  c.name = name;
  std::tie(c.lower, c.upper) = extent(0.1145, 0.210, 0.020, 0.280);
  c.wall_thickness = 0.020;
  c.openings.resize(2);
  c.openings[0].name = "damage";
  std::tie(c.openings[0].lower, c.openings[0].upper) = extent(0.140, 0.210, 0.070, 0.100);
  c.openings[1].name = "vent";
  std::tie(c.openings[1].lower, c.openings[1].upper) = extent(0.130, 0.160, 0.270, 0.310);
  return c;
}

inline Stage stage(const char* name, double hull, double band, double within) {
  Stage s;
  s.name = name;
  s.mesh.hull_cell = hull;
  s.mesh.surface = {{band, 0.09, within}};
  s.end.kind = EndRule::Kind::converged;
  return s;
}

inline Case damaged_section_in_waves() {
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  Case c;
  c.title = "DTMB 5415 midship section, two flooded wings, beam waves";
  c.folder = SEAWAY_EXAMPLES;
  c.tank.lower = {0, -9.6, -2.79};
  c.tank.upper = {0, 9.6, 1.05};
  c.base_cell = 0.16;
  c.wave.kind = Wave::Kind::regular;
  c.wave.height = 0.061;
  c.wave.period = 1.4;
  c.zones.generation_length = 1.6;
  c.zones.absorption_length = 3.2;
  c.hull.shape = Hull::Shape::offsets_section;
  c.hull.offsets_file = "dtmb5415_offsets.csv";
  c.hull.station = 71.0;
  c.hull.scale = 51.0;
  c.hull.extend_to = 0.30;
  c.hull.compartments = {wing("port_wing", 1), wing("starboard_wing", -1)};
  c.body.mass = 36.70;
  c.body.cog = {0, 0, 0.100};
  c.body.gyradii = {0.12, 0, 0};
  c.body.free = {Dof::heave, Dof::roll};
  c.body.release = Body::Release::converged;
  c.stages = {stage("A", 0.010, 0.020, everywhere), stage("B", 0.010, 0.010, everywhere),
              stage("C", 0.005, 0.005, 4.6)};
  return c;
}

}  // namespace seaway::sim
