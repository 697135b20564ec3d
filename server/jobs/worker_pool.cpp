// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/worker_pool.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include "core/base/error.hpp"

namespace seaway::jobs {

using store::Reason;
using store::State;

WorkerPool::WorkerPool(PoolSettings settings, Executor& executor, const Workspace& workspace, store::JobStore& store,
                       std::shared_ptr<spdlog::logger> log)
    : settings_(settings), executor_(executor), workspace_(workspace), store_(store), log_(std::move(log)) {}

void WorkerPool::start() {
  for (int i = 0; i < settings_.workers; ++i) threads_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() { drain(); }

void WorkerPool::wake() {
  {
    const std::lock_guard lock(mutex_);
    work_may_wait_ = true;
  }
  wake_.notify_all();
}

void WorkerPool::request_stop(const std::string& uid) {
  const std::lock_guard lock(mutex_);
  if (const auto run = running_.find(uid); run != running_.end()) run->second.stop.request_stop();
}

void WorkerPool::request_kill(const std::string& uid) {
  const std::lock_guard lock(mutex_);
  if (const auto run = running_.find(uid); run != running_.end()) run->second.kill.request_stop();
}

void WorkerPool::drain() {
  {
    const std::lock_guard lock(mutex_);
    draining_ = true;
    for (auto& [uid, run] : running_) run.stop.request_stop();
  }
  wake_.notify_all();
  threads_.clear();  // joins
}

void WorkerPool::work() {
  // The solver takes every core it gets; calls of clients must not wait for it. Its own threads inherit this.
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), ::getpriority(PRIO_PROCESS, 0) + 5);
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return draining_ || work_may_wait_; });
      if (draining_) return;
      work_may_wait_ = false;
    }
    try {
      const auto job = store_.take_next();
      if (!job) continue;
      wake();  // there may be another one for another thread
      run_one(*job);
    } catch (const std::exception& error) {
      log_->error("event=worker_error text=\"{}\"", error.what());
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, std::chrono::seconds(1), [&] { return draining_; });
      work_may_wait_ = true;
    }
  }
}

void WorkerPool::run_one(const store::Job& job) {
  Running run;
  {
    const std::lock_guard lock(mutex_);
    running_[job.uid] = run;
    if (draining_) run.stop.request_stop();
  }
  // A cancellation between take_next() and here has found nobody to tell.
  if (const auto now = store_.find(job.uid); now && now->state == State::cancelling) run.stop.request_stop();
  if (settings_.metrics != nullptr && job.attempt == 1)
    settings_.metrics->job_waited(1e-9 * static_cast<double>(job.started_ns - job.created_ns));
  log_->info("job={} event=started attempt={} after_sequence={}", job.uid, job.attempt, job.last_sequence);
  const RunResult result = executor_.run(job, {run.stop.get_token(), run.kill.get_token()});
  {
    const std::lock_guard lock(mutex_);
    running_.erase(job.uid);
  }
  end_job(job.uid, result);
}

void WorkerPool::end_job(const std::string& uid, const RunResult& result) {
  for (;;) {
    try {
      if (!try_end(uid, result)) log_->error("job={} event=lost text=\"not running any more\"", uid);
      return;
    } catch (const std::exception& error) {
      log_->error("job={} event=end_not_stored text=\"{}\"", uid, error.what());
    }
    // The disk refuses: try until it takes the move, or leave it to the recovery of the next start.
    std::unique_lock lock(mutex_);
    if (wake_.wait_for(lock, std::chrono::seconds(1), [&] { return draining_; })) return;
  }
}

bool WorkerPool::try_end(const std::string& uid, const RunResult& result) {
  const bool fault = result.end == RunResult::End::fault;
  const bool full = fault && result.reason == Reason::disk_full && !workspace_.has_space();
  // A full disk does not count: the job waits for space as long as it takes.
  RunResult counted = result;
  counted.shortage = result.shortage || full;
  const auto job = end_attempt(store_, uid, counted, settings_.max_faults);
  if (!job) return false;
  log_->log(fault ? spdlog::level::warn : spdlog::level::info,
            "job={} event={} state={} reason={} faults={} samples={} text=\"{}\"", uid, fault ? "fault" : "ended",
            store::to_string(job->state), store::to_string(job->reason), job->faults, job->last_sequence, job->message);
  if (fault && job->state == State::queued && settings_.metrics != nullptr) settings_.metrics->recovered(1);
  if (!result.shortage) shortages_ = 0;
  if (full) {
    wait_for_space();
  } else if (result.shortage) {
    // Soon, and less often if it lasts: each attempt leaves its events in the database.
    const int pause_s = shortages_++ < 10 ? 1 : 10;
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, std::chrono::seconds(pause_s), [&] { return draining_; });
  }
  if (job->state == State::queued) wake();
  return true;
}

void WorkerPool::wait_for_space() {
  log_->warn("event=paused text=\"the disk is full; jobs go on when there is space\"");
  std::unique_lock lock(mutex_);
  for (;;) {
    if (wake_.wait_for(lock, std::chrono::milliseconds(500), [&] { return draining_; })) return;
    lock.unlock();
    const bool space = workspace_.has_space();
    lock.lock();
    if (space) break;
  }
  lock.unlock();
  log_->info("event=resumed text=\"the disk has space again\"");
}

}  // namespace seaway::jobs
