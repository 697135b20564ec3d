// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace seaway::server {

/// A thread that is made early and waits for the word: so that what it does later cannot fail for want of a thread.
class StandbyThread {
 public:
  explicit StandbyThread(std::function<void(const std::stop_token&)> run)
      : thread_([this, run = std::move(run)](const std::stop_token& stop) {
          if (is_told(stop)) run(stop);
        }) {}
  /// Runs it, once.
  void go() {
    {
      const std::lock_guard lock(mutex_);
      told_ = true;
    }
    wake_.notify_all();
  }
  /// Waits for its end; only after go().
  void join() { thread_.join(); }

 private:
  bool is_told(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    return wake_.wait(lock, stop, [this] { return told_; });
  }

  std::mutex mutex_;
  std::condition_variable_any wake_;
  bool told_ = false;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace seaway::server
