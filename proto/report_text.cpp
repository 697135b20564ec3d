// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/report_text.hpp"

#include <algorithm>
#include <vector>

#include "proto/text.hpp"

namespace seaway::report_text {
namespace {

using Row = std::vector<std::string>;

std::string grouped(std::int64_t n) {
  std::string text = std::to_string(n);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), " ");
  return text;
}

const v1::MotionAmplitude* motion(const v1::StageReport& stage, const std::string& channel) {
  for (const auto& m : stage.motions())
    if (m.channel() == channel) return &m;
  return nullptr;
}

std::string amplitude(const v1::StageReport& stage, const std::string& channel) {
  const auto* m = motion(stage, channel);
  if (m == nullptr) return "-";
  return m->unit() == "m" ? formatted(1000 * m->amplitude(), "%.2f mm") : formatted(m->amplitude(), "%.2f ") + m->unit();
}

/// Phases in the order of the first stage that has them.
std::vector<std::string> phases_of(const google::protobuf::RepeatedPtrField<v1::StageReport>& stages) {
  std::vector<std::string> out;
  for (const auto& stage : stages)
    for (const auto& phase : stage.phases())
      if (phase.cpu_s() > 0 && std::find(out.begin(), out.end(), phase.phase()) == out.end()) out.push_back(phase.phase());
  return out;
}

double phase_cpu(const v1::StageReport& stage, const std::string& name) {
  for (const auto& phase : stage.phases())
    if (phase.phase() == name) return phase.cpu_s();
  return 0;
}

template <class F>
Row row(const std::string& title, const google::protobuf::RepeatedPtrField<v1::StageReport>& stages, F cell) {
  Row out{title};
  for (const auto& stage : stages) out.push_back(cell(stage));
  return out;
}

}  // namespace

