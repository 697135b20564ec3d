// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/wave_command.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/sim/build_wave.hpp"
#include "server/calibration.hpp"
#include "server/convert/case.hpp"
#include "server/file_observer.hpp"
#include "server/gnuplot.hpp"
#include "server/jobs/workspace.hpp"
#include "server/signal_stop.hpp"

namespace seaway::server {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const char* kind_of(const sim::Wave& w) {
  switch (w.kind) {
    case sim::Wave::Kind::none: return "calm";
    case sim::Wave::Kind::regular: return "regular";
    case sim::Wave::Kind::irregular: return "irregular";
    case sim::Wave::Kind::focused: return "focused";
    case sim::Wave::Kind::time_series: return "time_series";
  }
  return "?";
}

/// What the case asks for, without running anything.
struct Asked {
  std::shared_ptr<const waves::WaveField> wave;
  std::optional<waves::LinearSeaSpec> sea;
  waves::SeaStatistics realised;
  double x = 0, y = 0;  ///< of the ship
  std::vector<double> t, elevation;
  double highest = 0, lowest = 0;
};

Asked ask(const sim::Case& c, double duration) {
  Asked out;
  out.wave = sim::build_wave(c);
  if (out.wave == nullptr) fail(ErrorCode::invalid_argument, "the case has no waves");
  if (c.wave.kind != sim::Wave::Kind::regular) {
    out.sea = sim::sea_of(c);
    out.realised = waves::statistics(out.sea->components);
  }
  out.x = c.body.cog.x() + c.body.offset.x();
  out.y = c.body.cog.y() + c.body.offset.y();
  const double period = out.wave->period(), length = duration > 0 ? duration : 20 * period;
  for (double t = 0; t <= length; t += period / 60) {
    out.t.push_back(t);
    out.elevation.push_back(out.wave->elevation(out.x, out.y, t));
  }
  out.highest = *std::max_element(out.elevation.begin(), out.elevation.end());
  out.lowest = *std::min_element(out.elevation.begin(), out.elevation.end());
  return out;
}

json to_json(const sim::Case& c, const Asked& a) {
  const waves::WaveField& w = *a.wave;
  json out{{"kind", kind_of(c.wave)},
           {"height_m", w.height()},
           {"period_s", w.period()},
           {"length_m", w.length()},
           {"celerity_m_per_s", w.celerity()},
           {"depth_m", w.depth()},
           {"relative_depth_kd", 2 * pi / w.length() * w.depth()},
           {"steepness", w.height() / w.length()},
           {"heading_deg", w.heading() / degree},
           {"mean_eulerian_velocity_m_per_s", w.mean_eulerian_velocity()},
           {"mean_transport_m2_per_s", w.mean_transport()},
           {"at_ship", {{"x_m", a.x}, {"y_m", a.y}, {"duration_s", a.t.back()}, {"highest_m", a.highest}, {"lowest_m", a.lowest}}}};
  if (!a.sea) return out;
  out["realised"] = {{"significant_height_m", a.realised.significant_height},
                     {"zero_crossing_period_s", a.realised.zero_crossing_period},
                     {"energy_period_s", a.realised.energy_period}};
  out["components"] = json::array();
  for (const waves::Component& one : a.sea->components)
    out["components"].push_back({{"amplitude_m", one.amplitude}, {"frequency_hz", one.frequency}, {"phase_deg", one.phase / degree}});
  return out;
}

void print(const sim::Case& c, const Asked& a) {
  const waves::WaveField& w = *a.wave;
  std::printf("%s wave\n", kind_of(c.wave));
  std::printf("  %-24s %10.5g m\n", a.sea ? "Hs asked for" : "height", w.height());
  std::printf("  %-24s %10.5g s\n  %-24s %10.5g m\n  %-24s %10.5g m/s\n", a.sea ? "peak period" : "period", w.period(),
              a.sea ? "length at the peak" : "length", w.length(), "celerity", w.celerity());
  std::printf("  %-24s %10.5g m, k d = %.4g\n  %-24s %10.5g\n  %-24s %10.5g deg\n", "depth", w.depth(), 2 * pi / w.length() * w.depth(),
              "height / length", w.height() / w.length(), "heading", w.heading() / degree);
  std::printf("  %-24s %10.5g m/s\n  %-24s %10.5g m2/s\n", "mean velocity at a point", w.mean_eulerian_velocity(), "mean transport",
              w.mean_transport());
  if (a.sea) {
    std::printf("as it is made, of %zu linear waves from %.4g to %.4g Hz\n", a.sea->components.size(), a.sea->components.front().frequency,
                a.sea->components.back().frequency);
    std::printf("  %-24s %10.5g m\n  %-24s %10.5g s\n  %-24s %10.5g s\n", "Hs", a.realised.significant_height, "Tz",
                a.realised.zero_crossing_period, "Te", a.realised.energy_period);
  }
  std::printf("at the ship, x = %.4g m, y = %.4g m, undisturbed, %.4g s\n  %-24s %10.5g m\n  %-24s %10.5g m\n", a.x, a.y, a.t.back(), "highest",
              a.highest, "lowest", a.lowest);
}

Figure picture_of(const sim::Case& c, const Asked& a) {
  Figure out;
  std::string& elevation = out.data["elevation.dat"];
  for (std::size_t i = 0; i < a.t.size(); ++i) elevation += fmt::format("{:.6g} {:.6g}\n", a.t[i], 1000 * a.elevation[i]);
  const bool spectrum = a.sea && c.wave.kind == sim::Wave::Kind::irregular;
  std::string s = fmt::format("set terminal pngcairo size 1100,{} font ',12'\nset output 'wave.png'\nset grid lc rgb '#dddddd'\nset multiplot layout {},1\n",
                              spectrum ? 760 : 400, spectrum ? 2 : 1);
  if (spectrum) {
    const waves::Spectrum density(sim::spectrum_of(c));
    const auto& sea = a.sea->components;
    std::string& line = out.data["spectrum.dat"];
    const double top = sea.back().frequency * 1.1;
    for (int i = 1; i <= 400; ++i) line += fmt::format("{:.6g} {:.6g}\n", top * i / 400, density(top * i / 400));
    std::string& bars = out.data["components.dat"];
    const double fp = 1 / c.wave.spectrum.peak_period, width = (c.wave.spectrum.upper_cutoff - c.wave.spectrum.lower_cutoff) * fp / c.wave.spectrum.components;
    for (const auto& one : sea) bars += fmt::format("{:.6g} {:.6g}\n", one.frequency, 0.5 * one.amplitude * one.amplitude / width);
    s += "set xlabel 'frequency [Hz]'\nset ylabel 'S [m^2/Hz]' noenhanced\nplot 'spectrum.dat' with lines lw 2 lc rgb '#4477aa' title 'asked for', "
         "'components.dat' with impulses lw 1.5 lc rgb '#ee6677' title 'made'\n";
  }
  s += "set key off\nset xlabel 'time [s]'\nset ylabel 'elevation at the ship [mm]'\nplot 'elevation.dat' with lines lw 1.5 lc rgb '#4477aa'\nunset multiplot\n";
  out.script = s;
  return out;
}

struct Run {
  sim::RunOutcome outcome;
  Calibration found;
};

Run calibrate(const sim::Case& c, const WaveOptions& o, const jobs::Solver& solver) {
  const EmptyTank tank = empty_tank(c, o.duration);
  const sim::CaseReport report = solver.check(tank.tank);
  for (const sim::Diagnostic& d : report.diagnostics)
    if (d.severity == sim::Diagnostic::Severity::error)
      fail(ErrorCode::invalid_argument, "the empty tank of this case: {}: {}; {}", d.field, d.message, d.hint);
  fs::create_directories(o.run_folder);
  FileObserver observer(o.run_folder, [](const sim::Progress&, const FileObserver&) {});
  SignalStop signals;
  sim::RunOptions options;
  options.folder = fs::absolute(o.run_folder).string();
  options.case_digest = jobs::sha256_hex(convert::to_proto(tank.tank).SerializeAsString());
  auto log = std::make_shared<spdlog::logger>("seaway-run", std::make_shared<spdlog::sinks::basic_file_sink_mt>(o.run_folder + "/log.txt"));
  const int threads = o.threads > 0 ? o.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  Run out;
  out.outcome = solver.run(tank.tank, options, observer, RunContext{log, signals.token(), threads});
  log->flush();
  if (out.outcome.reason == sim::StopReason::finished) out.found = evaluate(tank, o.run_folder);
  return out;
}

json to_json(const Calibration& k) {
  json out{{"height_m", k.height}, {"asked_height_m", k.asked_height}, {"period_s", k.period},   {"asked_period_s", k.asked_period},
           {"length_m", k.length}, {"asked_length_m", k.asked_length}, {"reflection", k.reflection}};
  if (k.peak_period > 0) {
    out["peak_period_s"] = k.peak_period;
    out["asked_peak_period_s"] = k.asked_peak_period;
  }
  return out;
}

void print(const Calibration& k) {
  const auto line = [](const char* name, double found, double asked, const char* unit) {
    std::printf("  %-24s %10.5g %s, asked for %.5g (%+.2f %%)\n", name, found, unit, asked, 100 * (found / asked - 1));
  };
  std::printf("in the empty tank, at the ship\n");
  line(k.peak_period > 0 ? "Hs" : "height", k.height, k.asked_height, "m");
  line(k.peak_period > 0 ? "mean up-crossing period" : "period", k.period, k.asked_period, "s");
  if (k.peak_period > 0) line("peak period", k.peak_period, k.asked_peak_period, "s");
  line("length", k.length, k.asked_length, "m");
  std::printf("  %-24s %10.3g\n", "reflection", k.reflection);
}

}  // namespace

int print_wave(const sim::Case& c, const WaveOptions& o, const jobs::Solver& solver) {
  const Asked asked = ask(c, o.duration);
  json out = to_json(c, asked);
  if (!o.json) print(c, asked);
  if (!o.folder.empty()) {
    draw_figure(o.folder, "wave", picture_of(c, asked));
    if (!o.json) std::printf("wrote %s/wave.png\n", o.folder.c_str());
  }
  int code = 0;
  if (o.calibrate) {
    std::fflush(stdout);
    const Run run = calibrate(c, o, solver);
    if (run.outcome.reason != sim::StopReason::finished) {
      std::fprintf(stderr, "seaway-run: the empty tank did not come to its end%s%s\n", run.outcome.message.empty() ? "" : ": ", run.outcome.message.c_str());
      code = run.outcome.reason == sim::StopReason::cancelled ? 3 : 1;
    } else if (o.json) {
      out["calibration"] = to_json(run.found);
    } else {
      print(run.found);
    }
  }
  if (o.json) std::printf("%s\n", out.dump().c_str());
  return code;
}

}  // namespace seaway::server
