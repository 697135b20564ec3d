// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/seats.hpp"

#include "core/base/error.hpp"

namespace seaway::rpc {

std::shared_ptr<const void> Seats::take(const std::string& caller) {
  {
    const std::lock_guard lock(mutex_);
    if (taken_ >= in_all_)
      fail(ErrorCode::resource_exhausted, "{} streams are open, which is the limit (limits.streams); try again later", in_all_);
    int& held = holds_[caller];
    if (held >= per_caller_)
      fail(ErrorCode::resource_exhausted,
           "{} holds {} open streams, which is the limit for one caller (limits.streams_per_caller); end some, or follow all "
           "jobs with one WatchJobs", caller, held);
    ++held;
    ++taken_;
  }
  return {this, [this, caller](const void*) {
            const std::lock_guard lock(mutex_);
            --taken_;
            const auto holder = holds_.find(caller);
            if (--holder->second == 0) holds_.erase(holder);
          }};
}

}  // namespace seaway::rpc
