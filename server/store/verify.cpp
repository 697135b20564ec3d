// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/store/verify.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>

#include "core/base/error.hpp"
#include "server/store/chunk.hpp"
#include "server/store/database.hpp"
#include "server/store/migrations.hpp"
#include "server/store/sqlite_rows.hpp"

namespace seaway::store {
namespace {

void check_file(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) fail(ErrorCode::unavailable, "{}: there is no such file", path);
}

void check_pages(Database& db, Verification& out) {
  {
    Statement query = db.prepare("PRAGMA integrity_check(20)");
    while (query.step())
      if (const std::string text = query.text(0); text != "ok") out.problems.push_back("integrity: " + text);
  }
  Statement query = db.prepare("PRAGMA foreign_key_check");
  while (query.step())
    out.problems.push_back(query.text(0) + ": row " + std::to_string(query.integer(1)) + " refers to nothing in " + query.text(2));
}

/// Every chunk can be read, and together they are the history that the job says it has.
void check_histories(Database& db, Verification& out) {
  Statement jobs = db.prepare("SELECT id, uid, last_sequence, checkpoint_sequence FROM jobs ORDER BY id");
  while (jobs.step()) {
    ++out.jobs;
    const std::string uid = jobs.text(1);
    const auto problem = [&](const std::string& text) { out.problems.push_back("sample_chunks: job " + uid + ": " + text); };
    std::int64_t next = 1;
    Statement chunks = db.prepare("SELECT first_sequence, n, crc, data FROM sample_chunks WHERE job = ? ORDER BY first_sequence");
    chunks.bind(jobs.integer(0));
    while (chunks.step()) {
      if (chunks.integer(0) != next)
        problem(fmt::format("samples from {} on are missing", next));
      try {
        const auto samples = decode_chunk(chunks.blob(3), static_cast<std::uint32_t>(chunks.integer(2)));
        if (static_cast<std::int64_t>(samples.size()) != chunks.integer(1) || samples.empty() ||
            samples.front().sequence != chunks.integer(0))
          problem(fmt::format("the chunk at {} holds other samples", chunks.integer(0)));
      } catch (const Error& error) {
        problem(error.what());
      }
      next = chunks.integer(0) + chunks.integer(1);
      out.samples += chunks.integer(1);
    }
    if (next != jobs.integer(2) + 1) problem(fmt::format("it ends at {}, the job says {}", next - 1, jobs.integer(2)));
    if (jobs.integer(3) > jobs.integer(2))
      problem(fmt::format("the checkpoint after {} is ahead of the history", jobs.integer(3)));
  }
}

/// Every job has its case, and each case is counted as often as it is had.
void check_cases(Database& db, Verification& out) {
  Statement query = db.prepare(
      "SELECT min(uid), count(*), EXISTS (SELECT 1 FROM case_specs WHERE digest = jobs.digest), "
      "coalesce((SELECT jobs FROM case_uses WHERE digest = jobs.digest), 0) FROM jobs GROUP BY digest");
  while (query.step()) {
    if (query.integer(2) == 0) out.problems.push_back("case_specs: the case of job " + query.text(0) + " is missing");
    if (query.integer(1) != query.integer(3))
      out.problems.push_back(fmt::format("case_uses: the case of job {} is counted {} times instead of {}", query.text(0),
                                         query.integer(3), query.integer(1)));
  }
}

}  // namespace

Verification verify_database(const std::string& path, const std::string& vfs) {
  if (vfs.empty()) check_file(path);
  Database db(path, Database::Role::reader, vfs);
  Verification out;
  db.execute("BEGIN");  // one moment of it, whatever a server does
  check_pages(db, out);
  if (out.problems.empty()) check_histories(db, out);
  if (out.problems.empty() && version_of(db) >= 5) check_cases(db, out);  // before that each job had a case of its own
  db.execute("COMMIT");
  return out;
}

std::vector<AuditRow> read_audit(const std::string& path, int limit, bool only_denied) {
  check_file(path);
  Database db(path, Database::Role::reader);
  return rows::audit(db, limit, only_denied);
}

void backup_database(const std::string& from, const std::string& to) {
  check_file(from);
  struct stat info {};
  if (::stat(to.c_str(), &info) == 0) fail(ErrorCode::failed_precondition, "{} exists; choose another name", to);
  const std::string aside = to + ".part";
  ::unlink(aside.c_str());
  {
    Database db(from, Database::Role::reader);
    db.copy_to(aside);
  }
  if (std::rename(aside.c_str(), to.c_str()) != 0) fail(ErrorCode::unavailable, "{} cannot be written", to);
}

}  // namespace seaway::store
