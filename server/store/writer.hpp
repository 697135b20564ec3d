// SPDX-License-Identifier: GPL-3.0-or-later
// The one thread and the one connection that write. Changes that arrive close together share a
// transaction (group commit), so that many small writes cost one sync of the disk.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/store/database.hpp"

namespace seaway::store {

class Writer {
 public:
  /// Runs inside a transaction; inserts the uids of the jobs it touched.
  using Change = std::function<void(Database&, std::set<std::string>& touched)>;
  using Committed = std::function<void(const std::set<std::string>& touched)>;
  using Warn = std::function<void(const std::string&)>;

  struct Options {
    std::string path, vfs;
    std::chrono::milliseconds interval{250};  ///< longest time a change of post() waits
    bool own_thread = true;                   ///< otherwise call() writes what waits, in the caller's thread
    bool publish_too_early = false;           ///< see SqliteOptions
    std::function<void(double)> timed{};      ///< told how long each commit took [s]
    std::function<void()> sync_failed{};      ///< see SqliteOptions
  };
  /// `committed` is called after each commit.
  Writer(const Options& options, Committed committed, Warn warn);
  /// Commits what is waiting.
  ~Writer();

  /// Called once, after the commit: without an error, the change is durable.
  using Done = std::function<void(const std::exception_ptr& error)>;
  /// Returns when the change is durable; an exception of the change undoes it alone and comes out here.
  void call(Change change);
  /// As call() without waiting: `done` hears of the end, from the writer's thread. It must be quick and must not throw.
  void call_later(Change change, Done done);
  /// Queues the change. Changes happen in the order of post() and call(). If the disk refuses, it is tried
  /// again until it succeeds or the writer ends; a change that throws Error(internal) is dropped.
  void post(Change change);
  /// Returns when all that was posted before is durable.
  void flush();
  /// The last commit was refused.
  bool is_stuck() const { return stuck_; }

 private:
  struct Task {
    Change change;
    Done done;  ///< none for posted ones
  };
  void loop();
  bool commit(std::deque<Task>& batch);
  void checkpoint(bool truncate);
  void give_up(const std::string& why);
  void publish(std::deque<Task>& batch, const std::set<std::string>& touched, const std::vector<std::exception_ptr>& failures);

  Database db_;
  const std::chrono::milliseconds interval_;
  const bool own_thread_, publish_too_early_;
  const Committed committed_;
  const Warn warn_;
  const std::function<void(double)> timed_;
  const std::function<void()> sync_failed_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Task> tasks_;     // guarded by mutex_
  bool hurry_ = false;         // guarded by mutex_: someone waits
  bool stopping_ = false;      // guarded by mutex_
  std::chrono::steady_clock::time_point oldest_;  // guarded by mutex_: when the first task was queued
  std::atomic<bool> stuck_{false};
  std::atomic<bool> broken_{false};  ///< a sync has failed: nothing is written any more
  std::thread thread_;         // last: uses all of the above
};

}  // namespace seaway::store
