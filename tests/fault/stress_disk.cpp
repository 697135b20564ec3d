// SPDX-License-Identifier: GPL-3.0-or-later
// disk_full: the disk is full from the n-th write of the service on, for a while, for each n. Nothing that was
// acknowledged or shown is lost or wrong, and the work goes on by itself when there is space again.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "server/store/verify.hpp"
#include "tests/fault/stress.hpp"
#include "tests/fault/witness.hpp"
#include "tests/support/disk_full.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

using Clock = std::chrono::steady_clock;

struct Trial {
  bool refused = false;   ///< a write was
  bool corrupt = false;
  double resume_s = 0;
};

/// Submits until it is acknowledged.
std::string submit(const std::string& address, const v1::CreateJobRequest& request) {
  client::JobClient client(address);
  const auto deadline = Clock::now() + std::chrono::seconds(60);
  for (;;) {
    try {
      return client.create(request).job().name();
    } catch (const client::RpcError& error) {
      if (error.code() != client::exit_unreachable || Clock::now() > deadline) throw;
    }
  }
}

Trial attempt(const Settings& s, int first_refused, const std::string& expected) {
  const testing::TempFolder folder;
  testing::SharedDiskControl disk(folder / "control");
  disk->full_from = first_refused;
  const auto arguments = daemon_arguments(s, folder.path());
  testing::Daemon daemon(s.seawayd, folder.path(),
                         {"LD_PRELOAD=" + s.disk_full_library, "SEAWAY_DISK_FULL_CONTROL=" + (folder / "control"),
                          "SEAWAY_DISK_FULL_FOLDER=" + (folder / "data"), "ASAN_OPTIONS=verify_asan_link_order=0"},
                         arguments);
  Trial trial;
  Clock::time_point space;
  // The space comes back a little after the first refusal, however the service takes that.
  std::jthread healer([&](const std::stop_token& stop) {
    while (disk->refused == 0 && !stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (disk->refused == 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    space = Clock::now();
    disk->full_from = -1;
    trial.refused = true;
  });
  try {
    daemon.start();
  } catch (const std::runtime_error&) {
    healer.join();  // it refused to start; with space it must start
    daemon.start();
    trial.resume_s = std::chrono::duration<double>(Clock::now() - space).count();
  }
  const std::string job = submit(daemon.address(), request_of(s.case_file));
  Witness witness(daemon.address(), job);
  // Work goes on: the first thing that is seen after the space came back.
  bool timed = !healer.joinable();
  std::int64_t last = -1;
  while (!witness.ended()) {
    if (!timed && trial.refused) {
      if (last < 0) last = witness.last();
      if (witness.last() > last) {
        trial.resume_s = std::chrono::duration<double>(Clock::now() - space).count();
        timed = true;
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const std::string seen = witness.wait();
  if (healer.joinable()) {
    healer.request_stop();
    healer.join();
  }
  client::JobClient client(daemon.address());
  const auto state = client.get(job).state();
  trial.corrupt = state != v1::Job::STATE_SUCCEEDED || seen != expected || history_csv_of(client, job) != expected;
  if (daemon.terminate() != 0) trial.corrupt = true;
  for (const std::string& problem : store::verify_database(folder / "data/seaway.db").problems) {
    std::fprintf(stderr, "disk_full: write %d: %s\n", first_refused, problem.c_str());
    trial.corrupt = true;
  }
  if (trial.corrupt)
    std::fprintf(stderr, "disk_full: write %d: state %d\n%s\n", first_refused, static_cast<int>(state),
                 testing::read_text(folder / "log.txt").c_str());
  return trial;
}

}  // namespace

std::vector<Line> disk_full(const Settings& s) {
  const testing::TempFolder folder;
  if (!std::filesystem::exists(s.disk_full_library)) throw std::runtime_error(s.disk_full_library + " is missing");
  const std::string expected = unbroken_csv(s, folder.path());
  int corruptions = 0, hit = 0;
  double slowest = 0;
  for (int n = s.first_write; n < s.first_write + s.writes; n += s.write_step) {
    const Trial trial = attempt(s, n, expected);
    corruptions += trial.corrupt ? 1 : 0;
    hit += trial.refused ? 1 : 0;
    slowest = std::max(slowest, trial.resume_s);
  }
  std::fprintf(stderr, "disk_full: %d trials met a full disk\n", hit);
  if (hit == 0) throw std::runtime_error("disk_full: no write was refused");
  return {{"disk_full", "corruptions", static_cast<double>(corruptions), "1", 0, 0},
          {"disk_full", "resume_s", slowest, "s", 10, 0}};
}

}  // namespace seaway::stress
