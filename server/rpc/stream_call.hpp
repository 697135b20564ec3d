// SPDX-License-Identifier: GPL-3.0-or-later
// A server stream that pulls: the next message is made when the one before has left, in the work queue, so a
// slow reader costs one message and never a thread.
#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/server_callback.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "server/rpc/registry.hpp"
#include "server/rpc/status.hpp"
#include "server/rpc/work_queue.hpp"

namespace seaway::rpc {

struct StreamLimits {
  std::chrono::seconds stalled{60};  ///< a message that has not left for so long cuts the call
  std::chrono::seconds age{3600};    ///< after that the client has to call again
  std::chrono::seconds idle{10};     ///< without a message: on_idle()
};

template <class Response>
class StreamCall : public grpc::ServerWriteReactor<Response>,
                   public LiveCall,
                   public std::enable_shared_from_this<StreamCall<Response>> {
 public:
  StreamCall(grpc::CallbackServerContext* context, Registry& registry, WorkQueue& queue, StreamLimits limits)
      : context_(context), registry_(registry), queue_(queue), limits_(limits) {}

  /// Call once, right after construction.
  void start() {
    self_ = this->shared_from_this();
    if (!registry_.add(this, self_)) close();
    schedule();
  }

  /// Before start(): the place that the call holds until its end; or why it only says that it is refused.
  void admit(std::shared_ptr<const void> seat) { seat_ = std::move(seat); }
  void refuse(grpc::Status status) { ending_ = std::move(status); }

  void close() override {
    end_with(make_status(grpc::StatusCode::UNAVAILABLE, "SERVER_DRAIN", "the server is stopping; call again and resume"));
  }
  void abort() override {
    const std::lock_guard lock(mutex_);
    if (!finished_) context_->TryCancel();
  }
  void tick(std::chrono::steady_clock::time_point now) override {
    bool news = false;
    {
      const std::lock_guard lock(mutex_);
      if (finished_) return;
      if (writing_ && now - changed_ > limits_.stalled) context_->TryCancel();
      if (!writing_ && now - changed_ > limits_.idle) idle_ = news = true;
    }
    if (now - born_ > limits_.age)
      end_with(make_status(grpc::StatusCode::UNAVAILABLE, "STREAM_AGE", "the stream has reached its age; call again and resume"));
    else if (news)
      schedule();
  }
  void OnWriteDone(bool ok) override {
    {
      const std::lock_guard lock(mutex_);
      writing_ = false;
      changed_ = Clock::now();
      if (!ok) broken_ = true;
    }
    schedule();
  }
  void OnCancel() override {
    {
      const std::lock_guard lock(mutex_);
      broken_ = true;
    }
    schedule();
  }
  void OnDone() override {
    const auto self = std::move(self_);  // lives until the end of this function
    on_done();
    registry_.remove(this);
  }

 protected:
  using Clock = std::chrono::steady_clock;
  enum class Next { message, nothing, end };
  /// Fills `response` (empty when called). `idle`: nothing was sent for a while. Never called twice at the
  /// same time. What it throws ends the stream.
  virtual Next next(Response& response, bool idle) = 0;
  virtual void on_done() {}

  /// There may be something to send.
  void schedule() {
    {
      const std::lock_guard lock(mutex_);
      news_ = true;
      if (scheduled_ || writing_ || finished_) return;
      scheduled_ = true;
    }
    queue_.post([call = this->shared_from_this()] { call->pump(); });
  }
  void end_with(grpc::Status status) {
    {
      const std::lock_guard lock(mutex_);
      if (!ending_) ending_ = std::move(status);
    }
    schedule();
  }

 private:
  void pump() {
    for (;;) {
      bool idle = false;
      {
        std::unique_lock lock(mutex_);
        news_ = false;
        idle = std::exchange(idle_, false);
        if (broken_ || ending_) {
          const grpc::Status status = broken_ ? grpc::Status(grpc::StatusCode::CANCELLED, "the client left") : *ending_;
          finish(lock, status);
          return;
        }
      }
      response_.Clear();
      Next what = Next::nothing;
      grpc::Status failure;
      try {
        what = next(response_, idle);
      } catch (...) {
        failure = to_status(std::current_exception());
      }
      std::unique_lock lock(mutex_);
      if (!failure.ok() || what == Next::end) {
        finish(lock, failure);
        return;
      }
      if (what == Next::message) {
        writing_ = true;
        scheduled_ = false;
        changed_ = Clock::now();
        lock.unlock();
        this->StartWrite(&response_);
        return;
      }
      if (news_) continue;
      scheduled_ = false;
      return;
    }
  }
  void finish(std::unique_lock<std::mutex>& lock, const grpc::Status& status) {
    finished_ = true;  // scheduled_ stays set: no pump runs again
    lock.unlock();
    this->Finish(status);
  }

  grpc::CallbackServerContext* const context_;
  Registry& registry_;
  WorkQueue& queue_;
  const StreamLimits limits_;
  const Clock::time_point born_ = Clock::now();
  std::shared_ptr<StreamCall> self_;
  std::shared_ptr<const void> seat_;
  Response response_;  // touched by pump() only, and by gRPC while writing_
  std::mutex mutex_;
  bool scheduled_ = false, writing_ = false, finished_ = false;  // guarded by mutex_
  bool news_ = false, broken_ = false, idle_ = false;            // guarded by mutex_
  std::optional<grpc::Status> ending_;                           // guarded by mutex_
  Clock::time_point changed_ = Clock::now();                     // guarded by mutex_
};

}  // namespace seaway::rpc
