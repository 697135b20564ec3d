// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/offline.hpp"

#include <pthread.h>
#include <signal.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "proto/json.hpp"
#include "proto/report_text.hpp"
#include "proto/yaml.hpp"
#include "server/convert/case.hpp"
#include "server/convert/input_error.hpp"
#include "server/convert/result.hpp"
#include "server/file_observer.hpp"
#include "server/hull_command.hpp"
#include "server/jobs/submission.hpp"
#include "server/report_commands.hpp"
#include "server/signal_stop.hpp"
#include "server/wave_command.hpp"

namespace seaway::server {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string case_file, folder;
  int threads = 0;
  double checkpoint_interval = 60;
  bool fresh = false, json = false, quiet = false;
};

struct Loaded {
  v1::Case message;
  yaml::SourceMap lines;
  sim::Case core;
  v1::CaseReport report;
};

/// Field problems come out as yaml::InputError with their lines.
sim::Case read_core(const std::string& file, const v1::Case& message, const yaml::SourceMap& lines) {
  try {
    sim::Case core = convert::to_core(message);
    core.folder = fs::absolute(file).parent_path().string();
    return core;
  } catch (const convert::InputError& error) {
    std::vector<yaml::Problem> problems;
    for (const auto& d : error.problems()) problems.push_back({lines.find(d.field), d.field, d.message, d.hint});
    throw yaml::InputError(file, std::move(problems));
  }
}

/// Reads and checks; field problems come out as yaml::InputError with their lines.
Loaded load(const std::string& file, const jobs::Solver& solver) {
  Loaded out;
  out.lines = yaml::read_file(file, out.message);
  out.core = read_core(file, out.message, out.lines);
  out.report = convert::to_proto(solver.check(out.core));
  return out;
}

void print_report(const Loaded& loaded, std::FILE* to) {
  const v1::CaseReport& r = loaded.report;
  std::fputs(report_text::diagnostics(r.diagnostics(), loaded.lines).c_str(), stderr);
  if (r.has_hydrostatics())
    std::fprintf(to, "hydrostatics\n%s\n", report_text::hydrostatics(r.hydrostatics(), loaded.message.dimension()).c_str());
  if (r.stages_size() > 0) std::fprintf(to, "estimated cost\n%s\n", report_text::cost(r.stages()).c_str());
}

int check(const Options& o, const jobs::Solver& solver) {
  const Loaded loaded = load(o.case_file, solver);
  if (o.json)
    std::printf("%s\n", to_json(loaded.report).c_str());
  else
    print_report(loaded, stdout);
  return loaded.report.ok() ? 0 : 2;
}

bool is_case(const std::string& file) {
  const std::string ending = fs::path(file).extension().string();
  return ending == ".yaml" || ending == ".yml";
}

int hull(const Options& o, const HullOptions& options) {
  if (!is_case(o.case_file)) return print_hull(case_of_hull_file(o.case_file, options), options);
  v1::Case message;
  const yaml::SourceMap lines = yaml::read_file(o.case_file, message);
  return print_hull(read_core(o.case_file, message, lines), options);
}

int wave(const Options& o, WaveOptions options, const jobs::Solver& solver) {
  v1::Case message;
  const yaml::SourceMap lines = yaml::read_file(o.case_file, message);
  const sim::Case core = read_core(o.case_file, message, lines);
  if (options.run_folder.empty()) options.run_folder = fs::path(o.case_file).stem().string() + ".calibration";
  return print_wave(core, options, solver);
}

/// As the service makes it, so that equal cases have equal digests.
std::string digest_of(const Loaded& loaded) {
  jobs::Files files;
  for (const std::string& name : std::set<std::string>{loaded.core.hull.offsets_file, loaded.core.wave.file}) {
    if (name.empty()) continue;
    std::ifstream in(fs::path(loaded.core.folder) / name, std::ios::binary);
    v1::CaseFile& file = *files.Add();
    file.set_name(name);
    file.mutable_content()->assign(std::istreambuf_iterator<char>(in), {});
  }
  return jobs::sha256_hex(jobs::encode_spec(loaded.message, files));
}

void show_progress(const sim::Progress& p, const FileObserver& o, bool tty) {
  static auto last = std::chrono::steady_clock::time_point{};
  const auto now = std::chrono::steady_clock::now();
  if (now - last < (tty ? std::chrono::milliseconds(200) : std::chrono::milliseconds(5000))) return;
  last = now;
  std::fprintf(stderr, "%sstage %d/%d  %3.0f %%  t = %.2f s  left %s%s  heave %+.1f mm  roll %+.2f deg%s", tty ? "\r" : "",
               p.stage + 1, p.stage_count, 100 * p.fraction, p.time, report_text::duration(p.remaining_s).c_str(),
               p.held ? "  (held)" : "", 1000 * o.last_value("heave"), o.last_value("roll"), tty ? "\033[K" : "\n");
}

