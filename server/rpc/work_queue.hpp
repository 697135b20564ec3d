// SPDX-License-Identifier: GPL-3.0-or-later
// A few threads for what a gRPC reaction must not do itself: wait for the disk.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace seaway::rpc {

class WorkQueue {
 public:
  WorkQueue(int threads, std::size_t limit);
  /// Runs what is queued, then ends.
  ~WorkQueue();
  /// For requests: false if `limit` tasks wait already.
  bool try_post(std::function<void()> task);
  /// For calls that were admitted before; at most one task of each is queued, so no limit is needed.
  void post(std::function<void()> task);

 private:
  void loop();
  const std::size_t limit_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;  // guarded by mutex_
  bool stopping_ = false;                    // guarded by mutex_
  std::vector<std::thread> threads_;
};

}  // namespace seaway::rpc
