// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/runner.hpp"

#include <cerrno>
#include <cstring>
#include <new>

#include "core/base/error.hpp"
#include "server/jobs/store_observer.hpp"
#include "server/jobs/submission.hpp"

namespace seaway::jobs {
namespace {

store::Reason reason_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_argument:
    case ErrorCode::not_found:
    case ErrorCode::failed_precondition: return store::Reason::invalid_input;
    case ErrorCode::unavailable: return store::Reason::disk_full;  // see failure()
    case ErrorCode::resource_exhausted: return store::Reason::memory;
    case ErrorCode::data_loss: return store::Reason::checkpoint_lost;
    case ErrorCode::diverged: return store::Reason::diverged;
    case ErrorCode::internal: return store::Reason::internal;
  }
  return store::Reason::internal;
}

/// A full disk is nobody's fault: another attempt goes on once there is space.
RunResult failure(const Error& error) {
  if (error.code() == ErrorCode::unavailable || says_no_space(error.what()))
    return {RunResult::End::fault, store::Reason::disk_full, error.what()};
  return {RunResult::End::failed, reason_of(error.code()), error.what()};
}

RunResult to_result(const sim::RunOutcome& outcome) {
  switch (outcome.reason) {
    case sim::StopReason::finished: return {RunResult::End::finished, store::Reason::none, outcome.message};
    case sim::StopReason::cancelled: return {RunResult::End::stopped, store::Reason::none, outcome.message};
    case sim::StopReason::diverged: return {RunResult::End::failed, store::Reason::diverged, outcome.message};
  }
  return {RunResult::End::failed, store::Reason::internal, "the solver gave no reason"};
}

}  // namespace

bool says_no_space(std::string_view message) {
  return message.find(std::strerror(ENOSPC)) != message.npos || message.find(std::strerror(EDQUOT)) != message.npos;
}

bool says_no_resources(std::string_view message) {
  for (const int code : {EMFILE, ENFILE, EAGAIN, ENOMEM})
    if (message.find(std::strerror(code)) != message.npos) return true;
  return false;
}

RunResult guarded(const std::function<sim::RunOutcome()>& run) {
  try {
    return to_result(run());
  } catch (const Error& error) {
    return failure(error);
  } catch (const std::bad_alloc&) {
    return {RunResult::End::failed, store::Reason::memory, "out of memory; use larger cells or a machine with more"};
  } catch (const std::exception& error) {
    return {RunResult::End::failed, store::Reason::internal, error.what()};
  }
}

std::optional<store::Job> end_attempt(store::JobStore& store, const std::string& uid, const RunResult& result,
                                      int max_faults) {
  using store::Reason;
  using store::State;
  const auto first = [&](auto... moves) {
    std::optional<store::Job> out;
    ((out = store.move(uid, moves.from, moves.to, moves.reason, moves.message)) || ...);
    return out;
  };
  struct Move {
    State from, to;
    Reason reason;
    std::string message;
  };
  switch (result.end) {
    case RunResult::End::finished:
      return first(Move{State::running, State::succeeded, Reason::none, result.message},
                   Move{State::cancelling, State::succeeded, Reason::none, "the run had ended before it was cancelled"});
    case RunResult::End::stopped:
      // A cancelled job is CANCELLING before its run is asked to stop, so RUNNING here means a drain.
      return first(Move{State::cancelling, State::cancelled, Reason::user, result.message},
                   Move{State::running, State::queued, Reason::server_drain, result.message});
    case RunResult::End::failed:
      return first(Move{State::running, State::failed, result.reason, result.message},
                   Move{State::cancelling, State::failed, result.reason, result.message});
    case RunResult::End::fault:
      if (result.shortage)
        return first(Move{State::cancelling, State::cancelled, Reason::user, result.message},
                     Move{State::running, State::queued, result.reason, result.message});
      return store.end_by_fault(uid, result.reason, result.message, max_faults);
  }
  return std::nullopt;
}

RunResult run_job(const store::Job& job, const Solver& solver, const Workspace& workspace, store::JobStore& store,
                  const RunSettings& settings, std::stop_token stop, std::shared_ptr<spdlog::logger> log) {
  return guarded([&] {
    const v1::CreateJobRequest spec = decode_spec(job.spec);
    const sim::Case core = bind_case(spec.case_(), spec.files(), workspace);
    const std::string folder = workspace.run_folder(job.uid);
    for (const std::string& name : workspace.prepare_run(job.uid, store.checkpoints(job.uid), store.artifacts(job.uid)))
      log->warn("job={} event=removed_unrecorded file={}", job.uid, name);
    StoreObserver observer(job.uid, job.last_sequence, folder, store, log, settings.metrics);
    sim::RunOptions options;
    options.folder = folder;
    options.checkpoint_interval = settings.checkpoint_interval_s;
    options.case_digest = job.digest;
    try {
      const sim::RunOutcome outcome = solver.run(core, options, observer, RunContext{log, std::move(stop), settings.threads});
      observer.finish();
      return outcome;
    } catch (...) {
      observer.finish();
      throw;
    }
  });
}

}  // namespace seaway::jobs
