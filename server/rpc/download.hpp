// SPDX-License-Identifier: GPL-3.0-or-later
// Artifacts.DownloadArtifact: the bytes of one file from an offset on.
#pragma once

#include "seaway/v1/job_service.pb.h"
#include "server/rpc/stream_call.hpp"
#include "server/store/job_store.hpp"

namespace seaway::rpc {

class DownloadCall final : public StreamCall<v1::DownloadArtifactResponse> {
 public:
  DownloadCall(grpc::CallbackServerContext* context, Registry& registry, WorkQueue& queue, StreamLimits limits,
               const store::JobStore& store, v1::DownloadArtifactRequest request)
      : StreamCall(context, registry, queue, limits), store_(store), request_(std::move(request)) {}
  ~DownloadCall() override;
  const char* kind() const override { return "download"; }

 private:
  Next next(v1::DownloadArtifactResponse& response, bool idle) override;
  void open();

  const store::JobStore& store_;
  const v1::DownloadArtifactRequest request_;
  int fd_ = -1;  // the rest is touched by next() only
  std::int64_t size_ = 0, at_ = 0;
  bool first_ = true;
};

}  // namespace seaway::rpc
