// SPDX-License-Identifier: GPL-3.0-or-later
// soak: submits, cancels, deletes and watchers for a long time.
// dead_peer: a client that has gone without a word. overhead: what the service costs beside the solver.
#include <signal.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <random>
#include <thread>

#include "tests/fault/stress.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

int descriptors(pid_t pid) {
  int n = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/fd")) ++n;
  return n;
}

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

std::vector<Line> soak(const Settings& s) {
  const testing::TempFolder folder;
  std::fprintf(stderr, "soak: seed %u\n", s.seed);
  std::mt19937 random(s.seed);
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  const auto until = Clock::now() + std::chrono::duration<double>(s.seconds);
  const auto warm = Clock::now() + std::chrono::duration<double>(0.2 * s.seconds);
  const auto settled = Clock::now() + std::chrono::duration<double>(0.3 * s.seconds);
  std::atomic<bool> over{false};
  std::vector<std::jthread> watchers;
  for (int i = 0; i < 20; ++i)
    watchers.emplace_back([&, seed = random()] {
      std::mt19937 mine(seed);
      client::JobClient client(own_channel(daemon.address()));
      while (!over) {
        try {
          int messages = 1 + static_cast<int>(mine() % 50);
          client.watch(client.resolve("latest"), 0, [&](const auto&) { return --messages > 0 && !over; });
        } catch (const client::ClientError&) {
          std::this_thread::sleep_for(std::chrono::milliseconds(50));  // no job yet
        }
      }
    });
  client::JobClient client(daemon.address());
  std::vector<std::string> jobs;
  double before_sum = 0, rss_sum = 0, wal = 0;
  int descriptors_before = 0, rounds = 0, n = 0, n_before = 0;
  const auto attempt = [](auto f) {
    try {
      f();
    } catch (const client::RpcError& error) {
      if (error.status() != grpc::StatusCode::FAILED_PRECONDITION && error.status() != grpc::StatusCode::NOT_FOUND) throw;
    }
  };
  while (Clock::now() < until) {
    ++rounds;
    jobs.push_back(client.create(request_of(s.case_file)).job().name());
    const std::string& any = jobs[random() % jobs.size()];
    switch (random() % 5) {
      case 0: attempt([&] { client.cancel(any); }); break;
      case 1: attempt([&] { client.kill(any); }); break;
      case 2: attempt([&] { client.hold(any); client.release(any); }); break;
      case 3: client.list({}); break;
      default: attempt([&] { client.history(any, [](const auto&) {}); }); break;
    }
    while (jobs.size() > 30) {  // a steady number of them
      attempt([&] { client.cancel(jobs.front()); });
      bool gone = false;
      attempt([&] { client.erase(jobs.front()); gone = true; });
      if (gone) jobs.erase(jobs.begin());
      else std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const double rss = static_cast<double>(daemon.process().resident_bytes());
    std::error_code error;
    wal = std::max(wal, static_cast<double>(std::filesystem::file_size(folder / "data/seaway.db-wal", error)) / 1e6);
    if (Clock::now() < settled) {
      if (Clock::now() > warm) {
        before_sum += rss;
        ++n_before;
      }
      descriptors_before = std::max(descriptors_before, descriptors(daemon.process().pid()));
    } else if (until - Clock::now() < std::chrono::duration<double>(0.1 * s.seconds)) {
      rss_sum += rss;
      ++n;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 100));
  }
  const int descriptors_after = descriptors(daemon.process().pid());
  over = true;
  watchers.clear();
  const double cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  const double rss_before = before_sum / std::max(1, n_before);
  std::fprintf(stderr, "soak: %d submits, %.1f MB then, %.1f MB at the end\n", rounds, rss_before / 1e6, rss_sum / std::max(1, n) / 1e6);
  return {{"soak", "rss_drift", 100 * (rss_sum / std::max(1, n) / rss_before - 1), "%", 5, cpu},
          {"soak", "fd_drift", static_cast<double>(std::max(0, descriptors_after - descriptors_before)), "1", 0, cpu},
          {"soak", "wal_mb", wal, "MB", 64, cpu}};
}

}  // namespace seaway::stress
