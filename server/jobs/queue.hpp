// SPDX-License-Identifier: GPL-3.0-or-later
// What clients may do to jobs: submit, hold, cancel, retry, delete ... The order itself lives in the store. Safe from any
// thread; every function may block on the disk.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "server/jobs/report_cache.hpp"
#include "server/jobs/submission.hpp"
#include "server/store/job_store.hpp"

namespace seaway::jobs {

struct QueueLimits {
  int queued_jobs = 10000;
  double job_cpu_s = 0;  ///< 0: no limit
};

struct Submitted {
  bool has_job = false;  ///< false after validate_only
  store::Job job;
  v1::CaseReport report;
};

struct SubmittedSweep {
  bool has_sweep = false;  ///< false after validate_only
  store::Sweep sweep;
  std::vector<v1::CaseReport> reports;  ///< one for each job; empty for a sweep that was known
};

/// Ten random letters and digits.
std::string new_uid();
bool is_uid(const std::string& text);

/// `any`: from the last checkpoint if there is one.
enum class RetryFrom { any, start, checkpoint, stage };

class Queue {
 public:
  /// `wake`: a job was queued. `stop`: a running job shall end after a checkpoint; `kill`: at once.
  Queue(QueueLimits limits, Solver solver, const Workspace& workspace, store::JobStore& store,
        std::function<void()> wake, std::function<void(const std::string& uid)> stop,
        std::function<void(const std::string& uid)> kill, std::function<std::string()> make_uid = new_uid);

  /// Durable when it returns. Throws convert::InputError for a wrong case, a malformed request id, or a known
  /// one with another case (naming the fields); resource_exhausted when a limit is reached.
  Submitted submit(const v1::CreateJobRequest& request);
  /// As submit(), but returns when the case has been checked. What is wrong with it is thrown; otherwise `done` is called
  /// once, when the job is durable or could not be stored, from another thread. It must be quick and must not throw.
  using SubmitDone = std::function<void(Submitted submitted, const std::exception_ptr& error)>;
  void submit_later(const v1::CreateJobRequest& request, SubmitDone done);
  v1::CaseReport validate(const v1::Case& message, const Files& files);
  /// All jobs of a sweep or none (sweeps.cpp). Throws as submit().
  SubmittedSweep submit_sweep(const v1::CreateSweepRequest& request);
  /// Cancels the jobs of a sweep that have not ended. Throws not_found.
  store::Sweep cancel_sweep(const std::string& uid);
  /// Throws not_found, and failed_precondition if the job has ended otherwise.
  store::Job cancel(const std::string& uid);
  /// As cancel(), without a checkpoint if it runs.
  store::Job kill(const std::string& uid);
  /// Throw not_found, and failed_precondition in other states than queued and held.
  store::Job hold(const std::string& uid);
  store::Job release(const std::string& uid);
  /// Throws not_found, and InputError for malformed labels and the like.
  store::Job update(const std::string& uid, const store::JobUpdate& update);
  /// A new job from one that has ended; `stage` (from 1) belongs to RetryFrom::stage, it is 0 for others. Throws not_found,
  /// InputError (request id, stage), failed_precondition.
  store::Job retry(const std::string& uid, const std::string& request_id, RetryFrom from, int stage = 0);
  /// Throws not_found, and failed_precondition if the job has not ended.
  void erase(const std::string& uid);
  /// Erases jobs that ended before this time, at most a hundred; how many.
  int expire(std::int64_t ended_before_ns);
  /// Removes files of cases that do not run and that nobody has checked for so long; how many.
  int sweep_files(std::chrono::seconds unused_for);

 private:
  /// The report of a case, whose digest is known.
  v1::CaseReport report_of(const v1::Case& message, const Files& files, const std::string& digest);
  const QueueLimits limits_;
  const Solver solver_;
  const Workspace& workspace_;
  store::JobStore& store_;
  const std::function<void()> wake_;
  /// Throws for a case that its check refuses, or that costs too much.
  void require_runnable(const v1::CaseReport& report) const;
  std::optional<store::Checkpoint> place_to_retry(const store::Job& base, RetryFrom from, int stage) const;
  store::Job shift(const std::string& uid, store::State from, store::State to, const std::string& what);
  const std::function<void(const std::string&)> stop_, kill_;
  const std::function<std::string()> make_uid_;
  ReportCache reports_{256};
};

}  // namespace seaway::jobs