const char* to_text(sim::StopReason reason) {
  switch (reason) {
    case sim::StopReason::finished: return "finished";
    case sim::StopReason::cancelled: return "stopped";
    case sim::StopReason::diverged: return "diverged";
  }
  return "?";
}

void print_outcome(const Options& o, const sim::RunOutcome& outcome, const FileObserver& observer) {
  v1::ListStagesResponse stages;
  for (const auto& stage : observer.stages()) *stages.add_stages() = stage;
  if (o.json) {
    const nlohmann::json out{{"outcome", to_text(outcome.reason)},
                             {"message", outcome.message},
                             {"folder", o.folder},
                             {"samples", observer.last_sequence()},
                             {"artifacts", observer.artifacts()},
                             {"stages", nlohmann::json::parse(to_json(stages))["stages"]}};
    std::printf("%s\n", out.dump().c_str());
    return;
  }
  std::printf("%s", report_text::stage_table(stages.stages()).c_str());
  for (const std::string& event : observer.events()) std::printf("%s\n", event.c_str());
  std::printf("%s%s%s; %lld samples in %s/history.csv\n", to_text(outcome.reason), outcome.message.empty() ? "" : ": ",
              outcome.message.c_str(), static_cast<long long>(observer.last_sequence()), o.folder.c_str());
}

int run(Options o, const jobs::Solver& solver) {
  const Loaded loaded = load(o.case_file, solver);
  if (!o.quiet && !o.json) print_report(loaded, stdout);
  if (!loaded.report.ok()) {
    if (o.quiet || o.json) std::fputs(report_text::diagnostics(loaded.report.diagnostics(), loaded.lines).c_str(), stderr);
    return 2;
  }
  if (o.folder.empty()) o.folder = fs::path(o.case_file).stem().string() + ".run";
  if (o.fresh) fs::remove_all(o.folder);
  fs::create_directories(o.folder);
  fs::copy_file(o.case_file, fs::path(o.folder) / "case.yaml", fs::copy_options::overwrite_existing);
  const bool tty = ::isatty(STDERR_FILENO) != 0;
  FileObserver observer(o.folder, [&](const sim::Progress& p, const FileObserver& self) {
    if (!o.quiet && !o.json) show_progress(p, self, tty);
  });
  SignalStop signals;
  sim::RunOptions options;
  options.folder = fs::absolute(o.folder).string();
  options.checkpoint_interval = o.checkpoint_interval;
  options.case_digest = digest_of(loaded);
  auto log = std::make_shared<spdlog::logger>(
      "seaway-run", std::make_shared<spdlog::sinks::basic_file_sink_mt>(o.folder + "/log.txt"));
  const int threads = o.threads > 0 ? o.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const sim::RunOutcome outcome = solver.run(loaded.core, options, observer, RunContext{log, signals.token(), threads});
  log->flush();
  if (tty && !o.quiet && !o.json) std::fputc('\n', stderr);
  print_outcome(o, outcome, observer);
  switch (outcome.reason) {
    case sim::StopReason::finished: return 0;
    case sim::StopReason::cancelled: return 3;
    case sim::StopReason::diverged: return 1;
  }
  return 1;
}

/// An option that stays absent in the message unless it is given.
template <class Message, class Value>
void add_field(CLI::App* sub, const std::string& name, Message& message, void (Message::*set)(Value), const std::string& text) {
  sub->add_option_function<Value>(name, [&message, set](const Value& value) { (message.*set)(value); }, text);
}

CLI::App* add_decay(CLI::App& app, ReportOptions& o) {
  CLI::App* sub = app.add_subcommand("decay", "periods, peaks and damping of free decays");
  sub->add_option("FILES", o.files, "history.csv or run folders")->required();
  sub->add_option_function<std::string>("--channel", [&o](const std::string& name) { o.decay.set_channel(name); }, "default: roll");
  add_field<v1::DecayOptions, double>(sub, "--from", o.decay, &v1::DecayOptions::set_from_s, "begin at this time [s]; default: the release");
  add_field<v1::DecayOptions, double>(sub, "--until", o.decay, &v1::DecayOptions::set_until_s, "end at this time [s]");
  add_field<v1::DecayOptions, double>(sub, "--smallest-peak", o.decay, &v1::DecayOptions::set_smallest_peak, "part of the first peak; default 0.02");
  sub->add_flag("--json", o.json, "one JSON object a file");
  return sub;
}

