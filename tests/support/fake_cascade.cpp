// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/fake_cascade.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

#include "core/base/error.hpp"
#include "core/sim/checkpoint_name.hpp"
#include "tests/support/fake_fault.hpp"

namespace seaway::testing {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// All that a run carries from step to step.
struct Flow {
  std::int64_t sequence = 0, step = 0, step_in_stage = 0;
  std::int32_t stage = 0, pad = 0;
  double time = 0, chaos = 0.37, start = 0;
};

struct Header {
  char digest[80] = {};
  Flow flow;
  std::uint64_t check = 0;
};

std::uint64_t hash_of(const Header& h) {
  std::string bytes(reinterpret_cast<const char*>(&h), offsetof(Header, check));
  return std::hash<std::string>{}(bytes);
}

void save(const std::string& path, const std::string& digest, const Flow& flow) {
  Header h;
  std::strncpy(h.digest, digest.c_str(), sizeof h.digest - 1);
  h.flow = flow;
  h.check = hash_of(h);
  const std::string aside = path + ".part";
  const int fd = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0 || ::write(fd, &h, sizeof h) != sizeof h || ::fsync(fd) != 0) fail(ErrorCode::unavailable, "{}", aside);
  ::close(fd);
  fs::rename(aside, path);
}

std::optional<Flow> load(const fs::path& path, const std::string& digest) {
  Header h;
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(&h), sizeof h);
  if (in.gcount() != sizeof h || h.check != hash_of(h) || digest != h.digest) return std::nullopt;
  return h.flow;
}

class FakeRun {
 public:
  FakeRun(const FakeOptions& fake, const sim::Case& c, const sim::RunOptions& options, sim::RunObserver& observer,
          const RunContext& context)
      : fake_(fake), case_(c), options_(options), observer_(observer), context_(context), fault_(c.title, options.folder) {}

  sim::RunOutcome run() {
    resume();
    std::vector<sim::Channel> channels{{"heave", "m"}, {"roll", "rad"}, {"sway", "m"}, {"force_z", "N/m"},
                                       {"moment_x", "N"}, {"water.volume", "m2"}};
    if (fake_.clock) channels.insert(channels.end(), {{"chaos", "1"}, {"clock", "s"}});
    observer_.on_channels(channels);
    const bool diverges = case_.title.find("diverge") != std::string::npos;
    last_checkpoint_ = Clock::now();
    while (flow_.stage < static_cast<int>(case_.stages.size())) {
      const auto began = Clock::now();
      const sim::StageInfo info = stage_info();
      observer_.on_stage_started(info);
      const std::int64_t n = steps_of(flow_.stage);
      while (flow_.step_in_stage < n) {
        if (!wait_for_permission()) return stop();
        advance();
        if (diverges && flow_.stage + 1 == static_cast<int>(case_.stages.size()) && flow_.step_in_stage > n / 2) {
          observer_.on_event("DIVERGED", "the speed exceeds 100 m/s");
          return {sim::StopReason::diverged, "the speed exceeds 100 m/s at t = " + std::to_string(flow_.time) +
                                                 " s; use a smaller time step"};
        }
        if (checkpoint_due()) checkpoint();
      }
      finish_stage(info, std::chrono::duration<double>(Clock::now() - began).count());
    }
    return {};
  }

 private:
  double dt() const { return case_.time.dt > 0 ? case_.time.dt : 0.01; }
  std::int64_t steps_of(int stage) const {
    const sim::EndRule& end = case_.stages[static_cast<std::size_t>(stage)].end;
    const double duration = end.kind == sim::EndRule::Kind::time ? end.duration : 2.0;
    return std::clamp<std::int64_t>(std::llround(duration / dt()), 1, 1'000'000);
  }

  void resume() {
    if (!options_.resume) return;
    for (const auto& entry : fs::directory_iterator(options_.folder)) {
      if (entry.path().extension() != ".checkpoint") continue;
      const auto flow = load(entry.path(), options_.case_digest);
      if (flow && flow->sequence >= flow_.sequence) flow_ = *flow;
    }
    if (flow_.sequence > 0) observer_.on_event("RESUMED", "after sample " + std::to_string(flow_.sequence));
  }

  sim::StageInfo stage_info() const {
    const auto& stage = case_.stages[static_cast<std::size_t>(flow_.stage)];
    return {flow_.stage, stage.name, 1000LL << (2 * flow_.stage), 3 + flow_.stage, 0.01 / (1 << flow_.stage), flow_.start, dt()};
  }

  /// False: the run shall stop.
  bool wait_for_permission() {
    if (fake_.step.count() > 0) std::this_thread::sleep_for(fake_.step);
    while (fake_.allowed_steps && fake_.allowed_steps->load() <= flow_.step && !context_.stop.stop_requested())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return !fault_.listens() || !context_.stop.stop_requested();
  }

