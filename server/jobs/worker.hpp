// SPDX-License-Identifier: GPL-3.0-or-later
// The child's side of the process executor: `seaway-run attempt`, started by seawayd with its order on
// descriptor 0, its records on 3 and the lease of the job on 4. Not for people.
#pragma once

#include <memory>

#include "server/jobs/solver.hpp"

namespace seaway::jobs {

class Worker {
 public:
  static bool is_asked_for(int argc, char** argv);
  /// Reads the order and puts the process under it: its limits, and its end with that of the server. Call it
  /// before anything that takes memory or makes threads. Ends the process if there is no order.
  Worker();
  ~Worker();
  /// The attempt; the exit code of the process.
  int run(const Solver& solver);

  static constexpr int order_fd = 0, record_fd = 3, lease_fd = 4;
  /// Exit codes of a worker that got no memory, could not write its lease, or is of another version than the server.
  static constexpr int exit_no_memory = 77, exit_no_disk = 78, exit_other_version = 79;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace seaway::jobs
