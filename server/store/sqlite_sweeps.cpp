// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps: rows in and out.
#include "core/base/error.hpp"
#include "server/store/sqlite_rows.hpp"

namespace seaway::store::rows {
namespace {

constexpr std::string_view sweep_columns = "id, uid, request_id, title, digest, code_version, created_ns";

std::vector<SweepMember> members(Database& db, std::int64_t sweep) {
  std::vector<SweepMember> out;
  Statement query = db.prepare(
      "SELECT case_name, period_s, height_m, heading_deg, sweep_jobs.uid, jobs.id IS NOT NULL, jobs.state, jobs.fraction "
      "FROM sweep_jobs LEFT JOIN jobs ON jobs.uid = sweep_jobs.uid WHERE sweep = ? ORDER BY position");
  query.bind(sweep);
  while (query.step())
    out.push_back({{query.text(0), query.real(1), query.real(2), query.real(3)},
                   query.text(4),
                   query.integer(5) != 0,
                   static_cast<State>(query.integer(6)),
                   query.real(7)});
  return out;
}

Sweep read_sweep(Database& db, const Statement& row, bool with_spec) {
  Sweep s;
  s.id = row.integer(0);
  s.uid = row.text(1);
  s.request_id = row.text(2);
  s.title = row.text(3);
  s.digest = row.text(4);
  s.code_version = row.text(5);
  s.created_ns = row.integer(6);
  if (with_spec) s.spec = row.text(7);
  s.members = members(db, s.id);
  return s;
}

std::optional<Sweep> find_by(Database& db, const std::string& column, const std::string& value) {
  Statement query = db.prepare("SELECT " + std::string(sweep_columns) + ", spec FROM sweeps WHERE " + column + " = ?");
  if (!query.bind(value).step()) return std::nullopt;
  return read_sweep(db, query, true);
}

/// All jobs of a sweep have to find room at once.
void check_room(Database& db, std::size_t wanted, int limit) {
  if (limit <= 0) return;
  Statement query = db.prepare("SELECT count(*) FROM jobs WHERE state = 1");
  const std::int64_t waiting = query.step() ? query.integer(0) : 0;
  if (waiting + static_cast<std::int64_t>(wanted) > limit)
    fail(ErrorCode::resource_exhausted, "{} jobs are waiting and the sweep has {}, the limit is {}; submit again later", waiting,
         wanted, limit);
}

}  // namespace

CreatedSweep create_sweep(Database& db, const NewSweep& sweep, int limit, std::int64_t now) {
  if (auto known = find_by(db, "request_id", sweep.request_id)) return {std::move(*known), true};
  check_room(db, sweep.jobs.size(), limit);
  db.prepare("INSERT INTO sweeps (uid, request_id, title, digest, code_version, spec, created_ns) VALUES (?, ?, ?, ?, ?, ?, ?)")
      .bind(sweep.uid, sweep.request_id, sweep.title, sweep.digest, sweep.code_version, Statement::Blob{sweep.spec}, now)
      .run();
  const std::int64_t id = db.last_row_id();
  for (std::size_t i = 0; i < sweep.jobs.size(); ++i) {
    create(db, sweep.jobs[i], 0, now);
    const SweepPoint& p = sweep.points[i];
    db.prepare("INSERT INTO sweep_jobs (sweep, position, uid, case_name, period_s, height_m, heading_deg) VALUES (?, ?, ?, ?, ?, ?, ?)")
        .bind(id, static_cast<std::int64_t>(i), sweep.jobs[i].uid, p.case_name, p.period_s, p.height_m, p.heading_deg)
        .run();
  }
  return {*find_sweep(db, sweep.uid), false};
}

std::optional<Sweep> find_sweep(Database& db, const std::string& uid) { return find_by(db, "uid", uid); }

std::vector<Sweep> list_sweeps(Database& db, std::int64_t before_id, int limit) {
  std::vector<Sweep> out;
  Statement query = db.prepare("SELECT " + std::string(sweep_columns) + " FROM sweeps WHERE id < ? ORDER BY id DESC LIMIT ?");
  query.bind(before_id > 0 ? before_id : std::int64_t{1} << 62, limit);
  while (query.step()) out.push_back(read_sweep(db, query, false));
  return out;
}

void drop_empty_sweep(Database& db, const std::string& job_uid) {
  db.prepare("DELETE FROM sweeps WHERE id = (SELECT sweep FROM sweep_jobs WHERE uid = ?1) AND NOT EXISTS (SELECT 1 FROM "
             "sweep_jobs AS mine JOIN sweep_jobs AS one ON one.sweep = mine.sweep JOIN jobs ON jobs.uid = one.uid WHERE mine.uid = ?1)")
      .bind(job_uid)
      .run();
}

}  // namespace seaway::store::rows
