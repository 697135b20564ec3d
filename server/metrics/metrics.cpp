// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/metrics/metrics.hpp"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <array>
#include <chrono>
#include <cmath>
#include <mutex>

namespace seaway::metrics {
namespace {

using Buckets = prometheus::Histogram::BucketBoundaries;

/// A rate over the last half minute, in buckets of a second.
class Rate {
 public:
  void add(double n) {
    const std::lock_guard lock(mutex_);
    bucket(now()) += n;
  }
  double per_second() {
    const std::lock_guard lock(mutex_);
    const std::int64_t second = now();
    double sum = 0;
    bucket(second);  // what is older than the window goes
    for (const double n : sums_) sum += n;
    return sum / static_cast<double>(sums_.size());
  }

 private:
  static std::int64_t now() {
    return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  double& bucket(std::int64_t second) {
    const auto n = static_cast<std::int64_t>(sums_.size());
    for (std::int64_t s = std::max(latest_ + 1, second - n + 1); s <= second; ++s) sums_[static_cast<std::size_t>(s % n)] = 0;
    latest_ = std::max(latest_, second);
    return sums_[static_cast<std::size_t>(second % n)];
  }
  std::mutex mutex_;
  std::array<double, 30> sums_{};  // guarded by mutex_
  std::int64_t latest_ = -1;       // guarded by mutex_
};

}  // namespace

struct Metrics::Parts {
  prometheus::Registry registry;
  prometheus::Family<prometheus::Gauge>& gauge(const char* name, const char* help) {
    return prometheus::BuildGauge().Name(name).Help(help).Register(registry);
  }
  prometheus::Family<prometheus::Counter>& counter(const char* name, const char* help) {
    return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
  }
  prometheus::Family<prometheus::Histogram>& histogram(const char* name, const char* help) {
    return prometheus::BuildHistogram().Name(name).Help(help).Register(registry);
  }

  prometheus::Family<prometheus::Gauge>& jobs = gauge("seaway_jobs", "Jobs in the store by state");
  prometheus::Histogram& wait = histogram("seaway_queue_wait_seconds", "From the submit of a job to its first attempt")
                                    .Add({}, Buckets{0.1, 1, 10, 60, 600, 3600, 36'000, 360'000});
  prometheus::Family<prometheus::Histogram>& stages =
      histogram("seaway_stage_seconds", "CPU time of finished stages by number of the stage and phase");
  prometheus::Counter& steps = counter("seaway_steps_total", "Time steps computed").Add({});
  prometheus::Gauge& cell_rate =
      gauge("seaway_cell_updates_per_second", "Cells times time steps in a second, of all running jobs over half a minute").Add({});
  prometheus::Histogram& commits = histogram("seaway_commit_seconds", "Time of a transaction of the database with its sync")
                                       .Add({}, Buckets{0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 1, 5});
  prometheus::Gauge& wal = gauge("seaway_wal_bytes", "Size of the database's log").Add({});
  prometheus::Family<prometheus::Gauge>& streams = gauge("seaway_streams", "Open streams by kind");
  prometheus::Gauge& lag = gauge("seaway_stream_lag_samples", "Stored samples that the slowest reader has not received").Add({});
  prometheus::Histogram& checkpoints = histogram("seaway_checkpoint_seconds", "Time to write a checkpoint")
                                           .Add({}, Buckets{0.01, 0.05, 0.1, 0.5, 1, 5, 10, 60});
  prometheus::Counter& recoveries =
      counter("seaway_recoveries_total", "Attempts that a crash of server or worker ended and that are made again").Add({});
  prometheus::Gauge& disk = gauge("seaway_disk_free_bytes", "Space that the data folder can still take").Add({});
  Rate cell_updates;
};

Metrics::Metrics() : parts_(std::make_unique<Parts>()) {}
Metrics::~Metrics() = default;

void Metrics::job_waited(double seconds) { parts_->wait.Observe(std::max(0.0, seconds)); }

void Metrics::stage_finished(int stage, const std::map<std::string, double>& phases) {
  for (const auto& [phase, seconds] : phases)
    parts_->stages.Add({{"stage", std::to_string(stage)}, {"phase", phase}}, Buckets{1, 10, 60, 600, 3600, 36'000}).Observe(seconds);
}

void Metrics::stepped(std::int64_t steps, std::int64_t cells) {
  parts_->steps.Increment(static_cast<double>(steps));
  parts_->cell_updates.add(static_cast<double>(steps) * static_cast<double>(cells));
}

void Metrics::committed(double seconds) { parts_->commits.Observe(seconds); }
void Metrics::checkpoint_written(double seconds) { parts_->checkpoints.Observe(seconds); }
void Metrics::recovered(int jobs) { parts_->recoveries.Increment(jobs); }

std::string Metrics::text(const Levels& levels) {
  for (const auto& [state, n] : levels.jobs) parts_->jobs.Add({{"state", state}}).Set(n);
  for (const auto& [kind, n] : levels.streams) parts_->streams.Add({{"kind", kind}}).Set(n);
  parts_->lag.Set(levels.stream_lag);
  parts_->wal.Set(levels.wal_bytes);
  parts_->disk.Set(levels.disk_free_bytes);
  parts_->cell_rate.Set(parts_->cell_updates.per_second());
  return prometheus::TextSerializer().Serialize(parts_->registry.Collect());
}

}  // namespace seaway::metrics
