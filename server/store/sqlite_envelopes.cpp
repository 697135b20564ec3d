// SPDX-License-Identifier: GPL-3.0-or-later
// Envelopes of histories: rows in and out. A row of level 1 or 2 holds the runs of one chunk of samples, a row of
// a higher level one run. What is missing (the open end, histories from before there were envelopes) is made from
// the level below, at the lowest from the samples.
#include <algorithm>

#include "core/base/error.hpp"
#include "server/store/chunk.hpp"
#include "server/store/envelope.hpp"
#include "server/store/sqlite_rows.hpp"

namespace seaway::store::rows {
namespace {

constexpr std::int64_t row_span(int level) { return std::max<std::int64_t>(chunk_samples, envelope_run(level)); }

void write_row(Database& db, std::int64_t job, int level, const std::vector<EnvelopePoint>& points) {
  const std::string bytes = encode_points(points);
  db.prepare("INSERT OR REPLACE INTO envelopes (job, level, first_sequence, crc, data) VALUES (?, ?, ?, ?, ?)")
      .bind(job, level, points.front().first, static_cast<std::int64_t>(chunk_crc(bytes)), Statement::Blob{bytes})
      .run();
}

/// Points of one row; empty if it is not there.
std::vector<EnvelopePoint> read_row(Database& db, std::int64_t job, int level, std::int64_t first) {
  Statement query = db.prepare("SELECT data, crc FROM envelopes WHERE job = ? AND level = ? AND first_sequence = ?");
  if (!query.bind(job, level, first).step()) return {};
  return decode_points(query.blob(0), static_cast<std::uint32_t>(query.integer(1)));
}

/// Puts a point to the run of `level` that it belongs to.
void collect(std::vector<EnvelopePoint>& out, int level, const EnvelopePoint& p) {
  const std::int64_t run = envelope_run(level);
  if (!out.empty() && (out.back().first - 1) / run == (p.first - 1) / run)
    join(out.back(), p);
  else
    out.push_back(p);
}

/// Runs of `level` over the samples `first` .. `last`; those at the ends may be cut.
std::vector<EnvelopePoint> cover(Database& db, const std::string& uid, std::int64_t job, int level, std::int64_t first,
                                 std::int64_t last) {
  std::vector<EnvelopePoint> out;
  if (level == 0) {
    for (std::int64_t at = first; at <= last;) {
      const auto part = samples(db, uid, at - 1, static_cast<int>(std::min<std::int64_t>(8192, last - at + 1)));
      if (part.empty()) fail(ErrorCode::data_loss, "job {}: sample {} is missing", uid, at);
      for (const Sample& s : part) out.push_back(point_of(s));
      at = part.back().sequence + 1;
    }
    return out;
  }
  const std::int64_t span = row_span(level);
  for (std::int64_t at = first; at <= last;) {
    const std::int64_t row = (at - 1) / span * span + 1, row_end = std::min(last, row + span - 1);
    const bool whole = at == row && row_end == row + span - 1;
    auto points = whole ? read_row(db, job, level, row) : std::vector<EnvelopePoint>{};
    if (points.empty()) points = cover(db, uid, job, level - 1, at, row_end);
    for (const EnvelopePoint& p : points) collect(out, level, p);
    at = row_end + 1;
  }
  return out;
}

}  // namespace

void add_envelopes(Database& db, const std::string& uid, std::int64_t job, const std::vector<Sample>& chunk) {
  std::vector<EnvelopePoint> fine, coarse;
  for (const Sample& s : chunk) collect(fine, 1, point_of(s));
  for (const EnvelopePoint& p : fine) collect(coarse, 2, p);
  write_row(db, job, 1, fine);
  write_row(db, job, 2, coarse);
  const std::int64_t last = chunk.back().sequence;
  for (int level = 3; level <= envelope_levels && last % envelope_run(level) == 0; ++level)
    write_row(db, job, level, cover(db, uid, job, level, last - envelope_run(level) + 1, last));
}

std::vector<EnvelopePoint> envelope(Database& db, const std::string& uid, std::int64_t after, std::int64_t until,
                                    int max_points) {
  std::int64_t job = 0, latest = 0;
  {
    Statement query = db.prepare("SELECT id, last_sequence FROM jobs WHERE uid = ?");
    if (!query.bind(uid).step()) fail(ErrorCode::not_found, "job {} does not exist; list the jobs to find its name", uid);
    job = query.integer(0);
    latest = query.integer(1);
  }
  const std::int64_t last = until > 0 ? std::min(until, latest) : latest;
  if (after >= last) return {};
  const std::int64_t per_point = (last - after + max_points - 1) / max_points;
  int level = 0;
  while (level < envelope_levels && envelope_run(level + 1) <= per_point) ++level;
  const auto runs = cover(db, uid, job, level, after + 1, last);
  const auto group = (static_cast<std::int64_t>(runs.size()) + max_points - 1) / max_points;
  std::vector<EnvelopePoint> out;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i % static_cast<std::size_t>(group) == 0)
      out.push_back(runs[i]);
    else
      join(out.back(), runs[i]);
  }
  return out;
}

}  // namespace seaway::store::rows
