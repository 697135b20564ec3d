// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/calibration.hpp"

#include <algorithm>
#include <cmath>

#include "core/analysis/harmonic.hpp"
#include "core/analysis/wave_gauges.hpp"
#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/sim/build_wave.hpp"
#include "core/waves/airy.hpp"
#include "server/reports/history.hpp"

namespace seaway::server {
namespace {

const char* const gauge_names[3] = {"ship", "second", "third"};

struct Record {
  std::vector<double> t, x;
  analysis::Signal signal() const { return {t, x}; }
};

Record window_of(const reports::History& history, const std::string& gauge, double from) {
  const auto* channel = history.find("gauge." + gauge);
  if (channel == nullptr) fail(ErrorCode::data_loss, "the history has no gauge '{}'", gauge);
  Record out;
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    if (history.times[i] < from) continue;
    out.t.push_back(history.times[i]);
    out.x.push_back(channel->values[i]);
  }
  return out;
}

/// Mean over whole periods of the difference of the highest and lowest sample.
double mean_height(const Record& r, double period) {
  double sum = 0;
  int n = 0;
  for (double from = r.t.front(); from + period <= r.t.back() * (1 + 1e-12); from += period, ++n) {
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < r.t.size(); ++i) {
      if (r.t[i] < from || r.t[i] > from + period) continue;
      low = std::min(low, r.x[i]);
      high = std::max(high, r.x[i]);
    }
    sum += high - low;
  }
  return n > 0 ? sum / n : 0;
}

void evaluate_regular(const EmptyTank& tank, const waves::WaveField& wave, const std::array<Record, 3>& gauges, Calibration& out) {
  const double omega = 2 * pi / wave.period(), k = 2 * pi / wave.length();
  const int periods = static_cast<int>(std::round(tank.duration / wave.period()));
  std::vector<analysis::Gauge> lines;
  for (std::size_t g = 0; g < 3; ++g) {
    const analysis::Harmonic h = analysis::fit_harmonic(gauges[g].signal(), omega, periods);
    lines.push_back({tank.places[g], {std::polar(h.amplitude, h.phase)}});
  }
  const analysis::Separation s = analysis::separate(lines, {k});
  out.reflection = s.reflection;
  // A reflection turns the phases by up to its own size, so that the longest distance is the best one.
  const double turn = std::arg(lines[2].amplitudes[0] * std::conj(lines[0].amplitudes[0]));
  const double whole = -k * (tank.places[2] - tank.places[0]);
  out.length = -2 * pi * (tank.places[2] - tank.places[0]) / (whole + std::remainder(turn - whole, 2 * pi));
  out.asked_length = wave.length();
  out.height = mean_height(gauges[0], wave.period());
  out.asked_height = wave.crest() - wave.trough();
  out.period = analysis::mean_up_crossing_period(gauges[0].signal());
  out.asked_period = wave.period();
}

void evaluate_sea(const EmptyTank& tank, const waves::WaveField& wave, const std::array<Record, 3>& gauges, Calibration& out) {
  const sim::Case& c = tank.tank;
  const auto components = sim::sea_of(c).components;
  const double lower = components.front().frequency, upper = components.back().frequency;
  const auto f = analysis::frequencies_of(gauges[0].t.back() - gauges[0].t.front(), lower, upper);
  std::vector<double> k;
  for (const double one : f) k.push_back(waves::linear_wave_number(2 * pi * one, wave.depth(), wave.gravity()));
  std::vector<analysis::Gauge> lines;
  for (std::size_t g = 0; g < 3; ++g) lines.push_back({tank.places[g], analysis::transform(gauges[g].signal(), f)});
  out.reflection = analysis::separate(lines, k).reflection;
  Record asked{gauges[0].t, {}};
  for (const double t : asked.t) asked.x.push_back(wave.elevation(c.outputs.gauges[0].x, c.outputs.gauges[0].y, t));
  out.height = analysis::significant_height(gauges[0].signal());
  out.asked_height = analysis::significant_height(asked.signal());
  out.period = analysis::mean_up_crossing_period(gauges[0].signal());
  out.asked_period = analysis::mean_up_crossing_period(asked.signal());
  const double width = 0.05 / wave.period();
  out.peak_period = analysis::peak_period(f, lines[0].amplitudes, width);
  out.asked_peak_period = analysis::peak_period(f, analysis::transform(asked.signal(), f), width);
  // At the peak, weighted with the energy there: the turn of phase from the first to the last gauge.
  std::complex<double> turn = 0;
  for (std::size_t i = 0; i < f.size(); ++i)
    if (std::abs(f[i] * wave.period() - 1) < 0.1) turn += lines[2].amplitudes[i] * std::conj(lines[0].amplitudes[i]);
  const double distance = tank.places[2] - tank.places[0], whole = -2 * pi / wave.length() * distance;
  out.length = -2 * pi * distance / (whole + std::remainder(std::arg(turn) - whole, 2 * pi));
  out.asked_length = wave.length();
}

}  // namespace

