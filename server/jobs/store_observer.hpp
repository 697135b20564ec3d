// SPDX-License-Identifier: GPL-3.0-or-later
// Writes what a run reports into the store, in the order of the run. Progress, which only the newest value
// of counts, is sent a few times a second.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <spdlog/logger.h>

#include "core/sim/run_observer.hpp"
#include "seaway/v1/result.pb.h"
#include "server/metrics/metrics.hpp"
#include "server/store/job_store.hpp"

namespace seaway::jobs {

class StoreObserver final : public sim::RunObserver {
 public:
  using Clock = std::chrono::steady_clock;
  /// `last_sequence`: of the stored history; samples up to it may come again, later ones must follow.
  /// `folder`: artifacts outside it are refused. `metrics`: null: not counted. `now` paces the progress.
  StoreObserver(std::string uid, std::int64_t last_sequence, std::string folder, store::JobStore& store,
                std::shared_ptr<spdlog::logger> log, metrics::Metrics* metrics = nullptr,
                std::function<Clock::time_point()> now = Clock::now);

  void on_channels(const std::vector<sim::Channel>& channels) override;
  void on_stage_started(const sim::StageInfo& info) override;
  void on_sample(const sim::Sample& sample) override;
  void on_progress(const sim::Progress& progress) override;
  void on_stage_finished(const sim::StageResult& result) override;
  void on_checkpoint(const std::string& path, std::int64_t sequence, double write_s) override;
  void on_artifact(const std::string& name, const std::string& path, const std::string& media_type) override;
  void on_event(const std::string& kind, const std::string& text) override;
  /// What the functions above come to, for a run in another process.
  void put_stage(const v1::StageReport& report);
  /// Throws Error(internal) if the file is not one of this run.
  void put_checkpoint(const store::Checkpoint& checkpoint, double write_s);
  /// Sends the last progress.
  void finish();

 private:
  void send_progress();
  bool is_in_folder(const std::string& absolute) const;
  void count_steps(const sim::Sample& sample);

  const std::string uid_, folder_;
  store::JobStore& store_;
  const std::shared_ptr<spdlog::logger> log_;
  metrics::Metrics* const metrics_;
  const std::function<Clock::time_point()> now_;
  std::int64_t cells_ = 0;  ///< of the running stage
  std::int64_t step_ = -1;  ///< of the last sample; -1: not known, after a resume
  std::int64_t next_;  ///< largest sequence number that may come
  sim::Progress progress_;
  bool progress_waits_ = false;
  Clock::time_point progress_sent_{};
};

}  // namespace seaway::jobs
