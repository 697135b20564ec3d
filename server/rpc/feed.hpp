// SPDX-License-Identifier: GPL-3.0-or-later
// What the watchers of a job need, read from the store once for all of them: its state, and the chunks of
// samples that several ask for at the same time. Woken by the store's commits.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "seaway/v1/job_service.pb.h"
#include "server/store/job_store.hpp"

namespace seaway::rpc {

struct Snapshot {
  store::Job job;  ///< without spec
  std::vector<store::Channel> channels;
};

/// Told after each commit that concerns its job. Must be quick.
class Watcher {
 public:
  virtual ~Watcher() = default;
  virtual void on_news() = 0;
};

class Feed {
 public:
  Feed(std::string uid, const store::JobStore& store) : uid_(std::move(uid)), store_(store) {}
  /// At least as new as the last on_news(). Throws not_found.
  std::shared_ptr<const Snapshot> snapshot();
  /// The samples after `after` as a message of bounded size; null if there are none.
  std::shared_ptr<const v1::SampleChunk> chunk(std::int64_t after, const Snapshot& now);

 private:
  friend class Feeds;
  const std::string uid_;
  const store::JobStore& store_;
  std::atomic<std::uint64_t> commits_{1};
  std::mutex mutex_;
  std::uint64_t read_at_ = 0;                       // guarded by mutex_
  std::shared_ptr<const Snapshot> snapshot_;        // guarded by mutex_
  std::deque<std::shared_ptr<const v1::SampleChunk>> recent_;  // guarded by mutex_
  std::map<Watcher*, std::weak_ptr<Watcher>> watchers_;        // guarded by Feeds::mutex_
};

class Feeds {
 public:
  explicit Feeds(store::JobStore& store);
  ~Feeds();
  std::shared_ptr<Feed> join(const std::string& uid, Watcher* key, const std::shared_ptr<Watcher>& watcher);
  void leave(const std::string& uid, Watcher* key);
  /// Told of every commit.
  void join_all(Watcher* key, const std::shared_ptr<Watcher>& watcher);
  void leave_all(Watcher* key);

 private:
  void on_commit(const std::set<std::string>& uids);
  store::JobStore& store_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Feed>> feeds_;  // guarded by mutex_
  std::map<Watcher*, std::weak_ptr<Watcher>> all_;      // guarded by mutex_
  std::function<void()> unsubscribe_;
};

}  // namespace seaway::rpc
