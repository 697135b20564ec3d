// SPDX-License-Identifier: GPL-3.0-or-later
// Priorities, labels, notes, changes, retention, retries, audit: rows in and out.
#include "core/base/error.hpp"
#include "server/store/sqlite_rows.hpp"

namespace seaway::store::rows {

Labels labels(Database& db, std::int64_t job) {
  Labels out;
  Statement query = db.prepare("SELECT key, value FROM labels WHERE job = ?");
  query.bind(job);
  while (query.step()) out.emplace(query.text(0), query.text(1));
  return out;
}

void set_labels(Database& db, std::int64_t job, const Labels& labels) {
  db.prepare("DELETE FROM labels WHERE job = ?").bind(job).run();
  for (const auto& [key, value] : labels)
    db.prepare("INSERT INTO labels (job, key, value) VALUES (?, ?, ?)").bind(job, key, value).run();
}

Job update(Database& db, const std::string& uid, const JobUpdate& u, std::int64_t now) {
  const std::int64_t id = job_id(db, uid);
  if (u.priority)
    db.prepare("UPDATE jobs SET priority = ?1, rank = 10 * ?1 - take_mark WHERE id = ?2").bind(*u.priority, id).run();
  if (u.note) db.prepare("UPDATE jobs SET note = ? WHERE id = ?").bind(*u.note, id).run();
  if (u.labels) set_labels(db, id, *u.labels);
  db.prepare("UPDATE jobs SET updated_ns = ? WHERE id = ?").bind(now, id).run();
  add_change(db, uid, "UPDATED", now);
  return *find(db, uid);
}

Job adopt_history(Database& db, const std::string& uid, const std::string& from, const Checkpoint& checkpoint,
                  std::int64_t now) {
  const auto job = find(db, uid);
  if (!job || job->state != State::held || job->last_sequence != 0)
    fail(ErrorCode::failed_precondition, "job {} is not a held one without a history", uid);
  set_channels(db, uid, channels(db, from));
  constexpr int page = 10'000;
  for (std::int64_t at = 0; at < checkpoint.sequence;) {
    const auto part = samples(db, from, at, static_cast<int>(std::min<std::int64_t>(page, checkpoint.sequence - at)));
    if (part.empty()) fail(ErrorCode::data_loss, "job {} has no sample {}", from, at + 1);
    add_samples(db, uid, part, now);
    at = part.back().sequence;
  }
  const auto last = samples(db, from, checkpoint.sequence - 1, 1);
  for (const StageRow& stage : stages(db, from))  // those that follow will be made again
    if (!last.empty() && stage.stage <= last.front().stage) put_stage(db, uid, stage);
  add_checkpoint(db, uid, checkpoint, now);
  add_event(db, uid, "RETRY", fmt::format("goes on after sample {} of job {}", checkpoint.sequence, from), now);
  return *move(db, uid, State::held, State::queued, Reason::none, "", now);
}

std::vector<std::string> ended_before(Database& db, std::int64_t time_ns, int limit) {
  std::vector<std::string> out;
  Statement query = db.prepare("SELECT uid FROM jobs WHERE ended_ns > 0 AND ended_ns < ? ORDER BY ended_ns LIMIT ?");
  query.bind(time_ns, limit);
  while (query.step()) out.push_back(query.text(0));
  return out;
}

void prune(Database& db, std::int64_t keep, std::int64_t deleted_before_ns) {
  db.prepare("DELETE FROM changes WHERE revision <= (SELECT max(revision) FROM changes) - ?").bind(keep).run();
  db.prepare("DELETE FROM audit WHERE id <= (SELECT max(id) FROM audit) - ?").bind(keep).run();
  db.prepare("DELETE FROM tombstones WHERE deleted_ns < ?").bind(deleted_before_ns).run();
}

std::map<State, std::int64_t> counts(Database& db) {
  std::map<State, std::int64_t> out;
  Statement query = db.prepare("SELECT state, count(*) FROM jobs GROUP BY state");
  while (query.step()) out[static_cast<State>(query.integer(0))] = query.integer(1);
  return out;
}

void add_change(Database& db, const std::string& uid, const char* kind, std::int64_t now) {
  db.prepare("INSERT INTO changes (uid, kind, state, time_ns) SELECT uid, ?, state, ? FROM jobs WHERE uid = ?")
      .bind(std::string(kind), now, uid)
      .run();
}

std::vector<Change> changes(Database& db, std::int64_t after, int limit) {
  std::vector<Change> out;
  Statement query =
      db.prepare("SELECT revision, uid, kind, state, time_ns FROM changes WHERE revision > ? ORDER BY revision LIMIT ?");
  query.bind(after, limit);
  while (query.step())
    out.push_back({query.integer(0), query.text(1), query.text(2), static_cast<State>(query.integer(3)), query.integer(4)});
  return out;
}

ChangeRange change_range(Database& db) {
  ChangeRange out;
  Statement query = db.prepare("SELECT (SELECT min(revision) FROM changes), (SELECT max(revision) FROM changes)");
  if (query.step() && query.integer(1) > 0) out = {query.integer(0), query.integer(1)};
  return out;
}

void add_audit(Database& db, const AuditRow& row, std::int64_t now) {
  db.prepare("INSERT INTO audit (time_ns, principal, peer, method, target, outcome) VALUES (?, ?, ?, ?, ?, ?)")
      .bind(now, row.principal, row.peer, row.method, row.target, row.outcome)
      .run();
}

std::vector<AuditRow> audit(Database& db, int limit, bool only_denied) {
  std::vector<AuditRow> out;
  Statement query = db.prepare("SELECT principal, peer, method, target, outcome, time_ns FROM audit "
                               "WHERE ?1 = 0 OR outcome = 'DENIED' ORDER BY id DESC LIMIT ?2");
  query.bind(only_denied ? 1 : 0, limit);
  while (query.step())
    out.push_back({query.text(0), query.text(1), query.text(2), query.text(3), query.text(4), query.integer(5)});
  return out;
}

}  // namespace seaway::store::rows
