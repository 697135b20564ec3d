// SPDX-License-Identifier: GPL-3.0-or-later
// JobStore in one SQLite file (WAL, full sync), with one writer and a few readers. A lock file keeps a
// second server out of the same data. The schema is brought up to date when the file is opened; a file of a
// newer version is refused.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "server/store/job_store.hpp"

namespace seaway::store {

struct SqliteOptions {
  std::string path;                                  ///< the folder must exist
  std::chrono::milliseconds commit_interval{250};    ///< longest wait of a sample for its commit
  int readers = 4;                                   ///< connections for reading
  std::function<std::int64_t()> now_ns;              ///< empty: the system's clock
  std::function<void(const std::string&)> warn;      ///< something a person should know
  std::function<void(double seconds)> committed;     ///< told how long each transaction took
  /// Told that a sync has failed, after which nothing is written any more: end the process. Empty: all calls fail.
  std::function<void()> sync_failed;
  /// For simulations: another disk under SQLite (empty: the system's), and no thread of its own. Then what was
  /// handed over becomes durable with the next call that waits; the lock file is left out.
  std::string vfs;
  bool own_thread = true;
  /// Breaks the promise of the store on purpose: acknowledges and publishes before the commit. For the test of
  /// the tests alone.
  bool publish_too_early = false;
};

/// Throws Error: failed_precondition if another process has the data open, data_loss if the file is damaged,
/// unavailable if it cannot be opened.
std::unique_ptr<JobStore> open_sqlite_store(SqliteOptions options);

}  // namespace seaway::store
