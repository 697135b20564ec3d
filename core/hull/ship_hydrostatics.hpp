// Hydrostatics of a ship: buoyancy, waterplane, wetted surface, stability, equilibrium, GZ.
//
// The displacing solid is a list of weighted closed surfaces in hull axes. Damage is treated as
// lost buoyancy: a compartment open to the sea is simply not part of the solid (buoyant_surfaces in
// ship_shape.hpp), so mass and centre of gravity are those of the ship without flood water. The
// water level is the same everywhere; trapped air is not considered. Exact for polyhedra, closed in
// rounding. Pure functions, thread-safe.
//
// Attitude: x_earth = Ry(trim) Rx(heel) x about the hull axes' origin, which lies `waterline` below
// the calm level (measured vertically; upright it is the draft amidships). heel > 0: starboard
// down; trim > 0: bow down [rad].
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/hull/surface.hpp"

namespace seaway::hull {

struct ShipAttitude {
  double waterline = 0;       ///< [m]
  double heel = 0, trim = 0;  ///< [rad]
};

/// Hull axes to earth axes.
Eigen::Matrix3d earth_from_hull(const ShipAttitude& at);

struct ShipHydrostatics {
  double volume = 0;                    ///< displaced [m3]
  Vec3 buoyancy_centre = Vec3::Zero();  ///< hull axes [m]; upright: LCB from amidships, KB
  double wetted_surface = 0;            ///< of solids with weight 1, walls of open spaces too [m2]
  double waterplane_area = 0;           ///< solid only [m2]
  Vec3 waterplane_centre = Vec3::Zero();  ///< in the calm level, earth axes about the origin [m]
  double inertia_transverse = 0;  ///< of the waterplane about its centre, axis along the ship [m4]
  double inertia_longitudinal = 0;     ///< axis across the ship [m4]
  double bm = 0, bm_longitudinal = 0;  ///< inertia / volume [m]; 0 if nothing is immersed
};

ShipHydrostatics hydrostatics(const Solid& solid, const ShipAttitude& at);

/// Heights of the transverse and the longitudinal metacentre above the centre of gravity for small
/// turns at constant displacement [m].
struct MetacentricHeights {
  double transverse = 0, longitudinal = 0;
};
MetacentricHeights metacentric_heights(const ShipHydrostatics& water, const ShipAttitude& at,
                                       const Vec3& cog);

/// Centre of buoyancy less centre of gravity, earth axes [m]: y is the lever of the roll moment
/// (positive turns towards positive roll), -x that of the pitch moment.
Vec3 levers(const ShipHydrostatics& water, const ShipAttitude& at, const Vec3& cog);

/// Waterline at which `volume` [m3] is displaced at this heel and trim, to 1e-13 m; nullopt if the
/// whole solid displaces less (it sinks). Before: volume > 0.
std::optional<double> find_waterline(const Solid& solid, double heel, double trim, double volume);

struct ShipEquilibrium {
  bool floats = false;  ///< false: sinks, or no trim within +-30 degrees balances it
  bool stable = false;  ///< a stable heel within +-80 degrees was found (heel held: GM > 0)
  ShipAttitude at;
  ShipHydrostatics water;
  MetacentricHeights gm;
};

/// Where a ship of mass rho * volume floats. Held heel or trim stays 0. With a free heel: the first
/// stable heel reached from 0; if heel 0 is unstable without a lever (loll), the one to starboard.
ShipEquilibrium find_equilibrium(const Solid& solid, double volume, const Vec3& cog, bool free_heel,
                                 bool free_trim);

/// (heel, GZ) at constant displacement, trim balanced if `free_trim`: GZ = -lever of roll, positive
/// where it brings back from positive heel. Heels at which the ship sinks are left out.
std::vector<std::pair<double, double>> righting_curve(const Solid& solid, double volume,
                                                      const Vec3& cog,
                                                      const std::vector<double>& heels,
                                                      bool free_trim);

}  // namespace seaway::hull
