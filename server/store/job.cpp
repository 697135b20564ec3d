// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/store/job.hpp"

#include <cstring>

namespace seaway::store {

std::string_view to_string(State state) {
  switch (state) {
    case State::queued: return "QUEUED";
    case State::held: return "HELD";
    case State::running: return "RUNNING";
    case State::cancelling: return "CANCELLING";
    case State::succeeded: return "SUCCEEDED";
    case State::failed: return "FAILED";
    case State::cancelled: return "CANCELLED";
  }
  return "UNKNOWN";
}

std::string_view to_string(Reason reason) {
  switch (reason) {
    case Reason::none: return "";
    case Reason::diverged: return "DIVERGED";
    case Reason::nan: return "NAN";
    case Reason::time_limit: return "TIME_LIMIT";
    case Reason::memory: return "MEMORY";
    case Reason::worker_crash: return "WORKER_CRASH";
    case Reason::checkpoint_lost: return "CHECKPOINT_LOST";
    case Reason::invalid_input: return "INVALID_INPUT";
    case Reason::disk_full: return "DISK_FULL";
    case Reason::user: return "USER";
    case Reason::server_drain: return "SERVER_DRAIN";
    case Reason::executor_lost: return "EXECUTOR_LOST";
    case Reason::server_restart: return "SERVER_RESTART";
    case Reason::internal: return "INTERNAL";
    case Reason::stalled: return "STALLED";
  }
  return "UNKNOWN";
}

bool may_move(State from, State to) {
  switch (from) {
    case State::queued: return to == State::running || to == State::cancelled || to == State::held;
    case State::held: return to == State::queued || to == State::cancelled;
    case State::running:
      return to == State::queued || to == State::cancelling || to == State::succeeded || to == State::failed;
    case State::cancelling:
      return to == State::cancelled || to == State::succeeded || to == State::failed;
    case State::succeeded:
    case State::failed:
    case State::cancelled: return false;
  }
  return false;
}

bool same_bits(const Sample& a, const Sample& b) {
  const auto equal = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  if (a.sequence != b.sequence || a.stage != b.stage || a.step != b.step || !equal(a.time, b.time) ||
      a.values.size() != b.values.size())
    return false;
  return a.values.empty() ||
         std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(double)) == 0;
}

}  // namespace seaway::store
