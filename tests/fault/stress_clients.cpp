// SPDX-License-Identifier: GPL-3.0-or-later
// dead_peer: a client that has gone without a word. overhead: what the service costs beside the solver.
#include <signal.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "tests/fault/stress.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

}  // namespace

std::vector<Line> dead_peer(const Settings& s) {
  const testing::TempFolder folder;
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  client::JobClient client(daemon.address());
  auto request = request_of(s.case_file);
  request.set_start_held(true);
  const std::string job = client.create(request).job().name();
  const int before = descriptors(daemon.process().pid());
  // Stopped processes keep their connections open and answer nothing, as machines do that have lost their power.
  std::vector<testing::Process> watchers;
  constexpr int dead = 10;
  for (int i = 0; i < dead; ++i) watchers.emplace_back(std::vector<std::string>{s.seaway, "--server", daemon.address(), "watch", job});
  while (descriptors(daemon.process().pid()) < before + dead) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::seconds(1));  // the streams are open
  for (const auto& watcher : watchers) watcher.signal(SIGSTOP);
  const auto gone = Clock::now();
  while (descriptors(daemon.process().pid()) > before && seconds_since(gone) < 120) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const double took = seconds_since(gone);
  watchers.clear();
  client.get(job);
  const double cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  return {{"slow_clients", "dead_peer_s", took, "s", 45, cpu}};
}

std::vector<Line> overhead(const Settings& s) {
  const testing::TempFolder folder;
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  client::JobClient client(daemon.address());
  const double before = cpu_seconds(daemon.process().pid());
  const std::string job = client.create(request_of(s.case_file)).job().name();
  client.watch(job, 0, [](const auto&) { return true; });
  const double server = cpu_seconds(daemon.process().pid()) - before;
  if (client.get(job).state() != v1::Job::STATE_SUCCEEDED) throw std::runtime_error("overhead: the run did not succeed");
  double total = 0, checkpoint = 0;
  const auto stages = client.stages(job);
  for (const auto& stage : stages.stages())
    for (const auto& phase : stage.phases()) {
      total += phase.cpu_s();
      if (phase.phase() == "checkpoint") checkpoint += phase.cpu_s();
    }
  daemon.terminate();
  std::fprintf(stderr, "overhead: server %.2f s beside %.2f s of the solver\n", server, total);
  return {{"overhead", "service", 100 * server / total, "%", 2, server}, {"overhead", "checkpoint", 100 * checkpoint / total, "%", 3, 0}};
}

}  // namespace seaway::stress
