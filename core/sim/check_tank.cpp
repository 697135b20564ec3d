// Fluids, tank, settings and outputs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/sim/findings.hpp"

namespace seaway::sim {

namespace {

constexpr double unbounded = std::numeric_limits<double>::max();

}  // namespace

void check_fluids_and_tank(CheckState& s) {
  const Fluids& fluids = s.c.fluids;
  Findings& f = s.findings;
  int before = f.n_errors();
  if (f.in_range("fluids.water_density_kg_per_m3", fluids.rho_water, 1, 20000))
    f.in_range("fluids.air_density_kg_per_m3", fluids.rho_air, 1e-3, fluids.rho_water);
  f.in_range("fluids.water_viscosity_m2_per_s", fluids.nu_water, 0, 1);
  f.in_range("fluids.air_viscosity_m2_per_s", fluids.nu_air, 0, 1);
  f.above_to("fluids.gravity_m_per_s2", fluids.gravity, 0, 100);
  s.fluids_ok = f.n_errors() == before;

  const Tank& tank = s.c.tank;
  before = f.n_errors();
  if (s.c.dim == 3) f.extent("tank.x_m", tank.lower.x(), tank.upper.x());
  f.extent("tank.y_m", tank.lower.y(), tank.upper.y());
  if (f.extent("tank.z_m", tank.lower.z(), tank.upper.z()) &&
      !(tank.lower.z() < 0 && tank.upper.z() > 0))
    f.error("tank.z_m",
            fmt::format("[{}, {}] does not hold the calm water level z = 0", tank.lower.z(),
                        tank.upper.z()),
            "the lower end is minus the water depth, the upper end the height of the lid");
  if (tank.periodic[2])
    f.error("tank.periodic", "z is periodic; gravity acts along it", "leave z out");
  s.tank_ok = f.n_errors() == before;
  s.base_cell_ok = f.positive("mesh.base_cell_m", s.c.base_cell) & f.in_range("mesh.stretch_x", s.c.stretch_x, 1, 4);
  if (s.tank_ok && s.base_cell_ok) {
    double shortest = tank.upper.z() - tank.lower.z();
    for (int axis = s.first_axis(); axis < 2; ++axis)
      shortest = std::min(shortest, tank.upper[axis] - tank.lower[axis]);
    if (s.c.base_cell > shortest) {
      s.base_cell_ok = false;
      f.error(
          "mesh.base_cell_m",
          fmt::format("{} m is larger than the tank's shorter side, {} m", s.c.base_cell, shortest),
          "the coarsest cell must fit into the tank");
    }
  }
}

void check_settings(CheckState& s) {
  const TimeControl& time = s.c.time;
  Findings& f = s.findings;
  f.not_negative("time.dt_s", time.dt);
  f.in_range("time.steps_per_period", time.steps_per_period, 10, 1e5);
  f.whole_in_range("time.max_substeps", time.max_substeps, 1, 64);
  f.above_to("time.cfl", time.cfl, 0, 0.5);
  f.in_range("numerics.pressure_tolerance", s.c.numerics.pressure_tolerance, 1e-14, 1e-2);
  f.whole_in_range("numerics.max_pressure_iterations", s.c.numerics.max_pressure_iterations, 1,
                   100000);
  f.in_range("outputs.sample_interval_s", s.c.outputs.sample_interval, 0, unbounded);
  f.in_range("outputs.snapshot_interval_s", s.c.outputs.snapshot_interval, 0, unbounded);
}

}  // namespace seaway::sim