  void advance() {
    fault_.before(flow_.sequence + 1);
    ++flow_.step;
    ++flow_.step_in_stage;
    ++flow_.sequence;
    flow_.time = flow_.start + dt() * static_cast<double>(flow_.step_in_stage);
    flow_.chaos = 3.99 * flow_.chaos * (1 - flow_.chaos);  // any lost bit shows soon
    const double phase = 2 * pi * flow_.time / 1.4;
    const double size = 1 + 0.1 / (1 + flow_.stage);
    const double heave = 0.02 * size * std::sin(phase) + 1e-4 * flow_.chaos + fake_.perturbation;
    const double roll = 0.15 * size * std::sin(phase - 0.8);
    std::vector<double> values{heave, roll, 0.01 * std::cos(phase), 9.81 * 60 * heave, roll * 22, 5 + 1e-9 * flow_.chaos};
    if (fake_.clock)
      values.insert(values.end(), {flow_.chaos, std::chrono::duration<double>(Clock::now().time_since_epoch()).count()});
    observer_.on_sample({flow_.sequence, flow_.stage, flow_.step, flow_.time, std::move(values)});
    std::int64_t total = 0;
    std::int64_t done = flow_.step_in_stage;
    for (int i = 0; i < static_cast<int>(case_.stages.size()); ++i) {
      total += steps_of(i);
      if (i < flow_.stage) done += steps_of(i);
    }
    const double fraction = static_cast<double>(done) / static_cast<double>(total);
    observer_.on_progress({flow_.stage, static_cast<int>(case_.stages.size()), flow_.time, fraction,
                           1e-6 * static_cast<double>(fake_.step.count() * (total - done)), flow_.stage == 0 && done < 10});
  }

  bool checkpoint_due() const {
    if (fake_.checkpoint_steps > 0) return flow_.step % fake_.checkpoint_steps == 0;
    return options_.checkpoint_interval > 0 &&
           Clock::now() - last_checkpoint_ > std::chrono::duration<double>(options_.checkpoint_interval);
  }

  void checkpoint(const std::string& stage_end = "") {
    last_checkpoint_ = Clock::now();
    const std::string path = options_.folder + "/" + std::to_string(flow_.sequence) + stage_end + ".checkpoint";
    save(path, options_.case_digest, flow_);
    observer_.on_checkpoint(path, flow_.sequence, std::chrono::duration<double>(Clock::now() - last_checkpoint_).count());
    if (!before_.empty() && before_ != path && !sim::stage_ended_in(before_)) fs::remove(before_);
    before_ = std::exchange(newest_, path);
  }

  sim::RunOutcome stop() {
    checkpoint();
    return {sim::StopReason::cancelled, ""};
  }

  void finish_stage(const sim::StageInfo& info, double wall_s) {
    sim::StageResult r;
    r.info = info;
    r.end_time = flow_.time;
    r.steps = flow_.step_in_stage;
    r.converged = true;
    r.wall_s = r.cpu_s = wall_s;
    for (const char* phase : {"mesh", "mapping", "advection", "pressure", "hull", "turbulence", "forcing", "checkpoint", "output"})
      r.phases[phase] = wall_s / 9;
    r.mean_pressure_iterations = 6.5;
    r.max_pressure_iterations = 9;
    r.motions = {{"roll", 0.15, 0, 1.4, 0.005}, {"heave", 0.02, 0.001, 1.4, 0.004}};
    if (info.stage > 0) {
      r.has_mapping = true;
      r.mapping.method = "local-rbf";
      r.mapping.cpu_s = 0.01;
      r.mapping.vof_max = 1;
    }
    write_section();
    observer_.on_stage_finished(r);
    ++flow_.stage;
    flow_.step_in_stage = 0;
    flow_.start = flow_.time;
    checkpoint("e" + std::to_string(flow_.stage - 1));
  }

  void write_section() {
    char name[64];
    std::snprintf(name, sizeof name, "section_%.2f.json", flow_.time);
    const std::string path = options_.folder + "/" + name;
    std::ofstream out(path);
    out << "{\"time_s\":" << flow_.time << ",\"bounds\":{\"y\":[-1,1],\"z\":[-0.3,0.3]},\"surface\":[";
    for (int i = -20; i < 20; ++i)
      if (std::abs(i + 0.5) > 4)
        out << (i > -20 ? "," : "") << "[[" << 0.05 * i << "," << 0.03 * std::sin(0.1 * i) << "],[" << 0.05 * (i + 1) << ","
            << 0.03 * std::sin(0.1 * (i + 1)) << "]]";
    out << "],\"hull\":[[[-0.19,-0.15],[0.19,-0.15],[0.19,0.15],[-0.19,0.15]]]}";
    out.close();
    observer_.on_artifact(name, path, "application/json");
  }

  const FakeOptions& fake_;
  const sim::Case& case_;
  const sim::RunOptions& options_;
  sim::RunObserver& observer_;
  const RunContext& context_;
  FakeFault fault_;
  Flow flow_;
  Clock::time_point last_checkpoint_;
  std::string newest_, before_;
};

sim::CaseReport fake_check(const sim::Case& c) {
  sim::CaseReport report;
  if (c.title.find("broken") != std::string::npos)
    report.diagnostics.push_back({sim::Diagnostic::Severity::error, "mesh.base_cell_m", "0.08 is too coarse", "make it smaller"});
  if (c.title.find("doubtful") != std::string::npos)
    report.diagnostics.push_back({sim::Diagnostic::Severity::warning, "body.gyradii.x_m", "0.9 of the beam", "check it"});
  report.hydrostatics = {true, c.body.mass, c.body.mass / c.fluids.rho_water, 0.147, 0.08, 0.06, 0.039, 0.0, 0.12, 0.05, 1.4};
  for (const sim::Stage& stage : c.stages) report.stages.push_back({stage.name, 1000, 200, 0.01, 1.0});
  return report;
}

}  // namespace

jobs::Solver fake_solver(FakeOptions options) {
  return {[options](const sim::Case& c, const sim::RunOptions& o, sim::RunObserver& observer, const RunContext& context) {
            return FakeRun(options, c, o, observer, context).run();
          },
          fake_check};
}

}  // namespace seaway::testing
