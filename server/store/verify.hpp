// SPDX-License-Identifier: GPL-3.0-or-later
// What can be said about a database without changing it, and a copy of it while it is in use.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/store/job.hpp"

namespace seaway::store {

struct Verification {
  std::int64_t jobs = 0, samples = 0;
  std::vector<std::string> problems;  ///< none: all is well; each names table and job
};

/// Reads everything: pages and indexes, references, check sums of all chunks, histories without gaps. Throws
/// Error(unavailable) if there is no such file, data_loss if it is no database.
Verification verify_database(const std::string& path, const std::string& vfs = "");

/// The audit trail of a database, newest first, at most `limit` rows; only what was denied if so. Throws as verify_database.
std::vector<AuditRow> read_audit(const std::string& path, int limit, bool only_denied);

/// Copies the database, as it is at one moment, to a new file; a running server is not disturbed. Throws
/// Error: failed_precondition if `to` exists, unavailable if it cannot be written.
void backup_database(const std::string& from, const std::string& to);

}  // namespace seaway::store
