// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fault/witness.hpp"

#include "proto/history_csv.hpp"

namespace seaway::stress {

Witness::Witness(const std::string& address, std::string job)
    : job_(std::move(job)), client_(address), thread_([this] { follow(); }) {}

Witness::~Witness() {
  leave_ = true;
  if (thread_.joinable()) thread_.join();
}

const std::string& Witness::wait() {
  if (thread_.joinable()) thread_.join();
  return csv_;
}

void Witness::follow() {
  while (!ended_ && !leave_) {
    const auto status = client_.watch(job_, last_, [&](const v1::WatchSamplesResponse& m) {
      if (m.has_mark()) {
        fraction_ = m.mark().progress().fraction();
        if (m.mark().state() >= v1::Job::STATE_SUCCEEDED) ended_ = true;
      }
      if (!m.has_chunk()) return !leave_;
      if (m.chunk().first_sequence() != last_ + 1) ++gaps_;
      last_ = m.chunk().first_sequence() + m.chunk().times_s_size() - 1;
      history_csv::append(m.chunk(), csv_);
      return !leave_;
    });
    if (status.error_code() == grpc::StatusCode::NOT_FOUND) return;  // lost: the caller will see it
    if (!ended_) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace seaway::stress