std::string align(const std::vector<Row>& rows) {
  std::vector<std::size_t> width;
  for (const Row& r : rows) {
    width.resize(std::max(width.size(), r.size()));
    for (std::size_t i = 0; i < r.size(); ++i) width[i] = std::max(width[i], r[i].size());
  }
  std::string out;
  for (const Row& r : rows) {
    std::string line;
    for (std::size_t i = 0; i < r.size(); ++i) {
      const std::string pad(width[i] - r[i].size(), ' ');
      if (i > 0) line += "  ";
      line += i == 0 ? r[i] + pad : pad + r[i];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::string stage_table(const google::protobuf::RepeatedPtrField<v1::StageReport>& stages) {
  if (stages.empty()) return "no stage has begun\n";
  using S = v1::StageReport;
  const auto done = [](const S& s, std::string text) { return s.finished() ? text : std::string("..."); };
  std::vector<Row> rows;
  rows.push_back(row("stage", stages, [](const S& s) { return s.name(); }));
  rows.push_back(row("cells", stages, [](const S& s) { return grouped(s.cell_count()); }));
  rows.push_back(row("finest cell", stages, [](const S& s) { return formatted(1000 * s.finest_cell_m(), "%.4g mm"); }));
  rows.push_back(row("time step", stages, [](const S& s) { return formatted(1000 * s.dt_s(), "%.4g ms"); }));
  rows.push_back(row("steps", stages, [&](const S& s) { return done(s, grouped(s.step_count())); }));
  rows.push_back(row("time", stages, [&](const S& s) {
    return formatted(s.start_time_s(), "%.2f") + " - " + done(s, formatted(s.end_time_s(), "%.2f s"));
  }));
  rows.push_back(row("converged", stages, [&](const S& s) { return done(s, s.converged() ? "yes" : "no"); }));
  for (const std::string& phase : phases_of(stages)) {
    std::string title = "CPU s ";
    title += phase;
    rows.push_back(row(title, stages, [&](const S& s) { return done(s, formatted(phase_cpu(s, phase), "%.2f")); }));
  }
  rows.push_back(row("CPU s in all", stages, [&](const S& s) { return done(s, formatted(s.cpu_s(), "%.2f")); }));
  rows.push_back(row("wall time", stages, [&](const S& s) { return done(s, formatted(s.wall_s(), "%.1f s")); }));
  rows.push_back(row("mapping", stages, [](const S& s) {
    return s.has_mapping() ? s.mapping().method() + formatted(s.mapping().cpu_s(), " %.3f s") : std::string("-");
  }));
  rows.push_back(row("pressure iter.", stages, [&](const S& s) {
    return done(s, formatted(s.mean_pressure_iterations(), "%.1f") + formatted(s.max_pressure_iterations(), " (max %.0f)"));
  }));
  rows.push_back(row("volume drift", stages, [&](const S& s) { return done(s, formatted(s.volume_drift(), "%.1e")); }));
  if (std::any_of(stages.begin(), stages.end(), [](const S& s) { return s.wall_layers_size() > 0; }))
    rows.push_back(row("y+ at the hull", stages, [](const S& s) {
      return s.wall_layers_size() > 0 ? formatted(s.wall_layers(0).y_plus_mean(), "%.0f") +
                                            formatted(s.wall_layers(0).y_plus_min(), " (%.0f") +
                                            formatted(s.wall_layers(0).y_plus_max(), " - %.0f)")
                                      : std::string("-");
    }));
  rows.push_back(row("roll amplitude", stages, [](const S& s) { return amplitude(s, "roll"); }));
  rows.push_back(row("heave amplitude", stages, [](const S& s) { return amplitude(s, "heave"); }));
  return align(rows);
}

std::string hydrostatics(const v1::Hydrostatics& h, int dimension) {
  const bool section = dimension == 2;
  const auto mm = [](double metres) { return formatted(1000 * metres, "%.1f mm"); };
  std::vector<Row> rows{{"mass", formatted(h.mass(), "%.4g") + (section ? " kg/m" : " kg")},
                {"displaced volume", formatted(h.displaced_volume(), "%.5g") + (section ? " m2" : " m3")},
                {"draft", mm(h.draft_m())},
                {"heel", formatted(h.heel_deg(), "%.2f deg")},
                {"KB", mm(h.kb_m())},
                {"BM", mm(h.bm_m())},
                {"GM", mm(h.gm_m())},
                {"draft, intact", mm(h.intact_draft_m())},
                {"GM, intact", mm(h.intact_gm_m())},
                {"roll period, dry", formatted(h.natural_roll_period_dry_s(), "%.3f s")}};
  if (!section) {
    rows.push_back({"trim, bow down", formatted(h.trim_deg(), "%.3f deg")});
    rows.push_back({"LCB", mm(h.lcb_m())});
    rows.push_back({"wetted surface", formatted(h.wetted_surface_m2(), "%.4g m2")});
  }
  return align(rows);
}

std::string cost(const google::protobuf::RepeatedPtrField<v1::StageEstimate>& stages) {
  std::vector<Row> rows{{"stage", "cells", "steps", "time step", "CPU time"}};
  double total = 0;
  for (const auto& s : stages) {
    rows.push_back({s.name(), grouped(s.cell_count()), grouped(s.step_count()), formatted(1000 * s.dt_s(), "%.3g ms"),
                    duration(s.cpu_s())});
    total += s.cpu_s();
  }
  rows.push_back({"in all", "", "", "", duration(total)});
  return align(rows);
}

std::string diagnostics(const google::protobuf::RepeatedPtrField<v1::Diagnostic>& list, const yaml::SourceMap& lines) {
  std::string out;
  for (const auto& d : list) {
    const bool warning = d.severity() == v1::Diagnostic::SEVERITY_WARNING;
    out += yaml::to_text(lines.file(), {lines.find(d.field()), d.field(), (warning ? "warning: " : "") + d.message(), d.hint()});
    out += '\n';
  }
  return out;
}

std::string duration(double seconds) {
  if (seconds < 0) return "?";
  if (seconds < 10) return formatted(seconds, "%.1f s");
  if (seconds < 60) return formatted(seconds, "%.0f s");
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

}  // namespace seaway::report_text
