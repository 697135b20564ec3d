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
bool erase(Database& db, const std::string& uid);

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

std::vector<Channel> channels(Database& db, const std::string& uid);
std::vector<Sample> samples(Database& db, const std::string& uid, std::int64_t after, int limit);
std::vector<StageRow> stages(Database& db, const std::string& uid);
std::vector<Checkpoint> checkpoints(Database& db, const std::string& uid);
std::vector<Artifact> artifacts(Database& db, const std::string& uid);
std::vector<Event> events(Database& db, const std::string& uid);

}  // namespace seaway::store::rows
