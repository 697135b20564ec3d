// SPDX-License-Identifier: GPL-3.0-or-later
// SQLite, thinly: a connection and a prepared statement that clean up after themselves. Errors become
// Error: full disk and I/O unavailable, corruption data_loss, the rest internal. One thread at a time each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

#include "core/base/error.hpp"

namespace seaway::store {

class Statement;

/// The disk took data and could then not make it durable: what it holds is not known any more, and asking it again would be
/// answered with yes (https://lwn.net/Articles/752063). Only a new start tells, from what can be read.
class SyncFailed : public Error {
 public:
  explicit SyncFailed(const std::string& message) : Error(ErrorCode::unavailable, message) {}
};

class Database {
 public:
  enum class Role { writer, reader };
  /// `vfs`: how SQLite reaches its files; empty: as the system does.
  Database(const std::string& path, Role role, const std::string& vfs = "");
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql);
  /// Prepared once per text and kept; reset and ready to bind.
  Statement prepare(std::string_view sql);
  /// For texts of which there are many: prepared anew each time and not kept.
  Statement prepare_once(std::string_view sql);
  /// Statements that are kept.
  std::size_t kept() const { return statements_.size(); }
  std::int64_t changes() const;
  std::int64_t last_row_id() const;
  /// A copy of the database, as it is now, in a new file that is durable when this returns.
  void copy_to(const std::string& path);
  /// Writer only: moves the log into the file, as far as readers allow; all of it if `truncate`.
  void checkpoint(bool truncate);
  /// Pages in the log after the last commit of this connection.
  int wal_pages() const { return wal_pages_; }

 private:
  static int on_commit(void* self, sqlite3* db, const char* name, int pages);
  sqlite3* db_ = nullptr;
  int wal_pages_ = 0;
  std::unordered_map<std::string, sqlite3_stmt*> statements_;
};

/// A statement in use. Parameters are bound in order; columns are read in order of the query.
class Statement {
 public:
  /// `once`: it ends with this object.
  Statement(sqlite3* db, sqlite3_stmt* statement, bool once = false) : db_(db), statement_(statement), once_(once) {}
  ~Statement();
  Statement(Statement&& other) noexcept : db_(other.db_), statement_(other.statement_), once_(other.once_) { other.statement_ = nullptr; }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  template <class... Args>
  Statement& bind(const Args&... args) {
    int index = 0;
    (bind_one(++index, args), ...);
    return *this;
  }
  /// True while there is a row.
  bool step();
  void run() {
    while (step()) {
    }
  }
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  std::string_view blob(int column) const;  ///< valid until the next step

  void bind_one(int index, std::int64_t value);
  void bind_one(int index, int value) { bind_one(index, static_cast<std::int64_t>(value)); }
  void bind_one(int index, double value);
  void bind_one(int index, const std::string& value);
  struct Blob {
    std::string_view bytes;
  };
  void bind_one(int index, Blob value);

 private:
  sqlite3* db_;
  sqlite3_stmt* statement_;
  bool once_;
};

}  // namespace seaway::store
