// SPDX-License-Identifier: GPL-3.0-or-later
// Where jobs live. The store is the only truth: what a reader sees here is durable, so what a client was
// shown survives any crash of the server.
//
// Two kinds of writes. Moves of a job (create, take, move, ...) return when they are committed. The data
// of a run (samples, stages, ...) is handed over without waiting, becomes durable together with all that
// was handed over before it, within the commit interval, and only then visible.
//
// Every function is safe from any thread. Failures are Error: not_found, unavailable (the disk refused),
// data_loss (what was read is damaged), failed_precondition.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/store/envelope.hpp"
#include "server/store/job.hpp"
#include "server/store/sweep.hpp"

namespace seaway::store {

struct ListQuery {
  std::int64_t before_id = 0;  ///< only jobs created before this one; 0: from the newest
  int limit = 50;
  std::vector<State> states;   ///< empty: all
  Labels labels;               ///< jobs that have all of these
};

struct Created {
  Job job;
  bool existed = false;  ///< the request id was known; `job` is the old one, whatever its digest, with its spec
};

struct Recovery {
  std::vector<std::string> requeued, cancelled, failed;
};

class JobStore {
 public:
  virtual ~JobStore() = default;

  // --- jobs ------------------------------------------------------------------------------------------
  virtual Created create(const NewJob& job) = 0;
  /// Throws failed_precondition if the job of this request has been deleted. Refuses with resource_exhausted while `limit` or more jobs are queued; 0: no limit.
  virtual Created create_limited(const NewJob& job, int limit) = 0;
  /// As create_limited() without waiting: `done` is called once, when the job is durable or cannot be made, from the store's
  /// own thread. It must be quick and must not throw.
  using CreateDone = std::function<void(Created created, const std::exception_ptr& error)>;
  virtual void create_later(std::shared_ptr<const NewJob> job, int limit, CreateDone done) = 0;
  virtual std::optional<Job> find(const std::string& uid) const = 0;
  /// Newest first, without their spec.
  virtual std::vector<Job> list(const ListQuery& query) const = 0;
  /// The next queued job, now running with one attempt more; nothing if the queue is empty. The order is by
  /// priority less a tenth of the jobs that were started while it waited: at most 10 (p - q) later jobs of
  /// priority p overtake one of priority q.
  virtual std::optional<Job> take_next() = 0;
  /// Moves the job if it is in state `from`; nothing if it is not (another was faster). Everything handed
  /// over for the job before is durable too. Throws for moves that do not exist.
  virtual std::optional<Job> move(const std::string& uid, State from, State to, Reason reason,
                                  const std::string& message) = 0;
  /// The attempt of a running job ended by a fault of its worker: back to the queue, or failed after
  /// `max_faults` faults in a row without a new sample; a cancelling one is cancelled. Nothing if it does
  /// not run. Everything handed over for the job before is durable too.
  virtual std::optional<Job> end_by_fault(const std::string& uid, Reason reason, const std::string& message,
                                          int max_faults) = 0;
  /// Throws not_found.
  virtual Job update(const std::string& uid, const JobUpdate& update) = 0;
  /// Gives a held job without history that of another one up to `checkpoint`, and queues it. Throws
  /// failed_precondition if it is not like that.
  virtual Job adopt_history(const std::string& uid, const std::string& from, const Checkpoint& checkpoint) = 0;
  /// After a start: running jobs go back to the queue (or fail after `max_stalled` attempts in a row without
  /// a new sample), cancelling ones are cancelled.
  virtual Recovery recover(int max_stalled) = 0;
  /// Removes an ended job and its data; false if it has not ended. Throws not_found. Its request is remembered.
  virtual bool erase(const std::string& uid) = 0;

  // --- sweeps ----------------------------------------------------------------------------------------
  /// All its jobs or none. Throws as create_limited, with the limit for all together.
  virtual CreatedSweep create_sweep(const NewSweep& sweep, int limit) = 0;
  virtual std::optional<Sweep> find_sweep(const std::string& uid) const = 0;
  /// Newest first, without their spec; only those created before this one (0: all).
  virtual std::vector<Sweep> list_sweeps(std::int64_t before_id, int limit) const = 0;

  /// Jobs that ended before this time, oldest first.
  virtual std::vector<std::string> ended_before(std::int64_t time_ns, int limit) const = 0;
  /// Forgets all but the last `keep` changes, and deleted jobs from before this time.
  virtual void prune(std::int64_t keep, std::int64_t deleted_before_ns) = 0;
  /// At most `limit` changes after `after`, in order, without gaps as long as `after` is not before the range.
  virtual std::vector<Change> changes(std::int64_t after, int limit) const = 0;
  virtual ChangeRange change_range() const = 0;
  /// Jobs by state, by its number.
  virtual std::map<State, std::int64_t> counts() const = 0;
  /// Handed over without waiting.
  virtual void add_audit(AuditRow row) = 0;
  virtual std::vector<AuditRow> audit(int limit) const = 0;

  // --- the data of a run -----------------------------------------------------------------------------
  virtual void set_channels(const std::string& uid, std::vector<Channel> channels) = 0;
  /// Consecutive samples. Those that are stored already are compared with what is there: a difference is
  /// recorded once as a REPLAY_MISMATCH event, and the stored ones stay. One that leaves a gap is not stored and
  /// recorded as HISTORY_GAP.
  virtual void add_samples(const std::string& uid, std::vector<Sample> samples) = 0;
  /// Computing time of the running attempt that is not accounted for yet.
  virtual void add_run_time(const std::string& uid, std::int64_t ms) = 0;
  virtual void set_progress(const std::string& uid, const Progress& progress) = 0;
  virtual void put_stage(const std::string& uid, StageRow stage) = 0;
  virtual void add_checkpoint(const std::string& uid, Checkpoint checkpoint) = 0;
  virtual void add_artifact(const std::string& uid, Artifact artifact) = 0;
  virtual void add_event(const std::string& uid, const std::string& kind, const std::string& text) = 0;
  /// Returns when all that was handed over before is durable.
  virtual void flush() = 0;
  /// The disk refused the last commit: what was handed over waits and is tried again every second. Producers
  /// of data should pause.
  virtual bool is_stuck() const = 0;

  // --- reading ---------------------------------------------------------------------------------------
  virtual std::vector<Channel> channels(const std::string& uid) const = 0;
  /// At most `limit` samples after `after`, in order, without gaps.
  virtual std::vector<Sample> samples(const std::string& uid, std::int64_t after, int limit) const = 0;
  /// The samples after `after` up to `until` (0: the last) as at most `max_points` points.
  virtual std::vector<EnvelopePoint> envelope(const std::string& uid, std::int64_t after, std::int64_t until,
                                              int max_points) const = 0;
  virtual std::vector<StageRow> stages(const std::string& uid) const = 0;
  virtual std::vector<Checkpoint> checkpoints(const std::string& uid) const = 0;
  virtual std::vector<Artifact> artifacts(const std::string& uid) const = 0;
  virtual std::vector<Event> events(const std::string& uid) const = 0;

  /// Called after each commit with the jobs that it touched, from the store's own thread: be quick.
  /// The returned function ends it; when it has returned the listener is not called any more.
  using Listener = std::function<void(const std::set<std::string>& uids)>;
  [[nodiscard]] virtual std::function<void()> subscribe(Listener listener) = 0;
};

}  // namespace seaway::store
