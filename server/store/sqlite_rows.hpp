// SPDX-License-Identifier: GPL-3.0-or-later
// The changes and queries behind the SQLite store, as functions on a connection; private to server/store.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/store/database.hpp"
#include "server/store/job_store.hpp"

namespace seaway::store::rows {

// --- jobs; each returns the job as it is afterwards, or nothing if it did not change -----------------
Created create(Database& db, const NewJob& job, int limit, std::int64_t now);
std::optional<Job> find(Database& db, const std::string& uid);
std::vector<Job> list(Database& db, const ListQuery& query);
std::optional<Job> take_next(Database& db, std::int64_t now);
std::optional<Job> move(Database& db, const std::string& uid, State from, State to, Reason reason,
                        const std::string& message, std::int64_t now);
std::optional<Job> end_by_fault(Database& db, const std::string& uid, Reason reason, const std::string& message,
                                int max_faults, std::int64_t now);
Recovery recover(Database& db, int max_stalled, std::int64_t now);
bool erase(Database& db, const std::string& uid, std::int64_t now);
Job update(Database& db, const std::string& uid, const JobUpdate& update, std::int64_t now);
Job adopt_history(Database& db, const std::string& uid, const std::string& from, const Checkpoint& checkpoint,
                  std::int64_t now);
std::vector<std::string> ended_before(Database& db, std::int64_t time_ns, int limit);
void prune(Database& db, std::int64_t keep, std::int64_t deleted_before_ns);
std::map<State, std::int64_t> counts(Database& db);
Labels labels(Database& db, std::int64_t job);
void set_labels(Database& db, std::int64_t job, const Labels& labels);
void add_change(Database& db, const std::string& uid, const char* kind, std::int64_t now);
std::vector<Change> changes(Database& db, std::int64_t after, int limit);
ChangeRange change_range(Database& db);
void add_audit(Database& db, const AuditRow& row, std::int64_t now);
std::vector<AuditRow> audit(Database& db, int limit, bool only_denied = false);

// --- sweeps ------------------------------------------------------------------------------------------
CreatedSweep create_sweep(Database& db, const NewSweep& sweep, int limit, std::int64_t now);
std::optional<Sweep> find_sweep(Database& db, const std::string& uid);
std::vector<Sweep> list_sweeps(Database& db, std::int64_t before_id, int limit);
/// After a job was deleted: a sweep none of whose jobs exists goes too.
void drop_empty_sweep(Database& db, const std::string& job_uid);

// --- the data of a run -----------------------------------------------------------------------------
/// id, or not_found.
std::int64_t job_id(Database& db, const std::string& uid);

void set_channels(Database& db, const std::string& uid, const std::vector<Channel>& channels);
void add_samples(Database& db, const std::string& uid, const std::vector<Sample>& samples, std::int64_t now);
void put_stage(Database& db, const std::string& uid, const StageRow& stage);
void add_checkpoint(Database& db, const std::string& uid, const Checkpoint& checkpoint, std::int64_t now);
void add_artifact(Database& db, const std::string& uid, const Artifact& artifact, std::int64_t now);
void add_run_time(Database& db, const std::string& uid, std::int64_t ms);
void set_progress(Database& db, const std::string& uid, const Progress& progress, std::int64_t now);
void add_event(Database& db, const std::string& uid, const std::string& kind, const std::string& text,
               std::int64_t now);

/// After a chunk was sealed.
void add_envelopes(Database& db, const std::string& uid, std::int64_t job, const std::vector<Sample>& chunk);
std::vector<EnvelopePoint> envelope(Database& db, const std::string& uid, std::int64_t after, std::int64_t until,
                                    int max_points);
std::vector<Channel> channels(Database& db, const std::string& uid);
std::vector<Sample> samples(Database& db, const std::string& uid, std::int64_t after, int limit);
std::vector<StageRow> stages(Database& db, const std::string& uid);
std::vector<Checkpoint> checkpoints(Database& db, const std::string& uid);
std::vector<Artifact> artifacts(Database& db, const std::string& uid);
std::vector<Event> events(Database& db, const std::string& uid);

}  // namespace seaway::store::rows
