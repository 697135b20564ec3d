// SPDX-License-Identifier: GPL-3.0-or-later
// Programs as child processes, for tests that stop and kill them.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace seaway::testing {

/// A running child; killed when the object goes.
class Process {
 public:
  /// Output of the child goes to `output`, or to nowhere. `environment`: NAME=value, added to ours.
  Process(std::vector<std::string> command, const std::string& output = "", std::vector<std::string> environment = {});
  ~Process();
  Process(Process&& other) noexcept : pid_(other.pid_) { other.pid_ = 0; }
  Process& operator=(Process&& other) noexcept;

  pid_t pid() const { return pid_; }
  void signal(int number) const;
  /// Its exit code, or 128 + the signal that ended it.
  int wait();
  /// -1 if it has not ended after `limit`.
  int wait_for(std::chrono::milliseconds limit);
  /// Resident memory now [bytes].
  std::size_t resident_bytes() const;

 private:
  pid_t pid_ = 0;
};

struct Finished {
  int code = 0;
  std::string output;  ///< standard output and error
};
Finished run_program(std::vector<std::string> command, std::vector<std::string> environment = {});

/// seawayd on a free port with its data in a folder.
class Daemon {
 public:
  /// `arguments`: beside those for data, port and address file.
  Daemon(std::string program, std::string folder, std::vector<std::string> environment = {},
         std::vector<std::string> arguments = {});
  /// Starts it and waits until it listens. The port stays the same over restarts.
  void start();
  void kill();         ///< SIGKILL
  int terminate();     ///< SIGTERM; its exit code
  const std::string& address() const { return address_; }
  const Process& process() const { return process_.front(); }

 private:
  const std::string program_, folder_;
  const std::vector<std::string> environment_, arguments_;
  std::string address_;
  std::vector<Process> process_;  // none or one
};

std::string read_text(const std::string& path);

}  // namespace seaway::testing