CLI::App* add_wave(CLI::App& app, Options& o, WaveOptions& w) {
  CLI::App* sub = app.add_subcommand("wave", "the wave that a case asks for; with --calibrate what arrives of it in the empty tank");
  sub->add_option("CASE", o.case_file, "case file (YAML)")->required();
  sub->add_flag("--calibrate", w.calibrate, "run the tank without the hull and measure at the ship's place");
  sub->add_option("--duration", w.duration, "seconds to look at; default: 20 periods")->check(CLI::PositiveNumber);
  sub->add_option("--run", w.run_folder, "folder of that run; default: name of the case + .calibration");
  sub->add_option("--out", w.folder, "folder for wave.png and its data");
  sub->add_option("--threads", w.threads, "default: all cores")->check(CLI::Range(1, 256));
  sub->add_flag("--json", w.json, "print one JSON object instead of text");
  return sub;
}

CLI::App* add_rao(CLI::App& app, ReportOptions& o) {
  CLI::App* sub = app.add_subcommand("rao", "response amplitudes of runs in regular waves");
  sub->add_option("FILES", o.files, "run folders, each with its case.yaml")->required();
  add_field<v1::RaoOptions, int>(sub, "--periods", o.rao, &v1::RaoOptions::set_period_count, "last whole periods to fit; default 5");
  sub->add_option("--out", o.folder, "folder for rao.png and its data");
  sub->add_flag("--json", o.json, "print one JSON object instead of text");
  return sub;
}

}  // namespace

void block_stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int s : {SIGTERM, SIGINT}) sigaddset(&set, s);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

int run_offline(int argc, char** argv, const jobs::Solver& solver) {
  block_stop_signals();
  CLI::App app{"seaway-run: runs one case in the foreground; run it again to go on after a stop", "seaway-run"};
  Options o;
  app.require_subcommand(0, 1);
  app.add_option("CASE", o.case_file, "case file (YAML)");
  app.add_option("-o,--output", o.folder, "folder of the results; default: name of the case + .run");
  app.add_option("--threads", o.threads, "default: all cores")->check(CLI::Range(1, 256));
  app.add_option("--checkpoint-interval", o.checkpoint_interval, "wall seconds; 0: only at stage ends");
  app.add_flag("--fresh", o.fresh, "delete the folder first instead of going on from its checkpoint");
  app.add_flag("--json", o.json, "print one JSON object instead of text");
  app.add_flag("-q,--quiet", o.quiet, "no progress");
  app.set_version_flag("--version", std::string(code_version()));
  CLI::App* checking = app.add_subcommand("check", "diagnostics, hydrostatics and cost of a case, without running it");
  checking->add_option("CASE", o.case_file, "case file (YAML)")->required();
  checking->add_flag("--json", o.json, "print the report as JSON");
  HullOptions hull_options;
  CLI::App* of_hull = app.add_subcommand("hull", "particulars, hydrostatics and stability of a ship; body plan and GZ curve");
  of_hull->add_option("CASE_OR_FILE", o.case_file, "case (.yaml), table of half-breadths (.csv) or .stl")->required();
  of_hull->add_flag("--json", hull_options.json, "print one JSON object instead of text");
  of_hull->add_option("--out", hull_options.folder, "folder for body_plan.png, gz.png and their data");
  of_hull->add_option("--scale", hull_options.scale, ".csv: all lengths are divided by it")->check(CLI::PositiveNumber);
  of_hull->add_option("--unit", hull_options.unit, ".stl: metres in one unit of the file, for example 0.001");
  of_hull->add_option("--amidships", hull_options.amidships, "x of amidships in the file's unit");
  of_hull->add_option("--draft", hull_options.draft, "of a file [m]; a case has its own")->check(CLI::NonNegativeNumber);
  of_hull->add_option("--kg", hull_options.kg, "of a file, with --draft: height of the centre of gravity [m]");
  WaveOptions wave_options;
  CLI::App* of_wave = add_wave(app, o, wave_options);
  ReportOptions report_options;
  CLI::App* of_decay = add_decay(app, report_options);
  CLI::App* of_rao = add_rao(app, report_options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (o.case_file.empty() && !of_decay->parsed() && !of_rao->parsed()) {
    std::fprintf(stderr, "seaway-run: which case? Try --help\n");
    return 2;
  }
  try {
    if (of_decay->parsed()) return print_decay(report_options);
    if (of_rao->parsed()) return print_rao(report_options);
    if (of_hull->parsed()) return hull(o, hull_options);
    if (of_wave->parsed()) return wave(o, wave_options, solver);
    return checking->parsed() ? check(o, solver) : run(o, solver);
  } catch (const yaml::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const Error& error) {
    std::fprintf(stderr, "seaway-run: %s\n", error.what());
    return error.code() == ErrorCode::invalid_argument ? 2 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seaway-run: %s\n", error.what());
    return 1;
  }
}

}  // namespace seaway::server
