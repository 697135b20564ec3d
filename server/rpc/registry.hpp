// SPDX-License-Identifier: GPL-3.0-or-later
// The calls that are alive. gRPC 1.51 hangs in Server::Shutdown while a reactor is unfinished
// (grpc/grpc#39114), so the server finishes all of them itself first.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace seaway::rpc {

/// A call that can be ended from outside. Both may come at any time, repeatedly.
class LiveCall {
 public:
  virtual ~LiveCall() = default;
  /// Finish soon with UNAVAILABLE.
  virtual void close() = 0;
  /// The peer does not read: cut the call.
  virtual void abort() = 0;
  /// What it is counted as.
  virtual const char* kind() const { return "call"; }
  /// Stored samples that its reader has not received yet.
  virtual std::int64_t lag() { return 0; }
  /// About once a second.
  virtual void tick(std::chrono::steady_clock::time_point) {}
};

struct Census {
  std::map<std::string, int> kinds;
  std::int64_t largest_lag = 0;
};

class Registry {
 public:
  /// False while closing: the call must finish at once by itself, and then still be removed.
  bool add(LiveCall* key, const std::shared_ptr<LiveCall>& call);
  void remove(LiveCall* key);
  void tick_all(std::chrono::steady_clock::time_point now);
  /// Closes all calls, aborts those that are left after `grace`, returns when none is left or after twice
  /// that time; true if none is left.
  bool close_all(std::chrono::milliseconds grace);
  std::size_t size() const;
  Census census() const;

 private:
  std::vector<std::shared_ptr<LiveCall>> all() const;
  mutable std::mutex mutex_;
  std::condition_variable empty_;
  std::map<LiveCall*, std::weak_ptr<LiveCall>> calls_;  // guarded by mutex_
  bool closing_ = false;                                // guarded by mutex_
};

}  // namespace seaway::rpc
