// SPDX-License-Identifier: GPL-3.0-or-later
// One request, one answer, worked out in the work queue or later, when something is durable.
#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/server_callback.h>

#include <chrono>
#include <functional>
#include <memory>

#include "server/rpc/registry.hpp"
#include "server/rpc/status.hpp"
#include "server/rpc/work_queue.hpp"

namespace seaway::rpc {

/// A call whose answer is owed. gRPC's own reactor serves it: the end of that costs no further thread.
class UnaryCall final : public LiveCall {
 public:
  UnaryCall(grpc::CallbackServerContext* context, Registry& registry) : reactor_(context->DefaultReactor()), registry_(registry) {}
  grpc::ServerUnaryReactor* reactor() const { return reactor_; }
  /// Once, from any thread; the context is gone afterwards.
  void finish(const grpc::Status& status) {
    reactor_->Finish(status);
    registry_.remove(this);
  }
  // The work always ends soon and finishes the call itself.
  void close() override {}
  void abort() override {}

 private:
  grpc::ServerUnaryReactor* const reactor_;
  Registry& registry_;
};

/// Ends a call: with what was thrown, or well. Once, from any thread.
using Finish = std::function<void(const std::exception_ptr& error)>;

/// `work` fills the response and calls the Finish that it is given, at once or later; what it throws before that becomes the
/// status. The context lives until then.
template <class Work>
grpc::ServerUnaryReactor* run_unary(grpc::CallbackServerContext* context, Registry& registry, WorkQueue& queue,
                                    Work work) {
  auto call = std::make_shared<UnaryCall>(context, registry);
  grpc::ServerUnaryReactor* reactor = call->reactor();
  if (!registry.add(call.get(), call)) {
    call->finish(make_status(grpc::StatusCode::UNAVAILABLE, "SERVER_DRAIN", "the server is stopping; try again"));
    return reactor;
  }
  const auto deadline = context->deadline();
  const bool queued = queue.try_post([call, deadline, work = std::move(work)]() mutable {
    if (deadline < std::chrono::system_clock::now()) {
      call->finish(make_status(grpc::StatusCode::DEADLINE_EXCEEDED, "DEADLINE", "the server was too busy"));
      return;
    }
    try {
      work([call](const std::exception_ptr& error) { call->finish(error ? to_status(error) : grpc::Status::OK); });
    } catch (...) {
      call->finish(to_status(std::current_exception()));
    }
  });
  if (!queued)
    call->finish(make_status(grpc::StatusCode::RESOURCE_EXHAUSTED, "TOO_MANY_REQUESTS", "too many requests wait; try again"));
  return reactor;
}

}  // namespace seaway::rpc