EmptyTank empty_tank(const sim::Case& c, double duration) {
  const auto wave = sim::build_wave(c);
  if (wave == nullptr) fail(ErrorCode::invalid_argument, "the case has no waves");
  EmptyTank out;
  out.tank = c;
  out.tank.hull = {};
  out.tank.body = {};
  const bool sea = c.wave.kind != sim::Wave::Kind::regular;
  out.duration = duration > 0 ? duration : 20 * wave->period();
  if (!sea) out.duration = std::max(1.0, std::round(out.duration / wave->period())) * wave->period();
  const double heading = c.wave.heading;
  const bool along_x = std::abs(std::cos(heading)) > std::abs(std::sin(heading));
  const int axis = along_x ? 0 : 1;
  const double forward = along_x ? std::cos(heading) : std::sin(heading);
  // Energy goes with the group, at half the speed of crests or more: there, to the far end and back to the ship.
  const double length = c.tank.upper[axis] - c.tank.lower[axis];
  out.settle = std::ceil(2 * length / (0.5 * wave->celerity()) / wave->period()) * wave->period();
  const double ship[2] = {c.body.cog.x() + c.body.offset.x(), c.body.cog.y() + c.body.offset.y()};
  const double distance[3] = {0, 0.1 * wave->length(), 0.25 * wave->length()};
  out.tank.outputs.gauges.clear();
  for (std::size_t g = 0; g < 3; ++g) {
    double place[2] = {ship[0], ship[1]};
    place[axis] += forward * distance[g];
    if (!(place[axis] > c.tank.lower[axis] && place[axis] < c.tank.upper[axis]))
      fail(ErrorCode::invalid_argument, "a gauge a quarter of a wave behind the ship, at {:.4g} m, stands outside the tank; lengthen it", place[axis]);
    out.places[g] = place[0] * std::cos(heading) + place[1] * std::sin(heading);
    out.tank.outputs.gauges.push_back({gauge_names[g], place[0], place[1]});
  }
  out.tank.outputs.sample_interval = 0;
  out.tank.outputs.snapshot_interval = 0;
  sim::Stage stage = c.stages.back();
  stage.end = {};
  stage.end.duration = out.settle + out.duration;
  stage.mapping = {};
  stage.mesh.hull_cell = stage.mesh.hull_margin = stage.mesh.hull_heave = 0;  // there is no hull to follow
  out.tank.stages = {stage};
  if (out.tank.time.dt <= 0) out.tank.time.dt = wave->period() / std::ceil(c.time.steps_per_period);
  return out;
}

Calibration evaluate(const EmptyTank& tank, const std::string& folder) {
  const auto wave = sim::build_wave(tank.tank);
  const reports::History history = reports::read_history(folder + "/history.csv");
  std::array<Record, 3> gauges;
  for (std::size_t g = 0; g < 3; ++g) gauges[g] = window_of(history, gauge_names[g], tank.settle);
  if (gauges[0].t.size() < 16) fail(ErrorCode::failed_precondition, "{} is shorter than the time that the tank takes to settle", folder);
  Calibration out;
  if (tank.tank.wave.kind == sim::Wave::Kind::regular)
    evaluate_regular(tank, *wave, gauges, out);
  else
    evaluate_sea(tank, *wave, gauges, out);
  return out;
}

}  // namespace seaway::server
