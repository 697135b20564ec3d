// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/feed.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "server/rpc/messages.hpp"

namespace seaway::rpc {
namespace {

// A reader that stops costs the server one message: keep it small.
constexpr std::size_t message_bytes = 2 * 1024;
constexpr std::size_t recent_chunks = 16;

}  // namespace

std::shared_ptr<const Snapshot> Feed::snapshot() {
  const std::lock_guard lock(mutex_);
  const std::uint64_t commits = commits_.load();
  if (snapshot_ != nullptr && read_at_ == commits) return snapshot_;
  auto job = store_.find(uid_);
  if (!job) fail(ErrorCode::not_found, "job {} does not exist; list the jobs to find its name", uid_);
  auto fresh = std::make_shared<Snapshot>();
  job->spec.clear();
  fresh->job = std::move(*job);
  const bool same_attempt = snapshot_ != nullptr && snapshot_->job.attempt == fresh->job.attempt;
  fresh->channels = same_attempt && !snapshot_->channels.empty() ? snapshot_->channels : store_.channels(uid_);
  snapshot_ = std::move(fresh);
  read_at_ = commits;
  return snapshot_;
}

std::shared_ptr<const v1::SampleChunk> Feed::chunk(std::int64_t after, const Snapshot& now) {
  if (after >= now.job.last_sequence) return nullptr;
  const std::lock_guard lock(mutex_);
  for (const auto& known : recent_)
    if (known->first_sequence() == after + 1) return known;
  const int rows = static_cast<int>(std::max<std::size_t>(8, message_bytes / (8 * (now.channels.size() + 2))));
  const auto samples = store_.samples(uid_, after, rows);
  if (samples.empty() || samples.front().sequence != after + 1)
    fail(ErrorCode::data_loss, "job {}: sample {} is missing", uid_, after + 1);
  auto made = std::make_shared<const v1::SampleChunk>(to_proto(samples, now.channels));
  recent_.push_back(made);
  if (recent_.size() > recent_chunks) recent_.pop_front();
  return made;
}

Feeds::Feeds(store::JobStore& store)
    : store_(store), unsubscribe_(store.subscribe([this](const auto& uids) { on_commit(uids); })) {}

Feeds::~Feeds() { unsubscribe_(); }

std::shared_ptr<Feed> Feeds::join(const std::string& uid, Watcher* key, const std::shared_ptr<Watcher>& watcher) {
  const std::lock_guard lock(mutex_);
  auto& feed = feeds_[uid];
  if (feed == nullptr) feed = std::make_shared<Feed>(uid, store_);
  feed->watchers_.emplace(key, watcher);
  return feed;
}

void Feeds::leave(const std::string& uid, Watcher* key) {
  const std::lock_guard lock(mutex_);
  const auto feed = feeds_.find(uid);
  if (feed == feeds_.end()) return;
  feed->second->watchers_.erase(key);
  if (feed->second->watchers_.empty()) feeds_.erase(feed);
}

void Feeds::join_all(Watcher* key, const std::shared_ptr<Watcher>& watcher) {
  const std::lock_guard lock(mutex_);
  all_.emplace(key, watcher);
}

void Feeds::leave_all(Watcher* key) {
  const std::lock_guard lock(mutex_);
  all_.erase(key);
}

void Feeds::on_commit(const std::set<std::string>& uids) {
  std::vector<std::shared_ptr<Watcher>> told;
  {
    const std::lock_guard lock(mutex_);
    for (const std::string& uid : uids) {
      const auto feed = feeds_.find(uid);
      if (feed == feeds_.end()) continue;
      feed->second->commits_.fetch_add(1);
      for (const auto& [key, weak] : feed->second->watchers_)
        if (auto watcher = weak.lock()) told.push_back(std::move(watcher));
    }
    for (const auto& [key, weak] : all_)
      if (auto watcher = weak.lock()) told.push_back(std::move(watcher));
  }
  for (const auto& watcher : told) watcher->on_news();
}

}  // namespace seaway::rpc
