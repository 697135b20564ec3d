#include "tests/validation/support/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "core/sim/cascade.hpp"
#include "core/sim/cycle_monitor.hpp"

namespace seaway::validation {
namespace {

class Keeper : public sim::RunObserver {
 public:
  /// `file`: what was recorded is saved there with each checkpoint, and read if it is there.
  Keeper(std::stop_source& stop, const std::function<bool(double, int)>& enough, std::string file,
         const std::string& digest)
      : stop_(stop), enough_(enough), file_(std::move(file)), cpu_before_(process_cpu_seconds()) {
    if (!load(file_, record_) || record_.digest != digest) record_ = {};
    record_.digest = digest;
    record_.version = code_version();
  }

  void on_channels(const std::vector<sim::Channel>& channels) override {
    const auto find = [&](const char* name) {
      const auto at = std::find_if(channels.begin(), channels.end(),
                                   [&](const sim::Channel& c) { return c.name == name; });
      SEAWAY_CHECK(at != channels.end(), "the run has no channel '{}'", name);
      return static_cast<std::size_t>(at - channels.begin());
    };
    roll_ = find("roll");
    heave_ = find("heave");
  }
  void on_sample(const sim::Sample& sample) override {
    if (first_) go_on_from(static_cast<std::size_t>(sample.sequence) - 1);
    first_ = false;
    record_.t.push_back(sample.time);
    record_.roll.push_back(sample.values[roll_]);
    record_.heave.push_back(sample.values[heave_]);
    record_.cpu_s.push_back(process_cpu_seconds() - cpu_before_);
    if (enough_ && enough_(sample.time, sample.stage)) stop_.request_stop();
  }
  void on_stage_finished(const sim::StageResult& r) override {
    record_.stages.push_back({r.info.name, r.info.cells, r.steps, r.info.time, r.end_time, r.cpu_s,
                              r.has_mapping ? r.mapping.cpu_s : 0, r.converged, r.volume_drift});
  }
  void on_checkpoint(const std::string&, std::int64_t, double) override {
    record_.total_cpu_s = process_cpu_seconds() - cpu_before_;
    save(record_, file_);
  }
  RunRecord finish() {
    record_.total_cpu_s = process_cpu_seconds() - cpu_before_;
    return std::move(record_);
  }

 private:
  /// Keeps the first `samples`: the run goes on from the checkpoint after them, or from its start.
  void go_on_from(std::size_t samples) {
    if (samples > record_.t.size())
      fail(ErrorCode::failed_precondition,
           "{} has {} samples, the checkpoint beside it {}; remove the folder and run again", file_,
           record_.t.size(), samples);
    for (auto* v : {&record_.t, &record_.roll, &record_.heave, &record_.cpu_s}) v->resize(samples);
    const double time = record_.end_time();
    std::erase_if(record_.stages, [&](const StageRecord& s) { return s.end > time + 1e-9; });
    if (samples > 0) cpu_before_ -= record_.cpu_s.back();
  }

  std::stop_source& stop_;
  const std::function<bool(double, int)>& enough_;
  std::string file_;
  double cpu_before_;
  bool first_ = true;
  std::size_t roll_ = 0, heave_ = 0;
  RunRecord record_;
};

/// To 1e-8: what a file of a long run needs.
std::vector<double> rounded(std::vector<double> values) {
  for (double& v : values) v = std::round(v * 1e8) / 1e8;
  return values;
}

double drift_of(const nlohmann::json& stage) {
  const auto at = stage.find("volume_drift");
  return at == stage.end() || at->is_null() ? std::nan("") : at->get<double>();
}

}  // namespace

double RunRecord::cpu_until(double time) const {
  const auto at = std::lower_bound(t.begin(), t.end(), time - 1e-9);
  return at == t.end() ? total_cpu_s : cpu_s[static_cast<std::size_t>(at - t.begin())];
}

double RunRecord::amplitude(const std::vector<double>& signal, double end, double period) const {
  return std::abs(harmonic(between(signal, end - 3 * period, end), 2 * pi / period, 0));
}

double RunRecord::converged_at(double start, const sim::EndRule& rule, double period) const {
  sim::CycleMonitor monitor(start, period, 2);
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < start - 1e-9) continue;
    monitor.add(t[i], {roll[i], heave[i]});
    if (monitor.repeats({0, 1}, rule.tolerance, rule.min_periods)) return t[i];
  }
  return std::numeric_limits<double>::infinity();
}

