// SPDX-License-Identifier: GPL-3.0-or-later
// seaway-stress NAME... : the bars of the service on the real programs; see --list.
#include <grpcpp/create_channel.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "proto/history_csv.hpp"
#include "proto/yaml.hpp"
#include "tests/fault/stress.hpp"

namespace seaway::stress {

namespace fs = std::filesystem;

void print(const Line& line, bool json) {
  const bool pass = line.pass();
  if (json) {
    nlohmann::ordered_json out{{"case", line.name}, {"quantity", line.quantity}, {"value", line.value},
                               {"unit", line.unit}, {"reference", line.reference}, {"tolerance", 0},
                               {"pass", pass}, {"cpu_s", line.cpu_s}};
    if (line.beside) out["reference"] = nullptr;
    std::printf("%s\n", out.dump().c_str());
  } else if (line.beside) {
    std::printf("     %-8s %-20s %10.3f %-4s\n", line.name.c_str(), line.quantity.c_str(), line.value, line.unit.c_str());
  } else {
    std::printf("%-4s %-8s %-20s %10.3f %-4s (at %s %g)\n", pass ? "ok" : "FAIL", line.name.c_str(),
                line.quantity.c_str(), line.value, line.unit.c_str(), line.at_least ? "least" : "most", line.reference);
  }
  std::fflush(stdout);
}

double cpu_seconds(pid_t pid) {
  const std::string stat = testing::read_text("/proc/" + std::to_string(pid) + "/stat");
  unsigned long user = 0, system = 0;
  std::sscanf(stat.c_str() + stat.rfind(')') + 1, " %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu", &user, &system);
  return static_cast<double>(user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

int descriptors(pid_t pid) {
  int n = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator("/proc/" + std::to_string(pid) + "/fd")) ++n;
  return n;
}

bool kill_worker(const std::string& data) {
  for (const auto& lease : fs::directory_iterator(data + "/leases")) {
    pid_t pid = 0;
    std::ifstream(lease.path()) >> pid;
    // The number may be of a worker that has just gone, but not of anything else: it is checked by its name.
    const std::string name = testing::read_text("/proc/" + std::to_string(pid) + "/cmdline");
    if (pid > 1 && name.find("attempt") != std::string::npos) return ::kill(pid, SIGKILL) == 0;
  }
  return false;
}

v1::CreateJobRequest request_of(const std::string& case_file) {
  v1::CreateJobRequest request;
  yaml::read_file(case_file, *request.mutable_case_());
  if (const std::string& table = request.case_().hull().offsets_section().file(); !table.empty()) {
    auto& file = *request.add_files();
    file.set_name(table);
    file.set_content(testing::read_text((fs::path(case_file).parent_path() / table).string()));
  }
  request.set_request_id(client::new_request_id());
  return request;
}

std::vector<std::string> daemon_arguments(const Settings& settings, const std::string& folder) {
  std::ofstream(folder + "/config.yaml") << "workers:\n  checkpoint_interval_s: " << settings.checkpoint_interval_s
                                         << "\n  threads: " << settings.threads
                                         << "\n  executor: process\n  program: " << settings.seaway_run
                                         << "\n  max_faults: 1000\n  max_attempts_without_progress: 1000\n";
  return {"--config", folder + "/config.yaml"};
}

std::shared_ptr<grpc::Channel> own_channel(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

std::string unbroken_csv(const Settings& s, const std::string& folder) {
  const auto run = testing::run_program({s.seaway_run, s.case_file, "-o", folder + "/unbroken", "-q", "--threads", std::to_string(s.threads)});
  if (run.code != 0) throw std::runtime_error("the unbroken run failed: " + run.output);
  std::string text = testing::read_text(folder + "/unbroken/history.csv");
  text.erase(0, text.find('\n') + 1);
  return text;
}

std::string history_csv_of(client::JobClient& client, const std::string& job) {
  std::string out;
  client.history(job, [&](const v1::ReadSamplesResponse& page) { history_csv::append(page.chunk(), out); });
  return out;
}

}  // namespace seaway::stress

int main(int argc, char** argv) {
  using namespace seaway::stress;
  const std::map<std::string, std::vector<Line> (*)(const Settings&)> all{{"watch", watch}, {"get_job", get_job}, {"kill", kill},
                                                                                 {"bit_flips", bit_flips}, {"disk_full", disk_full},
                                                                                 {"simulation", simulation}, {"submit", submit}, {"list", list},
                                                                                 {"boot", boot}, {"shutdown", shutdown}, {"dead_peer", dead_peer},
                                                                                 {"overhead", overhead}, {"requests", requests}, {"slow_clients", slow_clients}, {"catch_up", catch_up}, {"soak", soak}};
  CLI::App app{"seaway-stress: measures the promises of the service", "seaway-stress"};
  Settings s;
  std::vector<std::string> names;
  const std::string here = std::filesystem::canonical("/proc/self/exe").parent_path().string();
  s.seawayd = here + "/seawayd";
  s.seaway_run = here + "/seaway-run";
  s.disk_full_library = here + "/../tests/libseaway_disk_full.so";
  s.seaway = here + "/seaway";
  bool show_names = false;
  app.add_option("NAME", names, "see --list");
  app.add_flag("--list", show_names, "print the names");
  app.add_option("--case", s.case_file, "case file (YAML)");
  app.add_option("--seawayd", s.seawayd, "program of the server")->capture_default_str();
  app.add_option("--seaway-run", s.seaway_run, "program of the unbroken run")->capture_default_str();
  app.add_option("--clients", s.clients, "for watch and shutdown")->capture_default_str();
  app.add_option("--kills", s.kills, "for kill")->capture_default_str();
  app.add_option("--rounds", s.rounds, "for shutdown")->capture_default_str();
  app.add_option("--seaway", s.seaway, "program of the client")->capture_default_str();
  app.add_option("--seeds", s.seeds, "for simulation")->capture_default_str();
  app.add_option("--flips", s.flips, "for bit_flips")->capture_default_str();
  app.add_option("--first-write", s.first_write, "for disk_full")->capture_default_str();
  app.add_option("--writes", s.writes, "for disk_full")->capture_default_str();
  app.add_option("--write-step", s.write_step, "for disk_full")->capture_default_str();
  app.add_option("--disk-full-library", s.disk_full_library, "for disk_full")->capture_default_str();
  app.add_option("--threads", s.threads, "of the solver")->capture_default_str();
  app.add_option("--seconds", s.seconds, "longest time to watch a run")->capture_default_str();
  app.add_option("--checkpoint-interval", s.checkpoint_interval_s, "seconds")->capture_default_str();
  app.add_option("--seed", s.seed, "of the random moments; 0: a new one");
  app.add_flag("--no-memory-bars", s.no_memory_bars, "show memory without a bar: for programs with a sanitizer");
  app.add_flag("--json", s.json, "one JSON object a line");
  CLI11_PARSE(app, argc, argv);
  if (show_names) {
    for (const auto& [name, run] : all) std::printf("%s\n", name.c_str());
    return 0;
  }
  if (s.seed == 0) s.seed = std::random_device{}();
  bool pass = true;
  try {
    const auto needs_case = [](const std::string& name) { return name != "simulation"; };
    if (names.empty() || (s.case_file.empty() && std::any_of(names.begin(), names.end(), needs_case)))
      throw std::runtime_error("give names and --case; see --help");
    for (const std::string& name : names) {
      if (all.count(name) == 0) throw std::runtime_error(name + " is unknown; see --list");
      for (Line& line : all.at(name)(s)) {
        line.beside = line.beside || (s.no_memory_bars && line.unit == "MB");
        print(line, s.json);
        pass = pass && line.pass();
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seaway-stress: %s\n", error.what());
    return 2;
  }
  return pass ? 0 : 1;
}
