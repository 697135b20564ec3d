// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/reports/rao_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/analysis/harmonic.hpp"
#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/motion/pose.hpp"
#include "core/sim/build_wave.hpp"
#include "server/convert/case.hpp"
#include "server/convert/checker.hpp"
#include "server/convert/input_error.hpp"

namespace seaway::reports {
namespace {

/// What the harmonic fit needs to know of the wave.
struct WaveFacts {
  double omega = 0, wave_number = 0, amplitude = 0;  ///< [rad/s, 1/m, m]
  double heading = 0, phase = 0;                     ///< [rad]
};

struct Part {
  std::vector<double> t, x;
};

/// The samples of the last stage: earlier ones are coarser.
Part last_stage(const History& history, const std::vector<double>& values) {
  Part out;
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    if (history.stages[i] != history.stages.back()) continue;
    out.t.push_back(history.times[i]);
    out.x.push_back(values[i]);
  }
  return out;
}

/// Phase of the undisturbed wave's elevation cos(omega t + lead) at a place.
double lead_at(const WaveFacts& w, double x, double y) {
  return w.phase - w.wave_number * (x * std::cos(w.heading) + y * std::sin(w.heading));
}

v1::MotionResponse response(const History::Channel& channel, const analysis::Harmonic& f, const WaveFacts& w, double lead) {
  v1::MotionResponse m;
  m.set_channel(channel.name);
  m.set_unit(channel.unit);
  m.set_mean(f.mean);
  m.set_amplitude(f.amplitude);
  m.set_phase_deg(analysis::wrap(f.phase - lead) / degree);
  m.set_amplitude_scatter(f.amplitude_scatter);
  m.set_phase_scatter_deg(f.phase_scatter / degree);
  m.set_amplitude_trend(f.amplitude_trend);
  m.set_second_harmonic(f.second);
  const bool rotation = channel.unit == "deg";
  const double unit = rotation ? w.wave_number * w.amplitude / degree : w.amplitude;
  m.set_rao(f.amplitude / unit);
  m.set_rao_scatter(f.amplitude_scatter / unit);
  if (rotation) m.set_per_metre(f.amplitude / w.amplitude);
  return m;
}

/// Mean displacement of the hull over the last periods; 0 if it has no such channel.
double mean_of(const History& history, const char* name, double omega, int periods) {
  const History::Channel* channel = history.find(name);
  if (channel == nullptr) return 0;
  const Part part = last_stage(history, channel->values);
  return analysis::fit_harmonic({part.t, part.x}, omega, periods).mean;
}

void fill_motions(const Run& run, const sim::Case& c, const WaveFacts& w, int periods, v1::RaoPoint& point) {
  const double x = c.body.cog.x() + mean_of(run.history, "surge", w.omega, periods);
  const double y = c.body.cog.y() + mean_of(run.history, "sway", w.omega, periods);
  const double lead = lead_at(w, x, y);
  for (const char* name : motion::dof_names) {
    const History::Channel* channel = run.history.find(name);
    if (channel == nullptr) continue;
    const Part part = last_stage(run.history, channel->values);
    if (!std::all_of(part.x.begin(), part.x.end(), [](double v) { return std::isfinite(v); }))
      fail(ErrorCode::failed_precondition, "{} holds values that are not finite", name);
    if (std::all_of(part.x.begin(), part.x.end(), [&](double v) { return v == part.x.front(); })) continue;  // held
    const analysis::Harmonic f = analysis::fit_harmonic({part.t, part.x}, w.omega, periods);
    *point.add_motions() = response(*channel, f, w, lead);
    point.set_period_count(f.periods);
    point.set_from_s(f.from);
    point.set_until_s(f.until);
  }
}

void fill(const Run& run, int periods, v1::RaoPoint& point) {
  if (!run.has_case) fail(ErrorCode::failed_precondition, "there is no case.yaml beside the history, so that the wave is unknown");
  const sim::Case c = convert::to_core(run.message);
  if (c.wave.kind != sim::Wave::Kind::regular) fail(ErrorCode::failed_precondition, "the case has no regular wave");
  const auto wave = sim::build_wave(c);
  const WaveFacts facts{2 * pi / wave->period(), 2 * pi / wave->length(), 0.5 * c.wave.height, c.wave.heading, c.wave.phase};
  point.set_period_s(wave->period());
  point.set_wave_length_m(wave->length());
  point.set_wave_height_m(c.wave.height);
  point.set_heading_deg(c.wave.heading / degree);
  point.set_wave_slope_deg(facts.wave_number * facts.amplitude / degree);
  if (run.history.times.empty()) fail(ErrorCode::failed_precondition, "there are no samples yet");
  fill_motions(run, c, facts, periods, point);
  if (point.motions_size() == 0) fail(ErrorCode::failed_precondition, "no motion is free");
  if (point.period_count() < periods)
    point.set_message(fmt::format("only {} of {} periods", point.period_count(), periods));
}

}  // namespace

void check_options(const v1::RaoOptions& options) {
  convert::Checker check;
  if (options.has_period_count()) check.count("options.period_count", options.period_count(), 1, 1000);
  if (!check.ok()) throw convert::InputError("INVALID_REQUEST", check.take());
}

v1::RaoPoint make_rao_point(const Run& run, const v1::RaoOptions& options) {
  v1::RaoPoint point;
  point.set_source(run.source);
  point.set_title(run.title);
  point.set_case_name(run.case_name.empty() ? run.title : run.case_name);
  try {
    fill(run, options.has_period_count() ? options.period_count() : 5, point);
  } catch (const std::exception& error) {
    point.clear_motions();
    point.set_message(error.what());
  }
  return point;
}

v1::RaoReport make_rao_report(const std::string& title, std::vector<v1::RaoPoint> points) {
  std::set<std::string> names;
  for (const auto& p : points) names.insert(p.case_name());
  if (names.size() == points.size())  // titles that name the wave do not name a curve
    for (auto& p : points) p.clear_case_name();
  const auto key = [](const v1::RaoPoint& p) {
    return std::tuple(p.case_name(), p.heading_deg(), p.wave_height_m(), p.period_s());
  };
  std::stable_sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  v1::RaoReport out;
  out.set_title(title);
  for (auto& point : points) *out.add_points() = std::move(point);
  return out;
}

}  // namespace seaway::reports
