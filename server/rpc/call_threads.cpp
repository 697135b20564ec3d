// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/call_threads.hpp"

#include <grpc/support/cpu.h>
#include <grpcpp/alarm.h>

#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

#include "core/base/error.hpp"

namespace seaway::rpc {
namespace {

/// Holds whoever comes until all may go.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return open_; });
    ++passed_;
    wake_.notify_all();
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    wake_.notify_all();
  }
  bool all_pass(unsigned count, std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, patience, [&] { return passed_ == count; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool open_ = false;
  unsigned passed_ = 0;
};

}  // namespace

void start_call_threads(std::chrono::milliseconds patience) {
  // The callback of an alarm runs on the executor, which adds a thread when more than two wait for one of its threads. While
  // none gets through, three for each thread are enough, wherever they queue up.
  const unsigned wanted = 2 * std::max(1u, gpr_cpu_num_cores());
  const unsigned count = 3 * wanted;
  const auto gate = std::make_shared<Gate>();  // shared: an alarm that never comes keeps it
  // The first timer that goes off makes a second thread for timers.
  grpc::Alarm timed;
  timed.Set(std::chrono::system_clock::now() + std::chrono::milliseconds(1), [gate](bool) { gate->pass(); });
  std::vector<grpc::Alarm> alarms(count);
  for (grpc::Alarm& alarm : alarms) alarm.Set(gpr_inf_past(GPR_CLOCK_REALTIME), [gate](bool) { gate->pass(); });  // now, from here
  gate->open();
  if (!gate->all_pass(count + 1, patience)) fail(ErrorCode::unavailable, "the system has no {} threads more for the calls", wanted);
}

}  // namespace seaway::rpc
