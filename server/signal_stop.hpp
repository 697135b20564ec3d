// SPDX-License-Identifier: GPL-3.0-or-later
// Stops a foreground run on SIGTERM and SIGINT, which must be blocked in all threads (block_stop_signals).
#pragma once

#include <signal.h>
#include <unistd.h>

#include <ctime>
#include <stop_token>
#include <thread>

namespace seaway::server {

/// Turns SIGTERM and SIGINT into a stop request. One more SIGINT ends the process.
class SignalStop {
 public:
  SignalStop() : thread_([this](std::stop_token end) { wait(end); }) {}
  std::stop_token token() const { return stop_.get_token(); }
  bool stopped() const { return stop_.stop_requested(); }

 private:
  void wait(const std::stop_token& end) {
    sigset_t set;
    sigemptyset(&set);
    for (const int s : {SIGTERM, SIGINT}) sigaddset(&set, s);
    const timespec tick{0, 200'000'000};
    while (!end.stop_requested()) {
      if (sigtimedwait(&set, nullptr, &tick) < 0) continue;
      if (stop_.stop_requested()) ::_exit(130);
      stop_.request_stop();
    }
  }
  std::stop_source stop_;
  std::jthread thread_;
};

}  // namespace seaway::server
