// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/reports/decay_report.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "core/analysis/decay.hpp"
#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "server/convert/checker.hpp"
#include "server/convert/input_error.hpp"

namespace seaway::reports {
namespace {

void put(const analysis::Estimate& from, v1::Estimate& to) {
  to.set_value(from.value);
  if (from.interval >= 0) to.set_interval(from.interval);
}

/// The samples that the options leave, from the release on.
analysis::Signal select(const History& history, const History::Channel& channel, const v1::DecayOptions& options) {
  const auto& t = history.times;
  const auto first = options.has_from_s() ? std::lower_bound(t.begin(), t.end(), options.from_s()) : t.begin();
  const auto last = options.has_until_s() ? std::upper_bound(t.begin(), t.end(), options.until_s()) : t.end();
  if (last - first < 8)
    fail(ErrorCode::failed_precondition, "{} samples in the part to analyse; run longer or choose another part", std::max<std::ptrdiff_t>(last - first, 0));
  const auto from = static_cast<std::size_t>(first - t.begin()), count = static_cast<std::size_t>(last - first);
  analysis::Signal signal{std::span(t).subspan(from, count), std::span(channel.values).subspan(from, count)};
  const std::size_t release = analysis::begin_of_motion(signal);
  return {signal.t.subspan(release), signal.x.subspan(release)};
}

void put(const analysis::Decay& decay, v1::DecayReport& out) {
  for (const double t : decay.crossings) out.add_crossings_s(t);
  for (std::size_t i = 0; i < decay.peaks.size(); ++i) {
    const analysis::DecayPeak& from = decay.peaks[i];
    v1::DecayPeak& to = *out.add_peaks();
    to.set_index(static_cast<int>(i));
    to.set_time_s(from.time);
    to.set_angle(from.angle);
    if (from.period) to.set_period_s(*from.period);
    if (from.loss) to.set_loss(*from.loss);
    if (from.mean) to.set_mean_angle(*from.mean);
    if (from.damping_ratio) to.set_damping_ratio(*from.damping_ratio);
  }
  for (const analysis::DecayCycle& from : decay.cycles) {
    v1::DecayCycle& to = *out.add_cycles();
    to.set_number(from.number);
    to.set_angle(from.angle);
    to.set_period_s(from.period);
    to.set_damping_ratio(from.damping_ratio);
  }
  if (!decay.cycles.empty()) put(decay.mean_period, *out.mutable_mean_period_s());
  v1::DampedCosine& cosine = *out.mutable_damped_cosine();
  put(decay.damped_cosine.period, *cosine.mutable_period_s());
  put(decay.damped_cosine.damping_ratio, *cosine.mutable_damping_ratio());
  put(decay.damped_cosine.amplitude, *cosine.mutable_amplitude());
  put(decay.damped_cosine.mean, *cosine.mutable_mean());
  cosine.set_phase_deg(decay.damped_cosine.phase / degree);
  cosine.set_start_time_s(decay.damped_cosine.start);
  cosine.set_residual(decay.damped_cosine.residual);
  if (!decay.extinction) return;
  v1::Extinction& extinction = *out.mutable_extinction();
  put(decay.extinction->linear, *extinction.mutable_linear());
  put(decay.extinction->quadratic, *extinction.mutable_quadratic());
  put(decay.extinction->mean, *extinction.mutable_mean());
  extinction.set_residual(decay.extinction->residual);
}

}  // namespace

void check_options(const v1::DecayOptions& options) {
  convert::Checker check;
  check.finite(options, "options");
  if (!options.channel().empty()) check.line("options.channel", options.channel(), 60);
  if (options.has_smallest_peak()) check.number("options.smallest_peak", options.smallest_peak(), {0.001, 0.5});
  if (options.has_from_s() && options.has_until_s() && !(options.from_s() < options.until_s()))
    check.problem("options.until_s", "is not later than from_s", "give a later time");
  if (!check.ok()) throw convert::InputError("INVALID_REQUEST", check.take());
}

std::string find_channel(const std::string& source, const std::vector<std::string>& names, const v1::DecayOptions& options) {
  if (names.empty()) fail(ErrorCode::failed_precondition, "{} has no samples yet; ask again when it has run", source);
  std::string name = options.channel().empty() ? "roll" : options.channel();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw convert::InputError("INVALID_REQUEST",
                              {{sim::Diagnostic::Severity::error, "options.channel", fmt::format("'{}' is no channel of {}", name, source),
                                fmt::format("choose one of {}", fmt::join(names, ", "))}});
  return name;
}

v1::DecayReport make_decay_report(const Run& run, const v1::DecayOptions& options) {
  check_options(options);
  std::vector<std::string> names;
  for (const History::Channel& channel : run.history.channels) names.push_back(channel.name);
  const History::Channel* channel = run.history.find(find_channel(run.source, names, options));
  v1::DecayReport out;
  out.set_source(run.source);
  out.set_title(run.title);
  out.set_channel(channel->name);
  out.set_unit(channel->unit);
  analysis::DecayOptions core;
  if (options.has_smallest_peak()) core.smallest_peak = options.smallest_peak();
  put(analysis::analyse_decay(select(run.history, *channel, options), core), out);
  return out;
}

}  // namespace seaway::reports
