// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/convert/result.hpp"

#include "core/base/constants.hpp"

namespace seaway::convert {
namespace {

bool is_angle(const std::string& unit) { return unit == "rad" || unit.starts_with("rad/"); }
double to_degrees(double angle) { return angle * (180.0 / pi); }

}  // namespace

std::string edge_unit(const std::string& unit) { return is_angle(unit) ? "deg" + unit.substr(3) : unit; }

double edge_value(const std::string& core_unit, double value) {
  return is_angle(core_unit) ? to_degrees(value) : value;
}

v1::ChannelSchema to_proto(const sim::Channel& channel) {
  v1::ChannelSchema m;
  m.set_name(channel.name);
  m.set_unit(edge_unit(channel.unit));
  return m;
}

void append(const sim::Sample& sample, const std::vector<sim::Channel>& channels, v1::SampleChunk& chunk) {
  if (chunk.times_s_size() == 0) {
    chunk.set_first_sequence(sample.sequence);
    for (std::size_t i = 0; i < channels.size(); ++i) chunk.add_columns();
  }
  chunk.add_stages(sample.stage);
  chunk.add_steps(sample.step);
  chunk.add_times_s(sample.time);
  for (std::size_t i = 0; i < channels.size(); ++i)
    chunk.mutable_columns(static_cast<int>(i))->add_values(edge_value(channels[i].unit, sample.values.at(i)));
}

v1::StageReport to_proto(const sim::StageInfo& info) {
  v1::StageReport m;
  m.set_stage(info.stage);
  m.set_name(info.name);
  m.set_cell_count(info.cells);
  m.set_level_count(info.levels);
  m.set_finest_cell_m(info.finest_cell);
  m.set_start_time_s(info.time);
  m.set_dt_s(info.dt);
  return m;
}

v1::StageReport to_proto(const sim::StageResult& result) {
  v1::StageReport m = to_proto(result.info);
  m.set_finished(true);
  m.set_end_time_s(result.end_time);
  m.set_step_count(result.steps);
  m.set_converged(result.converged);
  m.set_wall_s(result.wall_s);
  m.set_cpu_s(result.cpu_s);
  for (const auto& [phase, seconds] : result.phases) {
    v1::PhaseTiming& timing = *m.add_phases();
    timing.set_phase(phase);
    timing.set_cpu_s(seconds);
  }
  m.set_mean_pressure_iterations(result.mean_pressure_iterations);
  m.set_max_pressure_iterations(result.max_pressure_iterations);
  m.set_volume_drift(result.volume_drift);
  if (result.has_mapping) {
    const sim::MappingReport& from = result.mapping;
    v1::MappingReport& to = *m.mutable_mapping();
    to.set_method(from.method);
    to.set_cpu_s(from.cpu_s);
    to.set_vof_min(from.vof_min);
    to.set_vof_max(from.vof_max);
    to.set_water_before(from.water_before);
    to.set_water_after(from.water_after);
    to.set_divergence_before(from.divergence_before);
    to.set_divergence_after(from.divergence_after);
    to.set_kept_cell_count(from.kept_cells);
    to.set_new_cell_count(from.new_cells);
    to.set_fall_back_count(from.fall_backs);
  }
  for (const sim::MotionAmplitude& from : result.motions) {
    v1::MotionAmplitude& to = *m.add_motions();
    const std::string unit =
        from.channel == "roll" || from.channel == "pitch" || from.channel == "yaw" ? "rad" : "m";
    to.set_channel(from.channel);
    to.set_unit(edge_unit(unit));
    to.set_amplitude(edge_value(unit, from.amplitude));
    to.set_mean(edge_value(unit, from.mean));
    to.set_period_s(from.period);
    to.set_change(from.change);
  }
  for (const sim::WallReport& from : result.walls) {
    v1::WallReport& to = *m.add_wall_layers();
    to.set_name(from.name);
    to.set_y_plus_min(from.y_plus_min);
    to.set_y_plus_mean(from.y_plus_mean);
    to.set_y_plus_max(from.y_plus_max);
  }
  return m;
}

v1::Progress to_proto(const sim::Progress& progress) {
  v1::Progress m;
  m.set_stage(progress.stage);
  m.set_stage_count(progress.stage_count);
  m.set_time_s(progress.time);
  m.set_fraction(progress.fraction);
  if (progress.remaining_s >= 0) m.set_remaining_s(progress.remaining_s);
  m.set_held(progress.held);
  return m;
}

v1::CaseReport to_proto(const sim::CaseReport& report) {
  v1::CaseReport m;
  bool ok = true;
  for (const sim::Diagnostic& from : report.diagnostics) {
    v1::Diagnostic& to = *m.add_diagnostics();
    const bool error = from.severity == sim::Diagnostic::Severity::error;
    ok = ok && !error;
    to.set_severity(error ? v1::Diagnostic::SEVERITY_ERROR : v1::Diagnostic::SEVERITY_WARNING);
    to.set_field(from.field);
    to.set_message(from.message);
    to.set_hint(from.hint);
  }
  m.set_ok(ok);
  if (const sim::HydrostaticsSummary& from = report.hydrostatics; from.valid) {
    v1::Hydrostatics& to = *m.mutable_hydrostatics();
    to.set_mass(from.mass);
    to.set_displaced_volume(from.displaced_volume);
    to.set_draft_m(from.draft);
    to.set_kb_m(from.kb);
    to.set_bm_m(from.bm);
    to.set_gm_m(from.gm);
    to.set_heel_deg(to_degrees(from.heel));
    to.set_intact_draft_m(from.intact_draft);
    to.set_intact_gm_m(from.intact_gm);
    to.set_natural_roll_period_dry_s(from.natural_roll_period_dry);
    to.set_trim_deg(to_degrees(from.trim));
    to.set_lcb_m(from.lcb);
    to.set_wetted_surface_m2(from.wetted_surface);
  }
  for (const sim::StageEstimate& from : report.stages) {
    v1::StageEstimate& to = *m.add_stages();
    to.set_name(from.name);
    to.set_cell_count(from.cells);
    to.set_step_count(from.steps);
    to.set_dt_s(from.dt);
    to.set_cpu_s(from.cpu_s);
  }
  return m;
}

}  // namespace seaway::convert
