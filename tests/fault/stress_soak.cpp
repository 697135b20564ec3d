// SPDX-License-Identifier: GPL-3.0-or-later
// soak: submits, cancels, deletes, watchers, crashes of workers and restarts of the server for a long time.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>
#include <thread>

#include "tests/fault/stress.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

using Clock = std::chrono::steady_clock;

/// Parts of the whole time. Memory is compared within one life of the server, the longest one: a restart would hide a leak.
/// Caches need the fifth of the time after the last restart to fill to their bounds.
constexpr double restarts_until = 0.1, settled_from = 0.3, settled_until = 0.4, last_from = 0.9;
constexpr int stretches = 20;
constexpr int restarts = 8;
constexpr std::size_t kept_jobs = 30;

/// Reads some messages of the newest job, again and again, across restarts of the server.
void watch_on(const std::string& address, unsigned seed, const std::atomic<bool>& over) {
  std::mt19937 random(seed);
  client::JobClient client(own_channel(address));
  while (!over) {
    try {
      int messages = 1 + static_cast<int>(random() % 50);
      client.watch(client.resolve("latest"), 0, [&](const auto&) { return --messages > 0 && !over; });
    } catch (const client::ClientError&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));  // no job yet, or no server
    }
  }
}

/// What the server used, as means over the two stretches that are compared.
struct Usage {
  double sum = 0;
  int n = 0, descriptors = 0;
  void add(const testing::Process& process) {
    sum += static_cast<double>(process.resident_bytes()) / 1e6;
    ++n;
    descriptors = std::max(descriptors, stress::descriptors(process.pid()));
  }
  double mean_mb() const { return sum / std::max(1, n); }
};

class Soak {
 public:
  explicit Soak(const Settings& settings)
      : settings_(settings), random_(settings.seed), daemon_(settings.seawayd, folder_.path(), {}, daemon_arguments(settings, folder_.path())) {
    daemon_.start();
    connect();
  }
  std::vector<Line> run();

 private:
  void connect() { client_ = std::make_unique<client::JobClient>(own_channel(daemon_.address())); }
  void restart(bool crash);
  void disturb();
  void trim();
  void look(double part);
  int lost_jobs();

  /// Jobs end, and are no longer where a call expects them, at any moment.
  template <class F>
  bool attempt(F call) {
    try {
      call();
      return true;
    } catch (const client::RpcError& error) {
      if (error.status() != grpc::StatusCode::FAILED_PRECONDITION && error.status() != grpc::StatusCode::NOT_FOUND) throw;
      return false;
    }
  }

  const Settings& settings_;
  std::mt19937 random_;
  const testing::TempFolder folder_;
  testing::Daemon daemon_;
  std::unique_ptr<client::JobClient> client_;
  std::vector<std::string> jobs_;  ///< acknowledged and not deleted
  Usage before_, after_;
  Usage course_[stretches];  ///< of the whole time, to see how it changes
  double wal_mb_ = 0;
  int submits_ = 0, workers_killed_ = 0, restarted_ = 0;
};

void Soak::restart(bool crash) {
  if (crash) daemon_.kill();
  else if (daemon_.terminate() != 0) throw std::runtime_error("soak: the server did not end well");
  daemon_.start();
  connect();
  ++restarted_;
}

void Soak::disturb() {
  jobs_.push_back(client_->create(request_of(settings_.case_file)).job().name());
  ++submits_;
  const std::string& any = jobs_[random_() % jobs_.size()];
  switch (random_() % 6) {
    case 0: attempt([&] { client_->cancel(any); }); break;
    case 1: attempt([&] { client_->kill(any); }); break;
    case 2: attempt([&] { client_->hold(any); client_->release(any); }); break;
    case 3: client_->list({}); break;
    case 4: workers_killed_ += random_() % 4 == 0 && kill_worker(folder_ / "data") ? 1 : 0; break;
    default: attempt([&] { client_->history(any, [](const auto&) {}); }); break;
  }
}

/// A steady number of jobs: the database does not grow either.
void Soak::trim() {
  while (jobs_.size() > kept_jobs) {
    attempt([&] { client_->cancel(jobs_.front()); });
    if (attempt([&] { client_->erase(jobs_.front()); })) jobs_.erase(jobs_.begin());
    else std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void Soak::look(double part) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(folder_ / "data/seaway.db-wal", error);
  if (!error) wal_mb_ = std::max(wal_mb_, static_cast<double>(bytes) / 1e6);
  course_[std::clamp(static_cast<int>(part * stretches), 0, stretches - 1)].add(daemon_.process());
  if (part > settled_from && part < settled_until) before_.add(daemon_.process());
  else if (part > last_from) after_.add(daemon_.process());
}

int Soak::lost_jobs() {
  return static_cast<int>(std::count_if(jobs_.begin(), jobs_.end(), [&](const std::string& job) {
    return !attempt([&] { client_->get(job); });
  }));
}

std::vector<Line> Soak::run() {
  const auto began = Clock::now();
  const auto part = [&] { return std::chrono::duration<double>(Clock::now() - began).count() / settings_.seconds; };
  std::atomic<bool> over{false};
  std::vector<std::jthread> watchers;
  for (int i = 0; i < 20; ++i)
    watchers.emplace_back([address = daemon_.address(), seed = static_cast<unsigned>(random_()), &over] { watch_on(address, seed, over); });
  const struct Stop {
    std::atomic<bool>& over;
    ~Stop() { over = true; }
  } stop{over};  // before the watchers are waited for, also if a call fails
  while (part() < 1) {
    if (restarted_ < restarts && part() > restarts_until * (restarted_ + 1) / restarts) restart(restarted_ % 2 == 0);
    disturb();
    trim();
    look(part());
    std::this_thread::sleep_for(std::chrono::milliseconds(random_() % 100));
  }
  const double cpu = cpu_seconds(daemon_.process().pid());
  restart(true);
  const int lost = lost_jobs();
  over = true;
  watchers.clear();
  daemon_.terminate();
  std::fprintf(stderr, "soak: %d submits, %d restarts, %d workers killed, %.1f MB and %d descriptors then, %.1f MB and %d at the end\n",
               submits_, restarted_, workers_killed_, before_.mean_mb(), before_.descriptors, after_.mean_mb(), after_.descriptors);
  std::fprintf(stderr, "soak: MB in each twentieth of the time:");
  for (const Usage& stretch : course_) std::fprintf(stderr, " %.1f", stretch.mean_mb());
  std::fprintf(stderr, "\n");
  return {{"soak", "rss_drift", 100 * (after_.mean_mb() / before_.mean_mb() - 1), "%", 5, cpu},
          {"soak", "fd_drift", static_cast<double>(std::max(0, after_.descriptors - before_.descriptors)), "1", 0, cpu},
          {"soak", "wal_mb", wal_mb_, "MB", 64, cpu},
          {"soak", "jobs_lost", static_cast<double>(lost), "1", 0, cpu}};
}

}  // namespace

std::vector<Line> soak(const Settings& s) {
  std::fprintf(stderr, "soak: seed %u\n", s.seed);
  return Soak(s).run();
}

}  // namespace seaway::stress
