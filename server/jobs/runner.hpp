// SPDX-License-Identifier: GPL-3.0-or-later
// One attempt at one job: from its stored case through the solver into the store. Runs in the caller's thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include <spdlog/logger.h>

#include "server/jobs/solver.hpp"
#include "server/jobs/workspace.hpp"
#include "server/metrics/metrics.hpp"
#include "server/store/job_store.hpp"

namespace seaway::jobs {

struct RunSettings {
  int threads = 1;
  double checkpoint_interval_s = 60;
  metrics::Metrics* metrics = nullptr;  ///< null: nothing is counted
};

/// How an attempt ended; the caller moves the job accordingly.
struct RunResult {
  /// `fault`: the worker broke, not the case; another attempt may succeed.
  enum class End { finished, stopped, failed, fault };
  End end = End::failed;
  store::Reason reason = store::Reason::none;  ///< failed, fault
  std::string message;
  /// With `fault`: the machine had nothing left for it, or has no program for it (it is being upgraded). Neither worker nor
  /// case is to blame, and it does not count.
  bool shortage = false;
};

/// Whether a failure says that the disk is full; the solver reports that under several codes.
bool says_no_space(std::string_view message);
/// Whether a failure says that there are no descriptors, processes or memory left.
bool says_no_resources(std::string_view message);
/// What a run of the solver comes to, its exceptions included. Never throws.
RunResult guarded(const std::function<sim::RunOutcome()>& run);

/// Moves the job of an attempt that has ended by what came of it; the job as it is then, or nothing if it did
/// not run any more. `max_faults`: as JobStore::end_by_fault. Throws what the store throws.
std::optional<store::Job> end_attempt(store::JobStore& store, const std::string& uid, const RunResult& result,
                                      int max_faults);

/// Never throws. Before it returns all data of the attempt was handed to the store (not yet flushed).
RunResult run_job(const store::Job& job, const Solver& solver, const Workspace& workspace, store::JobStore& store,
                  const RunSettings& settings, std::stop_token stop, std::shared_ptr<spdlog::logger> log);

}  // namespace seaway::jobs
