// SPDX-License-Identifier: GPL-3.0-or-later
// One request, one answer, worked out in the work queue.
#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/server_callback.h>

#include <chrono>
#include <memory>

#include "server/rpc/registry.hpp"
#include "server/rpc/status.hpp"
#include "server/rpc/work_queue.hpp"

namespace seaway::rpc {

class UnaryCall final : public grpc::ServerUnaryReactor, public LiveCall {
 public:
  explicit UnaryCall(Registry& registry) : registry_(registry) {}
  void OnDone() override {
    const auto self = std::move(self_);  // lives until the end of this function
    registry_.remove(this);
  }
  // The work always ends soon and finishes the call itself.
  void close() override {}
  void abort() override {}
  bool start(const std::shared_ptr<UnaryCall>& self) {
    self_ = self;
    return registry_.add(this, self);
  }

 private:
  Registry& registry_;
  std::shared_ptr<UnaryCall> self_;
};

/// `work` fills the response; what it throws becomes the status. The context lives until Finish.
template <class Work>
grpc::ServerUnaryReactor* run_unary(grpc::CallbackServerContext* context, Registry& registry, WorkQueue& queue,
                                    Work work) {
  auto call = std::make_shared<UnaryCall>(registry);
  UnaryCall* reactor = call.get();
  if (!call->start(call)) {
    reactor->Finish(make_status(grpc::StatusCode::UNAVAILABLE, "SERVER_DRAIN", "the server is stopping; try again"));
    return reactor;
  }
  const auto deadline = context->deadline();
  const bool queued = queue.try_post([call, deadline, work = std::move(work)]() mutable {
    grpc::Status status;
    if (deadline < std::chrono::system_clock::now()) {
      status = make_status(grpc::StatusCode::DEADLINE_EXCEEDED, "DEADLINE", "the server was too busy");
    } else {
      try {
        work();
      } catch (...) {
        status = to_status(std::current_exception());
      }
    }
    call->Finish(status);
  });
  if (!queued)
    reactor->Finish(make_status(grpc::StatusCode::RESOURCE_EXHAUSTED, "TOO_MANY_REQUESTS", "too many requests wait; try again"));
  return reactor;
}

}  // namespace seaway::rpc
