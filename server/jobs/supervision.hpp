// SPDX-License-Identifier: GPL-3.0-or-later
// One attempt in a child: reads its records into the store, watches its limits, passes stop and kill on, and
// says what it came to. One thread.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "seaway/worker/attempt.pb.h"
#include "server/jobs/child_process.hpp"
#include "server/jobs/executor.hpp"
#include "server/jobs/frames.hpp"
#include "server/jobs/store_observer.hpp"

namespace seaway::jobs {

class Supervision {
 public:
  Supervision(const ProcessSettings& settings, const Workspace& workspace, store::JobStore& store,
              std::shared_ptr<spdlog::logger> log, const store::Job& job, const std::vector<int>& cpus);
  /// Throws Error for what lies outside the child: no lease, no process.
  RunResult run(const AttemptControl& control);

 private:
  using Clock = std::chrono::steady_clock;
  /// Why the child was asked to end, or killed.
  enum class Verdict { none, stop, kill, wall, disk, memory, lease, stall, damaged };

  void start_child(const Descriptor& lease);
  std::string order() const;
  void wait_for_news(int wake);
  void read_records();
  void read_errors();
  void take(const worker::Record& record);
  void watch(Clock::time_point now);
  void account(Clock::time_point now);
  void ask(Verdict why);
  void kill(Verdict why);
  RunResult result();
  RunResult fault(store::Reason reason, const std::string& what) const;

  const ProcessSettings& settings_;
  const Workspace& workspace_;
  store::JobStore& store_;
  const std::shared_ptr<spdlog::logger> log_;
  const store::Job& job_;
  const std::vector<int>& cpus_;
  StoreObserver observer_;
  std::optional<ChildProcess> child_;
  FrameReader frames_;
  bool records_ended_ = false, errors_ended_ = false;
  std::optional<worker::Record::Outcome> outcome_;
  std::string refused_;                ///< the observer threw: the run is not what it should be
  store::Reason refused_reason_ = store::Reason::internal;
  std::string last_words_;             ///< end of the child's stderr
  Verdict verdict_ = Verdict::none;
  Clock::time_point begun_, alive_, news_, asked_, accounted_, disk_checked_;
};

}  // namespace seaway::jobs
