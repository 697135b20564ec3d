// SPDX-License-Identifier: GPL-3.0-or-later
// A client that follows a job through every restart of the server and remembers what it was shown.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "client/job_client.hpp"

namespace seaway::stress {

class Witness {
 public:
  Witness(const std::string& address, std::string job);
  ~Witness();
  /// Until the job has ended; what was received, as CSV without header.
  const std::string& wait();
  std::int64_t last() const { return last_; }
  double fraction() const { return fraction_; }
  bool ended() const { return ended_; }
  int gaps() const { return gaps_; }

 private:
  void follow();
  const std::string job_;
  client::JobClient client_;
  std::string csv_;
  std::atomic<std::int64_t> last_{0};
  std::atomic<double> fraction_{0};
  std::atomic<bool> ended_{false}, leave_{false};
  std::atomic<int> gaps_{0};
  std::thread thread_;
};

}  // namespace seaway::stress
