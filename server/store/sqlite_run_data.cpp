// SPDX-License-Identifier: GPL-3.0-or-later
// What a run produces: rows in and out.
#include <algorithm>
#include <span>

#include "core/base/error.hpp"
#include "server/store/chunk.hpp"
#include "server/store/sqlite_rows.hpp"

namespace seaway::store::rows {
namespace {

struct Tail {
  std::int64_t id = 0, last = 0;
};

Tail tail_of(Database& db, const std::string& uid) {
  Statement query = db.prepare("SELECT id, last_sequence FROM jobs WHERE uid = ?");
  if (!query.bind(uid).step()) fail(ErrorCode::not_found, "job {} does not exist; list the jobs to find its name", uid);
  return {query.integer(0), query.integer(1)};
}

/// The chunks that hold samples after `after`, at most about `limit` samples of them.
std::vector<Sample> read_chunks(Database& db, std::int64_t id, std::int64_t after, int limit) {
  std::vector<Sample> out;
  // The chunk in which `after` + 1 stands is the last one that begins at or before it.
  Statement query = db.prepare(
      "SELECT data, crc FROM sample_chunks WHERE job = ?1 AND first_sequence >= coalesce((SELECT "
      "max(first_sequence) FROM sample_chunks WHERE job = ?1 AND first_sequence <= ?2), 0) "
      "ORDER BY first_sequence");
  query.bind(id, after + 1);
  while (static_cast<int>(out.size()) < limit && query.step()) {
    for (Sample& s : decode_chunk(query.blob(0), static_cast<std::uint32_t>(query.integer(1)))) {
      if (s.sequence <= after) continue;
      if (static_cast<int>(out.size()) >= limit) break;
      out.push_back(std::move(s));
    }
  }
  return out;
}

void write_chunk(Database& db, std::int64_t id, const std::vector<Sample>& samples) {
  const std::string bytes = encode_chunk(samples);
  db.prepare("INSERT OR REPLACE INTO sample_chunks (job, first_sequence, n, t_first, t_last, codec, crc, data) "
             "VALUES (?, ?, ?, ?, ?, 0, ?, ?)")
      .bind(id, samples.front().sequence, static_cast<std::int64_t>(samples.size()), samples.front().time,
            samples.back().time, static_cast<std::int64_t>(chunk_crc(bytes)), Statement::Blob{bytes})
      .run();
}

/// The open chunk at the end; empty if the last one is full or there is none.
std::vector<Sample> open_chunk(Database& db, std::int64_t id) {
  Statement query = db.prepare(
      "SELECT data, crc FROM sample_chunks WHERE job = ? ORDER BY first_sequence DESC LIMIT 1");
  if (!query.bind(id).step()) return {};
  std::vector<Sample> samples = decode_chunk(query.blob(0), static_cast<std::uint32_t>(query.integer(1)));
  return static_cast<int>(samples.size()) < chunk_samples ? samples : std::vector<Sample>{};
}

void compare_replay(Database& db, const std::string& uid, std::int64_t id, std::span<const Sample> replayed,
                    std::int64_t now) {
  const std::vector<Sample> stored =
      read_chunks(db, id, replayed.front().sequence - 1, static_cast<int>(replayed.size()));
  for (std::size_t i = 0; i < std::min(stored.size(), replayed.size()); ++i) {
    if (same_bits(stored[i], replayed[i])) continue;
    Statement known = db.prepare(
        "SELECT 1 FROM events e JOIN jobs j ON j.id = e.job WHERE e.job = ? AND e.attempt = j.attempt AND "
        "e.kind = 'REPLAY_MISMATCH' LIMIT 1");
    if (!known.bind(id).step())
      add_event(db, uid, "REPLAY_MISMATCH",
                fmt::format("sample {} came out differently; the stored one stays", replayed[i].sequence), now);
    return;
  }
}

}  // namespace

std::int64_t job_id(Database& db, const std::string& uid) { return tail_of(db, uid).id; }

void set_channels(Database& db, const std::string& uid, const std::vector<Channel>& list) {
  const std::int64_t id = job_id(db, uid);
  db.prepare("DELETE FROM channels WHERE job = ?").bind(id).run();
  for (std::size_t i = 0; i < list.size(); ++i)
    db.prepare("INSERT INTO channels (job, position, name, unit) VALUES (?, ?, ?, ?)")
        .bind(id, static_cast<std::int64_t>(i), list[i].name, list[i].unit)
        .run();
}

namespace {

/// One run of consecutive samples.
void add_run(Database& db, const std::string& uid, std::span<const Sample> run, std::int64_t now) {
  const Tail tail = tail_of(db, uid);
  const auto known = std::clamp<std::int64_t>(tail.last - run.front().sequence + 1, 0, static_cast<std::int64_t>(run.size()));
  if (known > 0) compare_replay(db, uid, tail.id, run.first(static_cast<std::size_t>(known)), now);
  run = run.subspan(static_cast<std::size_t>(known));
  if (run.empty()) return;
  if (run.front().sequence != tail.last + 1) {
    add_event(db, uid, "HISTORY_GAP",
              fmt::format("sample {} came after {}; it was not stored", run.front().sequence, tail.last), now);
    return;
  }
  std::vector<Sample> open = open_chunk(db, tail.id);
  for (const Sample& s : run) {
    open.push_back(s);
    if (static_cast<int>(open.size()) < chunk_samples) continue;
    write_chunk(db, tail.id, open);
    add_envelopes(db, uid, tail.id, open);
    open.clear();
  }
  if (!open.empty()) write_chunk(db, tail.id, open);
  db.prepare("UPDATE jobs SET last_sequence = ?, updated_ns = ? WHERE id = ?")
      .bind(run.back().sequence, now, tail.id)
      .run();
}

}  // namespace

void add_samples(Database& db, const std::string& uid, const std::vector<Sample>& samples, std::int64_t now) {
  // A run that was interrupted and goes on begins again at an earlier sample.
  for (std::size_t from = 0, to = 0; from < samples.size(); from = to) {
    for (to = from + 1; to < samples.size() && samples[to].sequence == samples[to - 1].sequence + 1;) ++to;
    add_run(db, uid, std::span(samples).subspan(from, to - from), now);
  }
}

void put_stage(Database& db, const std::string& uid, const StageRow& stage) {
  db.prepare("INSERT OR REPLACE INTO stages (job, stage, report) VALUES (?, ?, ?)")
      .bind(job_id(db, uid), stage.stage, Statement::Blob{stage.report})
      .run();
}

void add_checkpoint(Database& db, const std::string& uid, const Checkpoint& c, std::int64_t now) {
  const std::int64_t id = job_id(db, uid);
  db.prepare("INSERT OR REPLACE INTO checkpoints (job, path, sequence, size, mtime_ns, inode, created_ns) "
             "VALUES (?, ?, ?, ?, ?, ?, ?)")
      .bind(id, c.path, c.sequence, c.size, c.mtime_ns, static_cast<std::int64_t>(c.inode), now)
      .run();
  db.prepare("UPDATE jobs SET checkpoint_sequence = ?, updated_ns = ? WHERE id = ?").bind(c.sequence, now, id).run();
}

void add_artifact(Database& db, const std::string& uid, const Artifact& a, std::int64_t now) {
  db.prepare("INSERT OR REPLACE INTO artifacts (job, name, path, media_type, size, created_ns) "
             "VALUES (?, ?, ?, ?, ?, ?)")
      .bind(job_id(db, uid), a.name, a.path, a.media_type, a.size, now)
      .run();
}

void add_run_time(Database& db, const std::string& uid, std::int64_t ms) {
  db.prepare("UPDATE jobs SET run_ms = run_ms + ? WHERE uid = ?").bind(ms, uid).run();
}

void set_progress(Database& db, const std::string& uid, const Progress& p, std::int64_t now) {
  db.prepare("UPDATE jobs SET stage = ?, stage_count = ?, time_s = ?, fraction = ?, remaining_s = ?, held = ?, "
             "updated_ns = ? WHERE uid = ?")
      .bind(p.stage, p.stage_count, p.time, p.fraction, p.remaining_s, p.held ? 1 : 0, now, uid)
      .run();
}

void add_event(Database& db, const std::string& uid, const std::string& kind, const std::string& text,
               std::int64_t now) {
  db.prepare("INSERT INTO events (job, time_ns, attempt, kind, text) SELECT id, ?, attempt, ?, ? FROM jobs WHERE uid = ?")
      .bind(now, kind, text, uid)
      .run();
}

std::vector<Channel> channels(Database& db, const std::string& uid) {
  std::vector<Channel> out;
  Statement query = db.prepare("SELECT name, unit FROM channels WHERE job = ? ORDER BY position");
  query.bind(job_id(db, uid));
  while (query.step()) out.push_back({query.text(0), query.text(1)});
  return out;
}

std::vector<Sample> samples(Database& db, const std::string& uid, std::int64_t after, int limit) {
  return read_chunks(db, job_id(db, uid), after, limit);
}

std::vector<StageRow> stages(Database& db, const std::string& uid) {
  std::vector<StageRow> out;
  Statement query = db.prepare("SELECT stage, report FROM stages WHERE job = ? ORDER BY stage");
  query.bind(job_id(db, uid));
  while (query.step()) out.push_back({static_cast<int>(query.integer(0)), query.text(1)});
  return out;
}

std::vector<Checkpoint> checkpoints(Database& db, const std::string& uid) {
  std::vector<Checkpoint> out;
  Statement query =
      db.prepare("SELECT sequence, path, size, mtime_ns, inode FROM checkpoints WHERE job = ? ORDER BY sequence");
  query.bind(job_id(db, uid));
  while (query.step())
    out.push_back({query.integer(0), query.text(1), query.integer(2), query.integer(3),
                   static_cast<std::uint64_t>(query.integer(4))});
  return out;
}

std::vector<Artifact> artifacts(Database& db, const std::string& uid) {
  std::vector<Artifact> out;
  Statement query = db.prepare(
      "SELECT name, path, media_type, size, created_ns FROM artifacts WHERE job = ? ORDER BY created_ns, name");
  query.bind(job_id(db, uid));
  while (query.step())
    out.push_back({query.text(0), query.text(1), query.text(2), query.integer(3), query.integer(4)});
  return out;
}

std::vector<Event> events(Database& db, const std::string& uid) {
  std::vector<Event> out;
  Statement query = db.prepare(
      "SELECT revision, time_ns, attempt, kind, text FROM events WHERE job = ? ORDER BY revision LIMIT 10000");
  query.bind(job_id(db, uid));
  while (query.step())
    out.push_back({query.integer(0), query.integer(1), static_cast<int>(query.integer(2)), query.text(3), query.text(4)});
  return out;
}

}  // namespace seaway::store::rows
