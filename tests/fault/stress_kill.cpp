// SPDX-License-Identifier: GPL-3.0-or-later
// kill: kill -9 of seawayd at random moments of a run. What was acknowledged and what a client has received
// must survive, and the final history must be that of an unbroken run.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include "tests/fault/stress.hpp"
#include "tests/fault/witness.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

std::int64_t count_lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

/// Lines of `seen` that are not where they should be in `stored`.
std::int64_t lost_lines(const std::string& seen, const std::string& stored) {
  if (stored.starts_with(seen)) return 0;
  std::int64_t lost = 0;
  for (std::size_t a = 0, b = 0; a < seen.size();) {
    const std::size_t a_end = seen.find('\n', a), b_end = stored.find('\n', b);
    const bool same = b < stored.size() && seen.compare(a, a_end - a, stored, b, b_end - b) == 0;
    lost += same ? 0 : 1;
    a = a_end + 1;
    b = b_end == std::string::npos ? stored.size() : b_end + 1;
  }
  return lost;
}

}  // namespace

std::vector<Line> kill(const Settings& s) {
  const testing::TempFolder folder;
  std::fprintf(stderr, "kill: seed %u\n", s.seed);
  std::mt19937 random(s.seed);
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  std::vector<std::string> acknowledged;
  const auto submit = [&] {
    client::JobClient client(daemon.address());
    const auto request = request_of(s.case_file);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (;;) {
      try {
        acknowledged.push_back(client.create(request).job().name());
        return;
      } catch (const client::RpcError& error) {
        // On a busy machine the connection to a server that has just begun takes its time.
        if (error.code() != client::exit_unreachable || std::chrono::steady_clock::now() > deadline) throw;
      }
    }
  };
  submit();
  Witness witness(daemon.address(), acknowledged.front());
  std::vector<double> moments;
  for (int i = 0; i < s.kills; ++i) moments.push_back(std::uniform_real_distribution<>(0.0, 0.98)(random));
  std::sort(moments.begin(), moments.end());
  int done = 0;
  for (const double moment : moments) {
    while (witness.fraction() < moment && !witness.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 100'000));
    if (witness.ended()) break;
    submit();
    daemon.kill();
    daemon.start();
    ++done;
  }
  const std::string& seen = witness.wait();
  client::JobClient client(daemon.address());
  int jobs_lost = 0;
  for (const std::string& name : acknowledged) {
    try {
      const auto state = client.get(name).state();
      if (name != acknowledged.front() && state < v1::Job::STATE_SUCCEEDED) client.cancel(name);
    } catch (const client::RpcError& error) {
      jobs_lost += error.status() == grpc::StatusCode::NOT_FOUND ? 1 : 0;
    }
  }
  const std::string stored = history_csv_of(client, acknowledged.front());
  daemon.terminate();
  const auto unbroken = testing::run_program({s.seaway_run, s.case_file, "-o", folder / "unbroken", "-q", "--threads", std::to_string(s.threads)});
  std::string expected = testing::read_text(folder / "unbroken/history.csv");
  expected.erase(0, expected.find('\n') + 1);
  std::fprintf(stderr, "kill: %d kills, %lld samples, unbroken run ended with %d\n", done,
               static_cast<long long>(count_lines(stored)), unbroken.code);
  const bool different = stored != expected || stored.empty();
  return {{"kill", "kills_missing", static_cast<double>(s.kills - done), "1", static_cast<double>(s.kills) / 2, 0},
          {"kill", "jobs_lost", static_cast<double>(jobs_lost), "1", 0, 0},
          {"kill", "samples_lost", static_cast<double>(lost_lines(seen, stored)), "1", 0, 0},
          {"kill", "histories_different", different ? 1.0 : 0.0, "1", 0, 0}};
}

}  // namespace seaway::stress
