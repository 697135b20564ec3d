// SPDX-License-Identifier: GPL-3.0-or-later
// Telemetry.WatchSamples: header, samples in order, progress marks, a last mark when the job has ended.
#pragma once

#include <atomic>
#include <string>

#include "server/rpc/feed.hpp"
#include "server/rpc/stream_call.hpp"

namespace seaway::rpc {

class WatchCall final : public StreamCall<v1::WatchSamplesResponse>, public Watcher {
 public:
  WatchCall(grpc::CallbackServerContext* context, Registry& registry, WorkQueue& queue, StreamLimits limits,
            Feeds& feeds, v1::WatchSamplesRequest request)
      : StreamCall(context, registry, queue, limits), feeds_(feeds), request_(std::move(request)) {}
  void on_news() override { schedule(); }
  const char* kind() const override { return "samples"; }
  std::int64_t lag() override;

 private:
  Next next(v1::WatchSamplesResponse& response, bool idle) override;
  void on_done() override;
  void join();
  void check_cursor(const Snapshot& now);

  Feeds& feeds_;
  const v1::WatchSamplesRequest request_;
  std::atomic<std::int64_t> cursor_{0};
  std::string uid_;             // the rest is touched by next() only
  std::shared_ptr<Feed> feed_;  // but constant after joined_
  std::atomic<bool> joined_{false};
  int header_attempt_ = -1;
  std::size_t header_channels_ = 0;
  std::string last_mark_;
};

}  // namespace seaway::rpc
