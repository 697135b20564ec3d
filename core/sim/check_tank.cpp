// Fluids, tank, wave, zones, settings and outputs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "core/sim/findings.hpp"

namespace seaway::sim {

namespace {

constexpr double unbounded = std::numeric_limits<double>::max();
constexpr const char* axis_names[3] = {"x", "y", "z"};

std::string tank_field(int axis) { return fmt::format("tank.{}_m", axis_names[axis]); }

void check_breaking(CheckState& s, double depth) {
  const Wave& w = s.c.wave;
  // Miche's limit of steepness of a progressive wave [miche1944].
  const double steepest = 0.142 * std::tanh(2 * pi * depth / s.wave_length);
  if (w.height > steepest * s.wave_length)
    s.findings.error(
        "wave.regular.height_m",
        fmt::format("{} m breaks: a wave {:.4g} m long in {:.4g} m of water reaches at most "
                    "{:.4g} m (0.142 tanh(kd) of its length)",
                    w.height, s.wave_length, depth, steepest * s.wave_length),
        "lower the wave or make it longer");
  if (w.theory == Wave::Theory::airy && w.height > 0.02 * s.wave_length)
    s.findings.warning(
        "wave.regular.theory",
        fmt::format("linear theory at steepness H/L = {:.3g}; it is good below about 0.02",
                    w.height / s.wave_length),
        "use the stream function theory");
}

void check_wave_fits(CheckState& s) {
  const Tank& tank = s.c.tank;
  const Wave& w = s.c.wave;
  const int axis = s.wave_axis;
  const double tank_length = tank.upper[axis] - tank.lower[axis];
  // Crests of steep waves are higher than troughs are deep, by up to a third.
  if (0.7 * w.height > tank.upper.z())
    s.findings.error("tank.z_m",
                     fmt::format("the lid at {} m is too low for crests of up to {:.4g} m",
                                 tank.upper.z(), 0.7 * w.height),
                     "raise the upper end of the tank");
  if (0.6 * w.height > -tank.lower.z())
    s.findings.error("tank.z_m",
                     fmt::format("the water is {} m deep, troughs reach down to {:.4g} m",
                                 -tank.lower.z(), 0.6 * w.height),
                     "lower the bottom of the tank");
  if (s.wave_length >
      1.05 * tank_length) {  // 5 %: the linear length is that much too short or long
    s.findings.error(tank_field(axis),
                     fmt::format("the tank is {:.4g} m long, the wave {:.4g} m; at least one "
                                 "wave must fit",
                                 tank_length, s.wave_length),
                     "lengthen the tank or shorten the wave");
  } else if (tank.periodic[static_cast<std::size_t>(axis)]) {
    const double n = tank_length / s.wave_length;
    const double tolerance = w.length > 0 ? 1e-6 : 0.05;
    if (std::abs(n - std::round(n)) > tolerance * std::round(n))
      s.findings.error(tank_field(axis),
                       fmt::format("a periodic tank of {:.6g} m holds {:.4g} waves of {:.6g} m; it "
                                   "must hold a whole number",
                                   tank_length, n, s.wave_length),
                       "make the tank a multiple of the wave length (give wave.regular.length_m)");
  }
}

void check_regular_wave(CheckState& s) {
  const Wave& w = s.c.wave;
  Findings& f = s.findings;
  const int before = f.n_errors();
  f.positive("wave.regular.height_m", w.height);
  f.not_negative("wave.regular.period_s", w.period);
  f.not_negative("wave.regular.length_m", w.length);
  f.finite("wave.regular.phase_deg", w.phase);
  if (f.finite("wave.regular.heading_deg", w.heading)) {
    const bool along_y = std::abs(std::cos(w.heading)) < 1e-6;
    const bool along_x = std::abs(std::sin(w.heading)) < 1e-6;
    s.wave_axis = along_x ? 0 : 1;
    if (s.c.dim == 2 && !along_y)
      f.error("wave.regular.heading_deg",
              fmt::format("{:.6g} degrees; a section sees waves along y only: 90 or "
                          "-90",
                          w.heading / degree),
              "use 90 or -90");
    if (s.c.dim == 3 && !along_x && !along_y)
      f.error("wave.regular.heading_deg",
              fmt::format("{:.6g} degrees; waves go along the tank's x or y axis in this version",
                          w.heading / degree),
              "use 0, 90, 180 or -90, or turn the ship by body.angles.yaw_deg");
  }
  if (w.period > 0 && w.length > 0)
    f.error("wave.regular.period_s",
            fmt::format("period {} s and length {} m are both given; exactly one is "
                        "allowed, the other follows",
                        w.period, w.length),
            "remove period_s or length_m");
  if (w.period == 0 && w.length == 0)
    f.error("wave.regular.period_s", "neither period nor length is given; exactly one is needed",
            "add period_s or length_m");
  if (f.n_errors() > before || !s.tank_ok || !s.fluids_ok) return;
  const double depth = -s.c.tank.lower.z(), gravity = s.c.fluids.gravity;
  s.wave_length = w.length > 0 ? w.length : linear_wave_length(w.period, depth, gravity);
  s.wave_period = w.period > 0 ? w.period : linear_wave_period(w.length, depth, gravity);
  s.wave_ok = true;
  check_breaking(s, depth);
  check_wave_fits(s);
}

void check_zones(CheckState& s) {
  const Zones& z = s.c.zones;
  Findings& f = s.findings;
  const bool numbers = f.not_negative("zones.generation_length_m", z.generation_length) &
                       f.not_negative("zones.absorption_length_m", z.absorption_length);
  f.not_negative("zones.rate_per_s", z.rate);
  if (!numbers || !s.tank_ok) return;
  const double both = z.generation_length + z.absorption_length;
  const int axis = s.wave_axis;
  const bool periodic = s.c.tank.periodic[static_cast<std::size_t>(axis)];
  const double tank_length = s.c.tank.upper[axis] - s.c.tank.lower[axis];
  if (both > 0 && periodic)
    f.error("zones",
            fmt::format("zones of {} m in a tank that is periodic in {}; it has no ends", both,
                        axis_names[axis]),
            "remove the zones or the periodicity");
  if (both >= tank_length)
    f.error(
        "zones.absorption_length_m",
        fmt::format("generation and absorption take {:.4g} m together, the tank is {:.4g} m long",
                    both, tank_length),
        "shorten the zones or lengthen the tank");
  if (!s.wave_ok || periodic) return;
  if (z.generation_length == 0)
    f.warning("zones.generation_length_m",
              "0 m: no wave comes in behind the one that the tank starts with",
              "give at least half a wave length");
  if (z.absorption_length < 0.95 * s.wave_length)
    f.warning(
        "zones.absorption_length_m",
        fmt::format("{:.4g} m is shorter than the wave, {:.4g} m; waves come back from the end",
                    z.absorption_length, s.wave_length),
        "give at least one wave length");
}

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

void check_wave_and_zones(CheckState& s) {
  if (s.c.wave.kind == Wave::Kind::regular) check_regular_wave(s);
  check_zones(s);
}

void check_settings_and_outputs(CheckState& s) {
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
  std::set<std::string> names;
  for (std::size_t i = 0; i < s.c.outputs.gauges.size(); ++i) {
    const Gauge& gauge = s.c.outputs.gauges[i];
    const std::string field = fmt::format("outputs.gauges[{}]", i);
    if (gauge.name.empty()) f.error(field + ".name", "the gauge has no name", "name it");
    if (!names.insert(gauge.name).second)
      f.error(field + ".name", fmt::format("'{}' is used twice", gauge.name),
              "give each gauge its own name");
    const double place[2] = {gauge.x, gauge.y};
    for (int axis = s.first_axis(); axis < 2; ++axis) {
      const std::string coordinate = fmt::format("{}.{}_m", field, axis_names[axis]);
      const double low = s.c.tank.lower[axis], high = s.c.tank.upper[axis];
      if (f.finite(coordinate, place[axis]) && s.tank_ok && !(place[axis] >= low && place[axis] <= high))
        f.error(coordinate,
                fmt::format("{} m is outside the tank; allowed: {} to {}", place[axis], low, high),
                "move the gauge into the tank");
    }
  }
}

}  // namespace seaway::sim
