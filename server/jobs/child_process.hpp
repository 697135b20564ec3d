// SPDX-License-Identifier: GPL-3.0-or-later
// A worker as a child process: started, asked to stop, killed, and always waited for. One thread at a time;
// the thread that makes the object must outlive it (the child dies with that thread).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/error.hpp"

namespace seaway::jobs {

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept;
  int get() const { return fd_; }
  void close();

 private:
  int fd_;
};

/// The program of the workers cannot be started: it is not there, or not any more.
class NotStarted : public Error {
 public:
  explicit NotStarted(const std::string& message) : Error(ErrorCode::unavailable, message) {}
};

class ChildProcess {
 public:
  /// Starts `program attempt` with the order on descriptor 0, the lease on 4, records on 3, and the end of
  /// stderr kept here. Throws NotStarted, or Error(unavailable) if there is no descriptor or memory for it.
  ChildProcess(const std::string& program, const std::string& order, const Descriptor& lease);
  /// Kills it if it runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;

  int records() const { return records_.get(); }  ///< not blocking; ends with the child
  int errors() const { return errors_.get(); }    ///< not blocking
  void signal(int number) const;
  /// What waitpid says, once it has ended.
  std::optional<int> status();
  /// Private memory [bytes]; 0 if it has ended.
  std::int64_t memory() const;

 private:
  Descriptor records_, errors_;
  pid_t pid_ = 0;
  std::optional<int> status_;
};

/// Takes the lease of a job, killing a worker of an earlier server that still holds it. Throws
/// Error(unavailable) if it does not end within ten seconds.
Descriptor take_lease(const std::string& path);

}  // namespace seaway::jobs
