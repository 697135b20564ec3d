// SPDX-License-Identifier: GPL-3.0-or-later
// Where attempts run. `thread`: in this process, cheap, and the service lives and dies with its solver.
// `process`: in a child, so that a crash, a hang or too much memory ends that job alone. A cluster's scheduler
// fits behind the same call: submit, poll, collect, return.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>

#include <spdlog/logger.h>

#include "server/jobs/runner.hpp"

namespace seaway::jobs {

struct AttemptControl {
  std::stop_token stop;  ///< end after a checkpoint
  std::stop_token kill;  ///< end at once, without one
};

class Executor {
 public:
  virtual ~Executor() = default;
  /// One attempt at a job that is RUNNING in the store; blocks until it has ended. Never throws. Before it
  /// returns all data of the attempt was handed to the store. Safe from several threads for different jobs.
  virtual RunResult run(const store::Job& job, const AttemptControl& control) = 0;
};

/// The solver in the calling thread. It cannot be killed: `kill` is taken as `stop`. No limits but threads.
std::unique_ptr<Executor> make_thread_executor(RunSettings settings, Solver solver, const Workspace& workspace,
                                               store::JobStore& store, std::shared_ptr<spdlog::logger> log);

/// 0: no limit.
struct AttemptLimits {
  std::int64_t memory_bytes = 0;      ///< private memory of the process
  std::int64_t disk_bytes = 0;        ///< of the run folder
  std::chrono::milliseconds wall{0};  ///< computing time of all attempts of a job
};

struct ProcessSettings {
  RunSettings run;
  AttemptLimits limits;
  int jobs = 1;                                     ///< at the same time; the CPUs of the server are divided among them
  std::string program;                              ///< seaway-run
  std::chrono::milliseconds lease{30'000};          ///< a worker without a sign of life for so long is dead
  std::chrono::milliseconds stall{600'000};         ///< a solver without a result for so long hangs
  std::chrono::milliseconds stop_grace{60'000};     ///< from a stop request to the kill
};

/// The solver in a child, one a job. Ends workers that an earlier server left behind. Throws
/// Error(invalid_argument) if the program cannot be executed.
std::unique_ptr<Executor> make_process_executor(ProcessSettings settings, const Workspace& workspace,
                                                store::JobStore& store, std::shared_ptr<spdlog::logger> log);

}  // namespace seaway::jobs
