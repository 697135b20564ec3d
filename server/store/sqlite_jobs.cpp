// SPDX-License-Identifier: GPL-3.0-or-later
// Jobs and their moves: rows in and out.
#include <algorithm>

#include "core/base/error.hpp"
#include "server/store/sqlite_rows.hpp"

namespace seaway::store::rows {
namespace {

constexpr std::string_view job_columns =
    "id, uid, request_id, title, state, reason, message, attempt, stalled_attempts, digest, code_version, "
    "created_ns, started_ns, ended_ns, updated_ns, stage, stage_count, time_s, fraction, remaining_s, held, "
    "last_sequence, checkpoint_sequence, faults, run_ms, priority, note, base_uid";

Job read_job(Database& db, const Statement& row, bool with_spec) {
  Job j;
  j.id = row.integer(0);
  j.uid = row.text(1);
  j.request_id = row.text(2);
  j.title = row.text(3);
  j.state = static_cast<State>(row.integer(4));
  j.reason = static_cast<Reason>(row.integer(5));
  j.message = row.text(6);
  j.attempt = static_cast<int>(row.integer(7));
  j.stalled_attempts = static_cast<int>(row.integer(8));
  j.digest = row.text(9);
  j.code_version = row.text(10);
  j.created_ns = row.integer(11);
  j.started_ns = row.integer(12);
  j.ended_ns = row.integer(13);
  j.updated_ns = row.integer(14);
  j.progress = {static_cast<int>(row.integer(15)), static_cast<int>(row.integer(16)), row.real(17), row.real(18),
                row.real(19), row.integer(20) != 0};
  j.last_sequence = row.integer(21);
  j.checkpoint_sequence = row.integer(22);
  j.faults = static_cast<int>(row.integer(23));
  j.run_ms = row.integer(24);
  j.priority = static_cast<int>(row.integer(25));
  j.note = row.text(26);
  j.base_uid = row.text(27);
  if (with_spec) j.spec = row.text(28);
  j.labels = labels(db, j.id);
  return j;
}

std::optional<Job> find_by(Database& db, std::string_view column, const std::string& value) {
  const std::string sql = "SELECT " + std::string(job_columns) + ", (SELECT spec FROM case_specs WHERE digest = jobs.digest) " +
                          "FROM jobs WHERE " + std::string(column) + " = ?";
  Statement query = db.prepare(sql);
  if (!query.bind(value).step()) return std::nullopt;
  return read_job(db, query, true);
}

/// One guarded move with its event; false if the job was not in `from`.
bool apply_move(Database& db, const std::string& uid, State from, State to, Reason reason, const std::string& message,
                std::int64_t now) {
  if (!may_move(from, to))
    fail(ErrorCode::failed_precondition, "job {}: {} -> {} is no move", uid, to_string(from), to_string(to));
  db.prepare("UPDATE jobs SET state = ?, reason = ?, message = ?, updated_ns = ?, ended_ns = ? WHERE uid = ? AND state = ?")
      .bind(static_cast<int>(to), static_cast<int>(reason), message, now, is_terminal(to) ? now : std::int64_t{0}, uid,
            static_cast<int>(from))
      .run();
  if (db.changes() == 0) return false;
  if (from == State::running || from == State::cancelling)
    db.prepare("UPDATE attempts SET ended_ns = ?, outcome = ? WHERE (job, attempt) = (SELECT id, attempt FROM jobs WHERE uid = ?)")
        .bind(now, std::string(to_string(to)), uid)
        .run();
  std::string text(to_string(to));
  if (reason != Reason::none) text.append(1, ' ').append(to_string(reason));
  if (!message.empty()) text.append(": ").append(message);
  add_event(db, uid, "STATE", text, now);
  add_change(db, uid, "STATE", now);
  return true;
}

/// One job more has this case.
void keep_case(Database& db, const NewJob& job) {
  db.prepare("UPDATE case_uses SET jobs = jobs + 1 WHERE digest = ?").bind(job.digest).run();
  if (db.changes() > 0) return;
  db.prepare("INSERT INTO case_uses (digest, jobs) VALUES (?, 1)").bind(job.digest).run();
  db.prepare("INSERT INTO case_specs (digest, spec) VALUES (?, ?)").bind(job.digest, Statement::Blob{job.spec}).run();
}

/// One job less has this case.
void release_case(Database& db, const std::string& digest) {
  db.prepare("UPDATE case_uses SET jobs = jobs - 1 WHERE digest = ?").bind(digest).run();
  db.prepare("DELETE FROM case_uses WHERE digest = ? AND jobs = 0").bind(digest).run();
  if (db.changes() > 0) db.prepare("DELETE FROM case_specs WHERE digest = ?").bind(digest).run();
}

}  // namespace

Created create(Database& db, const NewJob& job, int limit, std::int64_t now) {
  if (auto known = find_by(db, "request_id", job.request_id)) return {std::move(*known), true};
  {
    Statement query = db.prepare("SELECT uid FROM tombstones WHERE request_id = ?");
    if (query.bind(job.request_id).step())
      fail(ErrorCode::failed_precondition, "job {} was made by this request and has been deleted; use a new request id",
           query.text(0));
  }
  if (limit > 0) {
    Statement query = db.prepare("SELECT count(*) FROM (SELECT 1 FROM jobs WHERE state = 1 LIMIT ?)");
    query.bind(limit);
    if (query.step() && query.integer(0) >= limit)
      fail(ErrorCode::resource_exhausted, "{} jobs are waiting, which is the limit; submit again later", limit);
  }
  db.prepare("INSERT INTO jobs (uid, request_id, title, state, digest, code_version, created_ns, updated_ns, "
             "priority, note, base_uid, take_mark, rank) SELECT ?1, ?2, ?3, ?4, ?5, ?6, ?7, ?7, ?8, ?9, ?10, value, "
             "10 * ?8 - value FROM counters WHERE name = 'takes'")
      .bind(job.uid, job.request_id, job.title, static_cast<int>(job.held ? State::held : State::queued), job.digest,
            job.code_version, now, job.priority, job.note, job.base_uid)
      .run();
  const std::int64_t id = db.last_row_id();
  keep_case(db, job);
  set_labels(db, id, job.labels);
  add_event(db, job.uid, "STATE", job.held ? "HELD" : "QUEUED", now);
  add_change(db, job.uid, "CREATED", now);
  static const std::string sql = "SELECT " + std::string(job_columns) + " FROM jobs WHERE id = ?";
  Statement row = db.prepare(sql);
  row.bind(id).step();
  return {read_job(db, row, false), false};
}

std::optional<Job> find(Database& db, const std::string& uid) { return find_by(db, "uid", uid); }

std::vector<Job> list(Database& db, const ListQuery& query) {
  std::string sql = "SELECT " + std::string(job_columns) + " FROM jobs WHERE id < ?";
  std::vector<State> states = query.states;
  std::sort(states.begin(), states.end());
  states.erase(std::unique(states.begin(), states.end()), states.end());
  for (std::size_t i = 0; i < states.size(); ++i) {
    sql += i == 0 ? " AND state IN (" : ", ";
    sql += std::to_string(static_cast<int>(states[i]));
  }
  if (!states.empty()) sql += ")";
  for (std::size_t i = 0; i < query.labels.size(); ++i)
    sql += " AND EXISTS (SELECT 1 FROM labels WHERE job = jobs.id AND key = ? AND value = ?)";
  sql += " ORDER BY id DESC LIMIT ?";
  std::vector<Job> out;
  // Thousands of filters are possible: kept, they would fill the memory.
  Statement rows = db.prepare_once(sql);
  int index = 0;
  rows.bind_one(++index, query.before_id > 0 ? query.before_id : std::int64_t{1} << 62);
  for (const auto& [key, value] : query.labels) {
    rows.bind_one(++index, key);
    rows.bind_one(++index, value);
  }
  rows.bind_one(++index, query.limit);
  while (rows.step()) out.push_back(read_job(db, rows, false));
  return out;
}

std::optional<Job> take_next(Database& db, std::int64_t now) {
  std::string uid;
  {
    Statement query = db.prepare("SELECT uid FROM jobs WHERE state = 1 ORDER BY rank DESC, id LIMIT 1");
    if (!query.step()) return std::nullopt;
    uid = query.text(0);
  }
  db.prepare("UPDATE jobs SET attempt = attempt + 1, attempt_sequence = last_sequence, started_ns = "
             "CASE started_ns WHEN 0 THEN ? ELSE started_ns END WHERE uid = ?")
      .bind(now, uid)
      .run();
  db.execute("UPDATE counters SET value = value + 1 WHERE name = 'takes'");
  db.prepare("INSERT INTO attempts (job, attempt, first_sequence, started_ns) "
             "SELECT id, attempt, last_sequence + 1, ? FROM jobs WHERE uid = ?")
      .bind(now, uid)
      .run();
  apply_move(db, uid, State::queued, State::running, Reason::none, "", now);
  return find(db, uid);
}

std::optional<Job> move(Database& db, const std::string& uid, State from, State to, Reason reason,
                        const std::string& message, std::int64_t now) {
  job_id(db, uid);
  if (!apply_move(db, uid, from, to, reason, message, now)) return std::nullopt;
  return find(db, uid);
}

std::optional<Job> end_by_fault(Database& db, const std::string& uid, Reason reason, const std::string& message,
                                int max_faults, std::int64_t now) {
  job_id(db, uid);
  const auto cancelled = move(db, uid, State::cancelling, State::cancelled, Reason::user, "the worker failed: " + message, now);
  if (cancelled) return cancelled;
  db.prepare("UPDATE jobs SET faults = CASE WHEN last_sequence > attempt_sequence THEN 1 ELSE faults + 1 END "
             "WHERE uid = ? AND state = 3")
      .bind(uid)
      .run();
  if (db.changes() == 0) return std::nullopt;
  const bool again = find(db, uid)->faults < max_faults;
  return move(db, uid, State::running, again ? State::queued : State::failed, reason, message, now);
}

Recovery recover(Database& db, int max_stalled, std::int64_t now) {
  Recovery out;
  struct Row {
    std::string uid;
    State state;
    bool stalled;
    int count;
  };
  std::vector<Row> found;
  {
    Statement query = db.prepare(
        "SELECT uid, state, last_sequence <= attempt_sequence, stalled_attempts FROM jobs WHERE state IN (3, 4) ORDER BY id");
    while (query.step())
      found.push_back({query.text(0), static_cast<State>(query.integer(1)), query.integer(2) != 0,
                       static_cast<int>(query.integer(3))});
  }
  for (const Row& row : found) {
    const int stalled = row.stalled ? row.count + 1 : 0;
    db.prepare("UPDATE jobs SET stalled_attempts = ? WHERE uid = ?").bind(stalled, row.uid).run();
    if (row.state == State::cancelling) {
      apply_move(db, row.uid, row.state, State::cancelled, Reason::user, "the server stopped while cancelling", now);
      out.cancelled.push_back(row.uid);
    } else if (stalled >= max_stalled) {
      apply_move(db, row.uid, row.state, State::failed, Reason::worker_crash,
                 "the server ended " + std::to_string(stalled) + " times in a row without a new sample of this job", now);
      out.failed.push_back(row.uid);
    } else {
      add_event(db, row.uid, "RECOVERED", "the server had ended during this attempt", now);
      apply_move(db, row.uid, row.state, State::queued, Reason::server_restart, "", now);
      out.requeued.push_back(row.uid);
    }
  }
  return out;
}

bool erase(Database& db, const std::string& uid, std::int64_t now) {
  const auto job = find(db, uid);
  if (!job) fail(ErrorCode::not_found, "job {} does not exist; list the jobs to find its name", uid);
  if (!is_terminal(job->state)) return false;
  add_change(db, uid, "DELETED", now);
  db.prepare("INSERT OR REPLACE INTO tombstones (request_id, uid, deleted_ns) VALUES (?, ?, ?)")
      .bind(job->request_id, uid, now)
      .run();
  db.prepare("DELETE FROM jobs WHERE id = ?").bind(job->id).run();
  release_case(db, job->digest);
  drop_empty_sweep(db, uid);
  return true;
}

}  // namespace seaway::store::rows
