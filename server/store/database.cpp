// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/store/database.hpp"

#include <sqlite3.h>

#include <cstdio>

#include "core/base/error.hpp"

namespace seaway::store {
namespace {

[[noreturn]] void raise(sqlite3* db, int code, std::string_view what) {
  const std::string text = db != nullptr ? sqlite3_errmsg(db) : sqlite3_errstr(code);
  if (code == SQLITE_IOERR_FSYNC || code == SQLITE_IOERR_DIR_FSYNC)
    throw SyncFailed(fmt::format("database: the disk lost data that it had taken: {} ({})", text, what));
  switch (code & 0xff) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_BUSY:
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY: fail(ErrorCode::unavailable, "database: {} ({})", text, what);
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB: fail(ErrorCode::data_loss, "database: {} ({})", text, what);
    default: fail(ErrorCode::internal, "database: {} ({})", text, what);
  }
}

}  // namespace

Database::Database(const std::string& path, Role role, const std::string& vfs) {
  // Every connection is used by one thread at a time, so SQLite's own mutexes are not needed.
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX | (role == Role::writer ? SQLITE_OPEN_CREATE : 0);
  if (const int code = sqlite3_open_v2(path.c_str(), &db_, flags, vfs.empty() ? nullptr : vfs.c_str()); code != SQLITE_OK) {
    const std::string text = db_ != nullptr ? sqlite3_errmsg(db_) : "out of memory";
    sqlite3_close(db_);
    fail(ErrorCode::unavailable, "database {}: {}", path, text);
  }
  try {
    sqlite3_extended_result_codes(db_, 1);
    sqlite3_db_config(db_, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0, nullptr);
    sqlite3_db_config(db_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_busy_timeout(db_, 5000);
    execute("PRAGMA cell_size_check=1");
    if (role == Role::writer) {
      execute("PRAGMA journal_mode=WAL");
      execute("PRAGMA synchronous=FULL");
      execute("PRAGMA foreign_keys=ON");
    } else {
      execute("PRAGMA query_only=1");
      execute("PRAGMA cache_size=-256");  // histories are read once, in order
    }
    // Only the writer may checkpoint: before SQLite 3.51.3 two connections that write or checkpoint at the
    // same moment can corrupt the log.
    execute("PRAGMA wal_autocheckpoint=0");
    if (role == Role::writer) sqlite3_wal_hook(db_, &Database::on_commit, this);
  } catch (...) {
    sqlite3_close_v2(db_);
    throw;
  }
}

Database::~Database() {
  for (auto& [sql, statement] : statements_) sqlite3_finalize(statement);
  sqlite3_close_v2(db_);
}

int Database::on_commit(void* self, sqlite3*, const char*, int pages) {
  static_cast<Database*>(self)->wal_pages_ = pages;
  return SQLITE_OK;
}

void Database::execute(const std::string& sql) {
  if (const int code = sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr); code != SQLITE_OK)
    raise(db_, code, sql.substr(0, 80));
}

Statement Database::prepare(std::string_view sql) {
  auto [entry, added] = statements_.try_emplace(std::string(sql), nullptr);
  if (entry->second == nullptr) {
    const int code = sqlite3_prepare_v3(db_, sql.data(), static_cast<int>(sql.size()), SQLITE_PREPARE_PERSISTENT,
                                        &entry->second, nullptr);
    if (code != SQLITE_OK) {
      statements_.erase(entry);
      raise(db_, code, sql);
    }
  }
  return {db_, entry->second};
}

Statement Database::prepare_once(std::string_view sql) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(db_, sql.data(), static_cast<int>(sql.size()), 0, &statement, nullptr);
  if (code != SQLITE_OK) raise(db_, code, sql);
  return {db_, statement, true};
}

std::int64_t Database::changes() const { return sqlite3_changes64(db_); }
std::int64_t Database::last_row_id() const { return sqlite3_last_insert_rowid(db_); }

void Database::copy_to(const std::string& path) {
  sqlite3* copy = nullptr;
  std::remove(path.c_str());  // what an interrupted copy has left
  int code = sqlite3_open_v2(path.c_str(), &copy, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  if (code == SQLITE_OK) {
    sqlite3_backup* backup = sqlite3_backup_init(copy, "main", db_, "main");
    if (backup != nullptr) sqlite3_backup_step(backup, -1);  // all at once: one read transaction, and readers do not block
    code = backup != nullptr ? sqlite3_backup_finish(backup) : sqlite3_errcode(copy);
  }
  const std::string text = sqlite3_errmsg(copy);
  sqlite3_close_v2(copy);
  if (code != SQLITE_OK) fail(ErrorCode::unavailable, "{} cannot be written: {}", path, text);
}

void Database::checkpoint(bool truncate) {
  const int code = sqlite3_wal_checkpoint_v2(db_, nullptr, truncate ? SQLITE_CHECKPOINT_TRUNCATE : SQLITE_CHECKPOINT_PASSIVE,
                                             nullptr, nullptr);
  if (code == SQLITE_IOERR_FSYNC) raise(db_, code, "checkpoint");  // any other trouble: the log stays, the next one moves it
}

Statement::~Statement() {
  if (statement_ == nullptr) return;
  if (once_) {
    sqlite3_finalize(statement_);
    return;
  }
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

bool Statement::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  raise(db_, code, sqlite3_sql(statement_));
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_, column); }
double Statement::real(int column) const { return sqlite3_column_double(statement_, column); }
std::string Statement::text(int column) const { return std::string(blob(column)); }
std::string_view Statement::blob(int column) const {
  const void* data = sqlite3_column_blob(statement_, column);
  const int size = sqlite3_column_bytes(statement_, column);
  return data == nullptr ? std::string_view{}
                         : std::string_view(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

void Statement::bind_one(int index, std::int64_t value) {
  if (const int code = sqlite3_bind_int64(statement_, index, value); code != SQLITE_OK) raise(db_, code, "bind");
}
void Statement::bind_one(int index, double value) {
  if (const int code = sqlite3_bind_double(statement_, index, value); code != SQLITE_OK) raise(db_, code, "bind");
}
void Statement::bind_one(int index, const std::string& value) {
  const int code = sqlite3_bind_text(statement_, index, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
  if (code != SQLITE_OK) raise(db_, code, "bind");
}
void Statement::bind_one(int index, Blob value) {
  const int code = sqlite3_bind_blob64(statement_, index, value.bytes.empty() ? "" : value.bytes.data(),
                                       value.bytes.size(), SQLITE_TRANSIENT);
  if (code != SQLITE_OK) raise(db_, code, "bind");
}

}  // namespace seaway::store
