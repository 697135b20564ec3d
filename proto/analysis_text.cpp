// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/analysis_text.hpp"

#include <algorithm>
#include <vector>

#include "proto/report_text.hpp"
#include "proto/text.hpp"

namespace seaway::report_text {
namespace {

using Row = std::vector<std::string>;

std::string number(double value) { return formatted(value, "%.4g"); }

/// 1.515 +- 0.002 s
std::string estimate(const v1::Estimate& e, const std::string& unit) {
  std::string text = formatted(e.value(), "%.5g");
  if (e.has_interval()) text += " +- " + formatted(e.interval(), "%.2g");
  return unit.empty() ? text : text + " " + unit;
}

std::string peaks_table(const v1::DecayReport& r) {
  std::vector<Row> rows{{"turning point", "time", "from the mean", "period", "loss", "mean angle", "damping ratio"}};
  const std::string unit = " " + r.unit();
  for (const auto& p : r.peaks())
    rows.push_back({std::to_string(p.index()), formatted(p.time_s(), "%.3f s"), formatted(p.angle(), "%.3f") + unit,
                    p.has_period_s() ? formatted(p.period_s(), "%.4f s") : "-", p.has_loss() ? number(p.loss()) + unit : "-",
                    p.has_mean_angle() ? number(p.mean_angle()) + unit : "-",
                    p.has_damping_ratio() ? number(p.damping_ratio()) : "-"});
  return align(rows);
}

std::string cycles_table(const v1::DecayReport& r) {
  std::vector<Row> rows{{"cycle", "begins at", "period", "damping ratio"}};
  for (const auto& c : r.cycles())
    rows.push_back({std::to_string(c.number()), formatted(c.angle(), "%.3f ") + r.unit(), formatted(c.period_s(), "%.4f s"),
                    number(c.damping_ratio())});
  return align(rows);
}

/// The motions that some point has, in order.
std::vector<std::string> motions_of(const v1::RaoReport& r) {
  std::vector<std::string> out;
  for (const char* name : {"surge", "sway", "heave", "roll", "pitch", "yaw"})
    for (const auto& point : r.points())
      if (std::any_of(point.motions().begin(), point.motions().end(), [&](const auto& m) { return m.channel() == name; })) {
        out.emplace_back(name);
        break;
      }
  return out;
}

const v1::MotionResponse* find(const v1::RaoPoint& point, const std::string& channel) {
  for (const auto& m : point.motions())
    if (m.channel() == channel) return &m;
  return nullptr;
}

void add_motion(const v1::MotionResponse* m, Row& row) {
  if (m == nullptr) {
    row.insert(row.end(), {"-", "-", "-"});
    return;
  }
  row.push_back(number(m->amplitude()) + " " + m->unit());
  row.push_back(formatted(m->rao(), "%.3f") + " +- " + formatted(m->rao_scatter(), "%.3f"));
  row.push_back(formatted(m->phase_deg(), "%.1f deg"));
}

}  // namespace

std::string decay_table(const v1::DecayReport& r) {
  std::string out = r.source() + (r.title().empty() ? "" : "  " + r.title()) + "\n" + r.channel() + " decay\n\n" + peaks_table(r) + "\n";
  if (r.cycles_size() > 0) out += cycles_table(r) + "\n";
  std::vector<Row> rows;
  if (r.has_mean_period_s()) rows.push_back({"mean period of the cycles", estimate(r.mean_period_s(), "s")});
  const v1::DampedCosine& c = r.damped_cosine();
  rows.push_back({"damped cosine: period", estimate(c.period_s(), "s")});
  rows.push_back({"  damping ratio", estimate(c.damping_ratio(), "")});
  rows.push_back({"  amplitude", estimate(c.amplitude(), r.unit())});
  rows.push_back({"  mean", estimate(c.mean(), r.unit())});
  rows.push_back({"  left over, rms", number(c.residual()) + " " + r.unit()});
  if (r.has_extinction()) {
    const v1::Extinction& e = r.extinction();
    rows.push_back({"extinction: linear", estimate(e.linear(), "")});
    rows.push_back({"  quadratic", estimate(e.quadratic(), "1/" + r.unit())});
    rows.push_back({"  mean", estimate(e.mean(), r.unit())});
    rows.push_back({"  left over, rms", number(e.residual()) + " " + r.unit()});
  } else {
    rows.push_back({"extinction", "needs five turning points"});
  }
  return out + align(rows) + "intervals: 95 %; loss per half cycle = linear m + quadratic m^2, m the mean of two turning points\n";
}

std::string rao_table(const v1::RaoReport& r) {
  const auto motions = motions_of(r);
  const bool cases = std::any_of(r.points().begin(), r.points().end(), [](const auto& p) { return !p.case_name().empty(); });
  Row head{"run"};
  if (cases) head.emplace_back("case");
  for (const char* title : {"period", "height", "heading", "length", "slope"}) head.emplace_back(title);
  for (const auto& name : motions) head.insert(head.end(), {name, "RAO", "phase"});
  std::vector<Row> rows{head};
  std::string remarks;
  for (const auto& p : r.points()) {
    Row row{p.source()};
    if (cases) row.push_back(p.case_name());
    row.insert(row.end(), {formatted(p.period_s(), "%.3f s"), formatted(p.wave_height_m(), "%.4g m"), formatted(p.heading_deg(), "%.4g deg"),
                           formatted(p.wave_length_m(), "%.3f m"), formatted(p.wave_slope_deg(), "%.3f deg")});
    for (const auto& name : motions) add_motion(find(p, name), row);
    rows.push_back(std::move(row));
    if (!p.message().empty()) remarks += p.source() + ": " + p.message() + "\n";
  }
  std::string out = r.title().empty() ? "" : r.title() + "\n";
  out += align(rows);
  if (!motions.empty())
    out += "RAO: translations over H/2, rotations over k H/2, +- their scatter over periods; phase from the crest at the cog, positive leads\n";
  return out + remarks;
}

}  // namespace seaway::report_text