double RunRecord::mapping_cpu_s() const {
  double sum = 0;
  for (const StageRecord& s : stages) sum += s.mapping_cpu_s;
  return sum;
}

analysis::Decay RunRecord::roll_decay() const {
  std::vector<double> angle;
  for (const double r : roll) angle.push_back(r / degree);
  return analysis::analyse_decay({t, angle});
}

const analysis::DecayCycle& cycle(const analysis::Decay& decay, std::size_t number) {
  if (decay.cycles.size() < number)
    fail(ErrorCode::failed_precondition, "the run has {} cycles of roll, asked is cycle {}; make it longer",
         decay.cycles.size(), number);
  return decay.cycles[number - 1];
}

Record RunRecord::between(const std::vector<double>& signal, double from, double to) const {
  Record out;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (t[i] > from && t[i] <= to + 1e-9) out.add(t[i], signal[i]);
  return out;
}

RunRecord run_and_record(const sim::Case& c, const std::string& folder, int threads,
                         const std::function<bool(double, int)>& enough, const std::string& digest) {
  std::filesystem::create_directories(folder);
  std::stop_source stop;
  RunContext context = quiet_context(threads);
  context.stop = stop.get_token();
  Keeper keeper(stop, enough, folder + "/record.json", digest);
  sim::RunOptions options;
  options.folder = folder;
  options.case_digest = digest;
  options.resume = true;             // a run that was cut goes on; its CPU time is that of all attempts
  options.checkpoint_interval = 60;  // seconds; a few tenths of one each
  const sim::RunOutcome outcome = sim::run_cascade(c, options, keeper, context);
  if (outcome.reason == sim::StopReason::diverged) fail(ErrorCode::diverged, "{}", outcome.message);
  return keeper.finish();
}

void save(const RunRecord& r, const std::string& path) {
  nlohmann::json stages = nlohmann::json::array();
  for (const StageRecord& s : r.stages)
    stages.push_back({{"name", s.name},
                      {"cells", s.cells},
                      {"steps", s.steps},
                      {"start_s", s.start},
                      {"end_s", s.end},
                      {"cpu_s", s.cpu_s},
                      {"mapping_cpu_s", s.mapping_cpu_s},
                      {"converged", s.converged},
                      {"volume_drift", s.volume_drift}});
  const nlohmann::json all{{"digest", r.digest},           {"version", r.version},
                           {"t_s", rounded(r.t)},          {"roll_rad", rounded(r.roll)},
                           {"heave_m", rounded(r.heave)},  {"cpu_s", rounded(r.cpu_s)},
                           {"stages", stages},   {"total_cpu_s", r.total_cpu_s}};
  // Written aside: a file that is there is whole.
  std::ofstream(path + ".part") << all.dump() << "\n";
  std::filesystem::rename(path + ".part", path);
}

bool load(const std::string& path, RunRecord& r) {
  std::ifstream file(path);
  if (!file) return false;
  const nlohmann::json all = nlohmann::json::parse(file);
  r.digest = all.value("digest", "");
  r.version = all.value("version", "");
  all.at("t_s").get_to(r.t);
  all.at("roll_rad").get_to(r.roll);
  all.at("heave_m").get_to(r.heave);
  all.at("cpu_s").get_to(r.cpu_s);
  all.at("total_cpu_s").get_to(r.total_cpu_s);
  r.stages.clear();
  for (const auto& s : all.at("stages"))
    r.stages.push_back({s.at("name"), s.at("cells"), s.at("steps"), s.at("start_s"), s.at("end_s"),
                        s.at("cpu_s"), s.at("mapping_cpu_s"), s.at("converged"), drift_of(s)});
  return true;
}

}  // namespace seaway::validation
