// SPDX-License-Identifier: GPL-3.0-or-later
// The threads that run jobs, oldest first. Later executors (a process per job, a cluster) take the place
// of run_job() inside; the moves of a job stay here. Safe from any thread.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/jobs/runner.hpp"

namespace seaway::jobs {

struct PoolSettings {
  int workers = 1;
  RunSettings run;
};

class WorkerPool {
 public:
  WorkerPool(PoolSettings settings, Solver solver, const Workspace& workspace, store::JobStore& store,
             std::shared_ptr<spdlog::logger> log);
  /// Drains.
  ~WorkerPool();

  /// There may be a queued job.
  void wake();
  /// Asks the run to end at its next step; nothing happens if it is not running here.
  void request_stop(const std::string& uid);
  /// Takes no more jobs, lets the running ones write a checkpoint and go back to the queue, and returns
  /// when the threads have ended.
  void drain();

 private:
  void work();
  void run_one(const store::Job& job);
  void end_job(const std::string& uid, const RunResult& result);
  bool try_end(const std::string& uid, const RunResult& result);

  const PoolSettings settings_;
  const Solver solver_;
  const Workspace& workspace_;
  store::JobStore& store_;
  const std::shared_ptr<spdlog::logger> log_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool work_may_wait_ = true;                          // guarded by mutex_
  bool draining_ = false;                              // guarded by mutex_
  std::map<std::string, std::stop_source> running_;    // guarded by mutex_
  std::vector<std::jthread> threads_;
};

}  // namespace seaway::jobs
