// Hydrostatics of a section, per metre of length: buoyancy, waterplane, stability, equilibrium.
//
// The displacing solid is a list of weighted loops in hull axes. Damage is treated as lost
// buoyancy: a compartment open to the sea is simply not part of the solid (buoyant_loops in
// section_shape.hpp), so mass and centre of gravity are those of the ship without flood water. The
// water level is the same everywhere; trapped air is not considered. Exact for polygons. Pure
// functions, thread-safe.
//
// Attitude: `waterline` is the height of the calm level above the origin of the hull axes
// (baseline, centre plane), measured vertically; upright it is the draft. `heel` is the roll angle
// [rad], positive to starboard (port side up).
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/hull/polygon.hpp"

namespace seaway::hull {

struct Attitude {
  double waterline = 0;  ///< [m]
  double heel = 0;       ///< [rad]
};

struct Hydrostatics {
  double area = 0;                      ///< displaced area [m2]
  Vec2 buoyancy_centre = Vec2::Zero();  ///< hull axes [m]; upright its z is KB
  double waterplane_breadth = 0;        ///< [m], solid only
  double waterplane_centre = 0;         ///< horizontal, earth axes through the hull's origin [m]
  double waterplane_inertia = 0;        ///< second moment about its own centre [m3 per m length]
  double bm = 0;                        ///< waterplane_inertia / area [m]; 0 if nothing is immersed
};

Hydrostatics hydrostatics(const std::vector<WeightedLoop>& solid, const Attitude& at);

/// Height of the metacentre above the centre of gravity for small turns at constant displacement
/// [m].
double metacentric_height(const std::vector<WeightedLoop>& solid, const Attitude& at,
                          const Vec2& cog);

/// Horizontal lever of buoyancy about the centre of gravity [m]: moment of roll / (rho g area). It
/// turns towards positive roll; at a stable equilibrium it falls through 0 with growing heel.
double roll_lever(const std::vector<WeightedLoop>& solid, const Attitude& at, const Vec2& cog);

/// Waterline at which `area` [m2] is displaced at this heel, to 1e-13 m; nullopt if the whole solid
/// displaces less (it sinks). Before: area > 0.
std::optional<double> find_waterline(const std::vector<WeightedLoop>& solid, double heel,
                                     double area);

struct Equilibrium {
  bool floats = false;  ///< false: sinks
  bool stable = false;  ///< a stable heel within +-80 degrees was found (fixed heel: gm > 0)
  Attitude at;          ///< of the stable heel; heel 0 if there is none
  Hydrostatics water;
  double gm = 0;  ///< metacentric_height at `at`
};

/// Where a section of mass rho * area floats. `free_heel` false: at heel 0. True: the first stable
/// heel reached from heel 0; if heel 0 is unstable without a lever (loll), the one to starboard.
Equilibrium find_equilibrium(const std::vector<WeightedLoop>& solid, double area, const Vec2& cog,
                             bool free_heel);

/// (heel, GZ) at constant displacement: GZ = -roll_lever, positive where it brings back from
/// positive heel. Heels at which the section sinks are left out.
std::vector<std::pair<double, double>> righting_curve(const std::vector<WeightedLoop>& solid,
                                                      double area, const Vec2& cog,
                                                      const std::vector<double>& heels);

}  // namespace seaway::hull
