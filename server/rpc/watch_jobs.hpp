// SPDX-License-Identifier: GPL-3.0-or-later
// Telemetry.WatchJobs: every change of any job, in order of its revision, without gaps.
#pragma once

#include <deque>

#include "server/rpc/feed.hpp"
#include "server/rpc/stream_call.hpp"

namespace seaway::rpc {

class WatchJobsCall final : public StreamCall<v1::WatchJobsResponse>, public Watcher {
 public:
  WatchJobsCall(grpc::CallbackServerContext* context, Registry& registry, WorkQueue& queue, StreamLimits limits,
                Feeds& feeds, store::JobStore& store, v1::WatchJobsRequest request)
      : StreamCall(context, registry, queue, limits), feeds_(feeds), store_(store), request_(std::move(request)) {}
  void on_news() override { schedule(); }
  const char* kind() const override { return "jobs"; }

 private:
  Next next(v1::WatchJobsResponse& response, bool idle) override;
  void on_done() override;
  void join(v1::WatchJobsResponse& response);

  Feeds& feeds_;
  store::JobStore& store_;
  const v1::WatchJobsRequest request_;
  bool joined_ = false;  // the rest is touched by next() only
  std::int64_t cursor_ = 0;
  std::deque<store::Change> ready_;
};

}  // namespace seaway::rpc
