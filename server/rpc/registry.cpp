// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/registry.hpp"

#include <algorithm>

namespace seaway::rpc {

bool Registry::add(LiveCall* key, const std::shared_ptr<LiveCall>& call) {
  const std::lock_guard lock(mutex_);
  calls_.emplace(key, call);
  return !closing_;
}

void Registry::remove(LiveCall* key) {
  const std::lock_guard lock(mutex_);
  calls_.erase(key);
  if (calls_.empty()) empty_.notify_all();
}

std::size_t Registry::size() const {
  const std::lock_guard lock(mutex_);
  return calls_.size();
}

Census Registry::census() const {
  Census out;
  for (const auto& call : all()) {
    ++out.kinds[call->kind()];
    out.largest_lag = std::max(out.largest_lag, call->lag());
  }
  return out;
}

std::vector<std::shared_ptr<LiveCall>> Registry::all() const {
  std::vector<std::shared_ptr<LiveCall>> out;
  const std::lock_guard lock(mutex_);
  for (const auto& [key, call] : calls_)
    if (auto alive = call.lock()) out.push_back(std::move(alive));
  return out;
}

void Registry::tick_all(std::chrono::steady_clock::time_point now) {
  for (const auto& call : all()) call->tick(now);
}

bool Registry::close_all(std::chrono::milliseconds grace) {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  for (const auto& call : all()) call->close();
  {
    std::unique_lock lock(mutex_);
    if (empty_.wait_for(lock, grace, [&] { return calls_.empty(); })) return true;
  }
  for (const auto& call : all()) call->abort();
  std::unique_lock lock(mutex_);
  return empty_.wait_for(lock, grace, [&] { return calls_.empty(); });
}

}  // namespace seaway::rpc
