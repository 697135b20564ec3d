// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/convert/case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "server/convert/case_parts.hpp"
#include "server/convert/input_error.hpp"

namespace seaway::convert {
namespace {

void read_fluids(const v1::Fluids& m, sim::Fluids& f, Checker& check) {
  if (m.has_water_density_kg_per_m3())
    f.rho_water = check.number("fluids.water_density_kg_per_m3", m.water_density_kg_per_m3(), {1, 20000});
  if (m.has_air_density_kg_per_m3())
    f.rho_air = check.number("fluids.air_density_kg_per_m3", m.air_density_kg_per_m3(), {1e-3, f.rho_water});
  if (m.has_water_viscosity_m2_per_s())
    f.nu_water = check.number("fluids.water_viscosity_m2_per_s", m.water_viscosity_m2_per_s(), {0, 1});
  if (m.has_air_viscosity_m2_per_s())
    f.nu_air = check.number("fluids.air_viscosity_m2_per_s", m.air_viscosity_m2_per_s(), {0, 1});
  if (m.has_gravity_m_per_s2())
    f.gravity = check.number("fluids.gravity_m_per_s2", m.gravity_m_per_s2(), {0, 100, true});
  if (m.has_viscous()) f.viscous = m.viscous();
}

void read_tank(const v1::Case& message, int dim, sim::Tank& tank, Checker& check) {
  const v1::Tank& m = message.tank();
  if (!message.has_tank()) {
    check.problem("tank", "is missing", "give tank.y_m and tank.z_m");
    return;
  }
  read_box(m.x_m(), m.y_m(), m.z_m(), "tank", dim, tank.lower, tank.upper, check);
  if (m.z_m_size() == 2 && !(m.z_m(0) < 0 && m.z_m(1) > 0))
    check.problem("tank.z_m", fmt::format("[{}, {}] does not contain the calm level z = 0", m.z_m(0), m.z_m(1)),
                  "the first number is minus the water depth, the second the height of the lid");
  for (int i = 0; i < m.periodic_size(); ++i) {
    const std::string path = fmt::format("tank.periodic[{}]", i);
    switch (m.periodic(i)) {
      case v1::AXIS_X:
        if (dim == 2) check.problem(path, "x does not exist in 2-D", "remove it");
        tank.periodic[0] = true;
        break;
      case v1::AXIS_Y: tank.periodic[1] = true; break;
      default: check.problem(path, "only x and y can be periodic", "remove it");
    }
  }
  if (m.has_open_top()) tank.open_top = m.open_top();
  read_no_slip(m, dim, tank, check);
}

void read_zones(const v1::Zones& m, sim::Zones& zones, Checker& check) {
  if (m.has_generation_length_m())
    zones.generation_length = check.number("zones.generation_length_m", m.generation_length_m(), not_negative);
  if (m.has_absorption_length_m())
    zones.absorption_length = check.number("zones.absorption_length_m", m.absorption_length_m(), not_negative);
  if (m.absorption_target() == v1::Zones::TARGET_REST) zones.absorption_target = sim::Zones::Target::rest;
  if (m.has_rate_per_s()) zones.rate = check.number("zones.rate_per_s", m.rate_per_s(), not_negative);
}

void read_time(const v1::TimeControl& m, sim::TimeControl& time, Checker& check) {
  read_time_step(m, "time", time, check);
  if (m.has_max_substeps()) time.max_substeps = check.count("time.max_substeps", m.max_substeps(), 1, 64);
  if (m.has_cfl()) time.cfl = check.number("time.cfl", m.cfl(), {0, 0.5, true});
}

void read_numerics(const v1::Numerics& m, sim::Numerics& n, Checker& check) {
  if (m.has_pressure_tolerance())
    n.pressure_tolerance = check.number("numerics.pressure_tolerance", m.pressure_tolerance(), {1e-14, 1e-2});
  if (m.has_max_pressure_iterations())
    n.max_pressure_iterations =
        check.count("numerics.max_pressure_iterations", m.max_pressure_iterations(), 1, 100000);
  if (m.has_volume_correction()) n.volume_correction = m.volume_correction();
  if (m.has_half_step_geometry()) n.half_step_geometry = m.half_step_geometry();
}

/// The name of a channel's `what`, none twice.
void read_name(const std::string& path, const std::string& name, const char* what, std::set<std::string>& names, Checker& check) {
  check.name(path, name);
  if (!names.insert(name).second)
    check.problem(path, fmt::format("'{}' is used twice", name), fmt::format("give each {} its own name", what));
}

void read_outputs(const v1::Outputs& m, sim::Outputs& out, Checker& check) {
  if (m.has_sample_interval_s())
    out.sample_interval = check.number("outputs.sample_interval_s", m.sample_interval_s(), not_negative);
  if (m.has_snapshot_interval_s())
    out.snapshot_interval = check.number("outputs.snapshot_interval_s", m.snapshot_interval_s(), not_negative);
  check.entries("outputs.gauges", m.gauges_size(), 0, 64);
  std::set<std::string> names;
  for (int i = 0; i < m.gauges_size(); ++i) {
    read_name(fmt::format("outputs.gauges[{}].name", i), m.gauges(i).name(), "gauge", names, check);
    out.gauges.push_back({m.gauges(i).name(), m.gauges(i).x_m(), m.gauges(i).y_m()});
  }
}

void read_probes(const v1::Outputs& m, bool has_hull, int dim, sim::Outputs& out, Checker& check) {
  check.entries("outputs.probes", m.probes_size(), 0, 64);
  std::set<std::string> names;
  for (int i = 0; i < m.probes_size(); ++i) {
    const v1::PressureProbe& from = m.probes(i);
    const std::string path = fmt::format("outputs.probes[{}]", i);
    read_name(path + ".name", from.name(), "probe", names, check);
    if (dim == 2 && from.x_m() != 0) check.problem(path + ".x_m", "x does not exist in 2-D", "remove it");
    sim::Probe probe{from.name(), has_hull, {from.x_m(), from.y_m(), from.z_m()}};
    if (from.frame() == v1::PressureProbe::FRAME_HULL && !has_hull)
      check.problem(path + ".frame", "there is no hull to move with", "write earth, or leave it out");
    else if (from.frame() != v1::PressureProbe::FRAME_UNSPECIFIED)
      probe.on_hull = from.frame() == v1::PressureProbe::FRAME_HULL;
    out.probes.push_back(probe);
  }
}

}  // namespace

void read_box(const Extent& x, const Extent& y, const Extent& z, const std::string& path, int dim, Vec3& lower,
              Vec3& upper, Checker& check) {
  const std::array<const Extent*, 3> extents{&x, &y, &z};
  static constexpr std::array<const char*, 3> names{"x_m", "y_m", "z_m"};
  for (int axis = 0; axis < 3; ++axis) {
    const Extent& e = *extents[static_cast<std::size_t>(axis)];
    const std::string field = path + "." + names[static_cast<std::size_t>(axis)];
    if (axis == 0 && dim == 2) {
      if (!e.empty()) check.problem(field, "x does not exist in 2-D", "remove it");
    } else if (e.size() != 2) {
      check.problem(field, e.empty() ? "is missing" : fmt::format("has {} numbers", e.size()),
                    "give [lower, upper] in metres");
    } else if (!(e[0] < e[1])) {
      check.problem(field, fmt::format("[{}, {}] is empty", e[0], e[1]), "the first number must be the smaller one");
    } else {
      lower[axis] = check.number(field, e[0], any_finite);
      upper[axis] = check.number(field, e[1], any_finite);
    }
  }
}

Vec3 read_vector(const v1::Vector& v) { return {v.x_m(), v.y_m(), v.z_m()}; }

bool dof_exists(sim::Dof dof, int dim) {
  return dim == 3 || dof == sim::Dof::sway || dof == sim::Dof::heave || dof == sim::Dof::roll;
}

sim::Case to_core(const v1::Case& m) {
  Checker check;
  sim::Case c;
  check.finite(m);
  if (m.title().empty()) check.problem("title", "is missing", "say in a few words what the case is");
  check.line("title", m.title(), 200);
  c.title = m.title();
  if (m.dimension() != 2 && m.dimension() != 3)
    check.problem("dimension", m.dimension() == 0 ? "is missing" : fmt::format("{} is not allowed", m.dimension()),
                  "write 2 for a section, 3 for a ship");
  c.dim = m.dimension() == 3 ? 3 : 2;
  read_fluids(m.fluids(), c.fluids, check);
  read_tank(m, c.dim, c.tank, check);
  if (!m.has_mesh() || m.mesh().base_cell_m() == 0)
    check.problem("mesh.base_cell_m", "is missing", "give the edge of the coarsest cell in metres");
  else
    c.base_cell = check.number("mesh.base_cell_m", m.mesh().base_cell_m(), positive);
  if (m.mesh().has_stretch_x()) {
    if (c.dim == 2) check.problem("mesh.stretch_x", "x does not exist in 2-D", "remove it");
    c.stretch_x = check.number("mesh.stretch_x", m.mesh().stretch_x(), positive);
  }
  if (m.has_wave()) read_wave(m.wave(), c.dim, c.wave, check);
  read_zones(m.zones(), c.zones, check);
  if (m.has_turbulence()) read_turbulence(m.turbulence(), c.turbulence, check);
  if (m.has_hull()) read_hull(m.hull(), c.dim, c.hull, check);
  read_body(m, c.body, check);
  read_time(m.time(), c.time, check);
  read_numerics(m.numerics(), c.numerics, check);
  read_cascade(m.cascade(), c.dim, c.stages, check);
  read_outputs(m.outputs(), c.outputs, check);
  read_probes(m.outputs(), m.has_hull(), c.dim, c.outputs, check);
  if (!check.ok()) throw InputError("INVALID_CASE", check.take());
  return c;
}

}  // namespace seaway::convert
