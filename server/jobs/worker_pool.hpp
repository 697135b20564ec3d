// SPDX-License-Identifier: GPL-3.0-or-later
// The threads that run jobs, oldest first: each takes a job, lets the executor run an attempt, and moves the job
// by what came of it. Safe from any thread.
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/jobs/executor.hpp"

namespace seaway::jobs {

struct PoolSettings {
  int workers = 1;
  int max_faults = 3;  ///< attempts in a row that may end by a fault of the worker without a new sample
  metrics::Metrics* metrics = nullptr;  ///< null: nothing is counted
};

class WorkerPool {
 public:
  /// All that is given by reference must outlive the pool. Nothing runs before start().
  WorkerPool(PoolSettings settings, Executor& executor, const Workspace& workspace, store::JobStore& store,
             std::shared_ptr<spdlog::logger> log);
  /// Drains.
  ~WorkerPool();

  /// Once: begins to take jobs.
  void start();
  /// There may be a queued job.
  void wake();
  /// Asks the run to end at its next step; nothing happens if it is not running here.
  void request_stop(const std::string& uid);
  /// Ends the run at once, without a checkpoint, if the executor can; nothing happens if it is not running here.
  void request_kill(const std::string& uid);
  /// Takes no more jobs, lets the running ones write a checkpoint and go back to the queue, and returns
  /// when the threads have ended.
  void drain();

 private:
  void work();
  void run_one(const store::Job& job);
  void end_job(const std::string& uid, const RunResult& result);
  bool try_end(const std::string& uid, const RunResult& result);
  void wait_for_space();

  const PoolSettings settings_;
  Executor& executor_;
  const Workspace& workspace_;
  store::JobStore& store_;
  const std::shared_ptr<spdlog::logger> log_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool work_may_wait_ = true;                          // guarded by mutex_
  bool draining_ = false;                              // guarded by mutex_
  struct Running {
    std::stop_source stop, kill;
  };
  std::map<std::string, Running> running_;             // guarded by mutex_
  std::atomic<int> shortages_{0};                      // attempts in a row for which the machine had nothing
  std::vector<std::jthread> threads_;
};

}  // namespace seaway::jobs
