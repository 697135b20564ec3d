// SPDX-License-Identifier: GPL-3.0-or-later
// The case of the solver back into a message, every default written out.
#include <cmath>

#include "server/convert/case.hpp"
#include "server/convert/case_parts.hpp"

namespace seaway::convert {
namespace {

template <class Message>
void put_box(const Vec3& lower, const Vec3& upper, int dim, Message& m) {
  const auto pair = [&](int axis, auto* field) {
    field->Add(lower[axis]);
    field->Add(upper[axis]);
  };
  if (dim == 3) pair(0, m.mutable_x_m());
  pair(1, m.mutable_y_m());
  pair(2, m.mutable_z_m());
}

void put_vector(const Vec3& v, v1::Vector& m) {
  m.set_x_m(v[0]);
  m.set_y_m(v[1]);
  m.set_z_m(v[2]);
}

double degrees(double angle) { return angle / degree; }

void put_hull(const sim::Hull& h, int dim, v1::Hull& m) {
  switch (h.shape) {
    case sim::Hull::Shape::none: break;
    case sim::Hull::Shape::box:
      m.mutable_box()->set_beam_m(h.beam);
      m.mutable_box()->set_height_m(h.height);
      if (dim == 3) m.mutable_box()->set_length_m(h.length);
      break;
    case sim::Hull::Shape::rounded_box:
      m.mutable_rounded_box()->set_beam_m(h.beam);
      m.mutable_rounded_box()->set_height_m(h.height);
      m.mutable_rounded_box()->set_corner_radius_m(h.corner_radius);
      if (dim == 3) m.mutable_rounded_box()->set_length_m(h.length);
      break;
    case sim::Hull::Shape::polygon:
      for (const auto& corner : h.vertices) {
        v1::Vertex& v = *m.mutable_polygon()->add_vertices();
        v.set_y_m(corner[0]);
        v.set_z_m(corner[1]);
      }
      break;
    case sim::Hull::Shape::offsets_section: {
      v1::OffsetsSectionShape& s = *m.mutable_offsets_section();
      s.set_file(h.offsets_file);
      s.set_station(h.station);
      s.set_scale(h.scale);
      if (h.extend_to > 0) s.set_extend_to_m(h.extend_to);
      break;
    }
    case sim::Hull::Shape::cylinder:
      m.mutable_cylinder()->set_length_m(h.length);
      m.mutable_cylinder()->set_radius_m(h.radius);
      break;
    case sim::Hull::Shape::sphere: m.mutable_sphere()->set_radius_m(h.radius); break;
    case sim::Hull::Shape::wigley:
      m.mutable_wigley()->set_length_m(h.length);
      m.mutable_wigley()->set_beam_m(h.beam);
      m.mutable_wigley()->set_draft_m(h.design_draft);
      m.mutable_wigley()->set_height_m(h.height);
      break;
    case sim::Hull::Shape::offsets_hull: {
      v1::OffsetsHullShape& s = *m.mutable_offsets_hull();
      s.set_file(h.offsets_file);
      s.set_amidships(h.station);
      s.set_scale(h.scale);
      if (h.extend_to > 0) s.set_extend_to_m(h.extend_to);
      break;
    }
    case sim::Hull::Shape::stl: {
      v1::StlShape& stl = *m.mutable_stl();
      stl.set_file(h.offsets_file);
      stl.set_unit_m(h.unit);
      stl.set_amidships(h.station);
      break;
    }
  }
  for (const sim::Compartment& from : h.compartments) {
    v1::Compartment& to = *m.add_compartments();
    to.set_name(from.name);
    put_box(from.lower, from.upper, dim, to);
    to.set_wall_thickness_m(from.wall_thickness);
    to.set_permeability(from.permeability);
    to.set_flooded(from.flooded);
    for (const sim::Opening& hole : from.openings) {
      v1::Opening& opening = *to.add_openings();
      opening.set_name(hole.name);
      put_box(hole.lower, hole.upper, dim, opening);
    }
  }
}

void put_body(const sim::Body& b, int dim, v1::Body& m) {
  if (dim == 2)
    m.set_mass_kg_per_m(b.mass);
  else
    m.set_mass_kg(b.mass);
  put_vector(b.cog, *m.mutable_cog());
  put_vector(b.gyradii, *m.mutable_gyradii());
  for (const sim::Dof dof : b.free) m.add_free(static_cast<v1::Dof>(static_cast<int>(dof) + 1));
  if (b.draft > 0) m.set_draft_m(b.draft);
  put_vector(b.offset, *m.mutable_offset());
  m.mutable_angles()->set_roll_deg(degrees(b.angles[0]));
  m.mutable_angles()->set_pitch_deg(degrees(b.angles[1]));
  m.mutable_angles()->set_yaw_deg(degrees(b.angles[2]));
  for (const auto& from : b.prescribed) {
    v1::PrescribedMotion& to = *m.add_prescribed();
    to.set_dof(static_cast<v1::Dof>(static_cast<int>(from.dof) + 1));
    if (from.dof >= sim::Dof::roll)
      to.set_amplitude_deg(degrees(from.amplitude));
    else
      to.set_amplitude_m(from.amplitude);
    to.set_period_s(from.period);
    to.set_ramp_s(from.ramp);
  }
  v1::Release& release = *m.mutable_release();
  switch (b.release) {
    case sim::Body::Release::at_start: release.mutable_at_start(); break;
    case sim::Body::Release::at_time: release.mutable_at_time()->set_time_s(b.release_time); break;
    case sim::Body::Release::converged:
      release.mutable_converged()->set_tolerance(b.release_tolerance);
      release.mutable_converged()->set_min_periods(b.release_min_periods);
      release.mutable_converged()->set_max_periods(b.release_max_periods);
  }
}

void put_stage(const sim::Stage& s, bool first, int dim, v1::Stage& m) {
  m.set_name(s.name);
  if (s.dt > 0)
    m.mutable_time()->set_dt_s(s.dt);
  else if (s.steps_per_period > 0)
    m.mutable_time()->set_steps_per_period(s.steps_per_period);
  v1::MeshRule& mesh = *m.mutable_mesh();
  if (s.mesh.hull_cell > 0) mesh.set_hull_cell_m(s.mesh.hull_cell);
  if (s.mesh.hull_margin > 0) mesh.set_hull_margin_m(s.mesh.hull_margin);
  mesh.set_hull_sweep_deg(degrees(s.mesh.hull_sweep));
  if (s.mesh.hull_heave > 0) mesh.set_hull_heave_m(s.mesh.hull_heave);
  for (const sim::SurfaceBand& from : s.mesh.surface) {
    v1::SurfaceBand& band = *mesh.add_surface();
    band.set_cell_m(from.cell);
    band.set_half_height_m(from.half_height);
    if (std::isfinite(from.within)) band.set_within_m(from.within);
  }
  for (const sim::RefinementBox& from : s.mesh.boxes) {
    v1::RefinementBox& box = *mesh.add_boxes();
    box.set_cell_m(from.cell);
    put_box(from.lower, from.upper, dim, box);
  }
  if (s.end.kind == sim::EndRule::Kind::time) {
    m.mutable_end()->mutable_time()->set_duration_s(s.end.duration);
  } else {
    v1::EndWhenConverged& end = *m.mutable_end()->mutable_converged();
    end.set_tolerance(s.end.tolerance);
    end.set_min_periods(s.end.min_periods);
    end.set_max_periods(s.end.max_periods);
  }
  if (first) return;
  v1::Mapping& mapping = *m.mutable_mapping();
  mapping.set_method(static_cast<v1::Mapping::Method>(static_cast<int>(s.mapping.method) + 1));
  mapping.set_kernel(static_cast<v1::Mapping::Kernel>(static_cast<int>(s.mapping.kernel) + 1));
  mapping.set_ordering(static_cast<v1::Mapping::Ordering>(static_cast<int>(s.mapping.ordering) + 1));
  mapping.set_shape(s.mapping.shape);
  mapping.set_tail_degree(s.mapping.tail_degree);
  mapping.set_seed(s.mapping.seed);
  if (s.mapping.method != sim::Mapping::Method::prbf) return;
  mapping.set_k(s.mapping.k);
  mapping.set_subsets(s.mapping.subsets);
  mapping.set_evaluate_all(s.mapping.evaluate_all);
}

}  // namespace

v1::Case to_proto(const sim::Case& c) {
  v1::Case m;
  m.set_title(c.title);
  m.set_dimension(c.dim);
  v1::Fluids& fluids = *m.mutable_fluids();
  fluids.set_water_density_kg_per_m3(c.fluids.rho_water);
  fluids.set_air_density_kg_per_m3(c.fluids.rho_air);
  fluids.set_water_viscosity_m2_per_s(c.fluids.nu_water);
  fluids.set_air_viscosity_m2_per_s(c.fluids.nu_air);
  fluids.set_gravity_m_per_s2(c.fluids.gravity);
  fluids.set_viscous(c.fluids.viscous);
  put_box(c.tank.lower, c.tank.upper, c.dim, *m.mutable_tank());
  if (c.tank.periodic[0]) m.mutable_tank()->add_periodic(v1::AXIS_X);
  if (c.tank.periodic[1]) m.mutable_tank()->add_periodic(v1::AXIS_Y);
  m.mutable_tank()->set_open_top(c.tank.open_top);
  put_no_slip(c.tank, c.dim, *m.mutable_tank());
  if (c.turbulence.model != sim::Turbulence::Model::none) put_turbulence(c.turbulence, *m.mutable_turbulence());
  m.mutable_mesh()->set_base_cell_m(c.base_cell);
  if (c.dim == 3) m.mutable_mesh()->set_stretch_x(c.stretch_x);
  put_wave(c.wave, *m.mutable_wave());
  m.mutable_zones()->set_generation_length_m(c.zones.generation_length);
  m.mutable_zones()->set_absorption_length_m(c.zones.absorption_length);
  m.mutable_zones()->set_rate_per_s(c.zones.rate);
  m.mutable_zones()->set_absorption_target(static_cast<v1::Zones::Target>(static_cast<int>(c.zones.absorption_target) + 1));
  if (c.hull.shape != sim::Hull::Shape::none) {
    put_hull(c.hull, c.dim, *m.mutable_hull());
    put_body(c.body, c.dim, *m.mutable_body());
  }
  v1::TimeControl& time = *m.mutable_time();
  if (c.time.dt > 0)
    time.set_dt_s(c.time.dt);
  else
    time.set_steps_per_period(c.time.steps_per_period);
  time.set_max_substeps(c.time.max_substeps);
  time.set_cfl(c.time.cfl);
  v1::Numerics& numerics = *m.mutable_numerics();
  numerics.set_pressure_tolerance(c.numerics.pressure_tolerance);
  numerics.set_max_pressure_iterations(c.numerics.max_pressure_iterations);
  numerics.set_volume_correction(c.numerics.volume_correction);
  numerics.set_half_step_geometry(c.numerics.half_step_geometry);
  for (std::size_t i = 0; i < c.stages.size(); ++i)
    put_stage(c.stages[i], i == 0, c.dim, *m.mutable_cascade()->add_stages());
  m.mutable_outputs()->set_sample_interval_s(c.outputs.sample_interval);
  m.mutable_outputs()->set_snapshot_interval_s(c.outputs.snapshot_interval);
  for (const sim::Gauge& from : c.outputs.gauges) {
    v1::Gauge& gauge = *m.mutable_outputs()->add_gauges();
    gauge.set_name(from.name);
    gauge.set_x_m(from.x);
    gauge.set_y_m(from.y);
  }
  for (const sim::Probe& from : c.outputs.probes) {
    v1::PressureProbe& probe = *m.mutable_outputs()->add_probes();
    probe.set_name(from.name);
    probe.set_frame(from.on_hull ? v1::PressureProbe::FRAME_HULL : v1::PressureProbe::FRAME_EARTH);
    if (c.dim == 3) probe.set_x_m(from.place.x());
    probe.set_y_m(from.place.y());
    probe.set_z_m(from.place.z());
  }
  return m;
}

}  // namespace seaway::convert
