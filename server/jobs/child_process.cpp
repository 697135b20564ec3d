// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>

#include "core/base/error.hpp"
#include "server/jobs/worker.hpp"

extern char** environ;

namespace seaway::jobs {
namespace {

/// Beyond the numbers that the child gets, so that handing them over overwrites none of them.
Descriptor high(int fd) {
  Descriptor low(fd);
  const int moved = fd < 0 ? -1 : ::fcntl(fd, F_DUPFD_CLOEXEC, 10);
  if (moved < 0) fail(ErrorCode::unavailable, "no descriptor for a worker: {}", std::strerror(errno));
  return Descriptor(moved);
}

/// A file in memory, so that neither side has to wait for the other.
Descriptor order_file(const std::string& bytes) {
  Descriptor file = high(::memfd_create("seaway-order", MFD_CLOEXEC));
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::write(file.get(), bytes.data() + at, bytes.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(ErrorCode::unavailable, "no memory for a worker: {}", std::strerror(errno));
    at += static_cast<std::size_t>(n);
  }
  ::lseek(file.get(), 0, SEEK_SET);
  return file;
}

struct SpawnSetup {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  SpawnSetup() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    sigset_t blocked, all;
    sigemptyset(&blocked);
    sigfillset(&all);
    sigaddset(&blocked, SIGTERM);  // a request to stop waits until the worker can hear it
    posix_spawnattr_setsigmask(&attributes, &blocked);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setpgroup(&attributes, 0);  // what a terminal sends to the server is not for it
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSetup() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
};

}  // namespace

Descriptor::~Descriptor() { close(); }
Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}
void Descriptor::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

ChildProcess::ChildProcess(const std::string& program, const std::string& order, const Descriptor& lease) {
  const Descriptor input = order_file(order);
  std::array<int, 2> records{}, errors{};
  if (::pipe2(records.data(), O_CLOEXEC) != 0) fail(ErrorCode::unavailable, "no pipe for a worker: {}", std::strerror(errno));
  records_ = high(records[0]);
  const Descriptor records_in = high(records[1]);
  if (::pipe2(errors.data(), O_CLOEXEC) != 0) fail(ErrorCode::unavailable, "no pipe for a worker: {}", std::strerror(errno));
  errors_ = high(errors[0]);
  const Descriptor errors_in = high(errors[1]);
  for (const Descriptor* end : {&records_, &errors_}) ::fcntl(end->get(), F_SETFL, O_NONBLOCK);
  SpawnSetup setup;
  posix_spawn_file_actions_adddup2(&setup.files, input.get(), Worker::order_fd);
  posix_spawn_file_actions_adddup2(&setup.files, errors_in.get(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&setup.files, errors_in.get(), STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&setup.files, records_in.get(), Worker::record_fd);
  posix_spawn_file_actions_adddup2(&setup.files, lease.get(), Worker::lease_fd);
  posix_spawn_file_actions_addclosefrom_np(&setup.files, Worker::lease_fd + 1);
  std::string name = program, command = "attempt";
  char* arguments[] = {name.data(), command.data(), nullptr};
  if (const int why = ::posix_spawn(&pid_, program.c_str(), &setup.files, &setup.attributes, arguments, environ); why != 0) {
    pid_ = 0;
    throw NotStarted(fmt::format("{} cannot be started: {}", program, std::strerror(why)));
  }
}

ChildProcess::~ChildProcess() {
  if (pid_ <= 0 || status_) return;
  ::kill(pid_, SIGKILL);
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
}

void ChildProcess::signal(int number) const {
  if (pid_ > 0 && !status_) ::kill(pid_, number);
}

std::optional<int> ChildProcess::status() {
  int status = 0;
  if (!status_ && ::waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
  return status_;
}

std::int64_t ChildProcess::memory() const {
  std::ifstream in("/proc/" + std::to_string(pid_) + "/statm");
  std::int64_t total = 0, resident = 0, shared = 0;
  in >> total >> resident >> shared;
  return (resident - shared) * ::sysconf(_SC_PAGESIZE);
}

Descriptor take_lease(const std::string& path) {
  Descriptor lease = high(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (::flock(lease.get(), LOCK_EX | LOCK_NB) != 0) {
    // Who holds the lock has written its number, or is about to.
    char text[32] = {};
    const ssize_t n = ::pread(lease.get(), text, sizeof text - 1, 0);
    if (const long pid = n > 0 ? std::atol(text) : 0; pid > 1) ::kill(static_cast<pid_t>(pid), SIGKILL);
    if (std::chrono::steady_clock::now() > deadline)
      fail(ErrorCode::unavailable, "{} is held by a worker of an earlier server that does not end", path);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (::ftruncate(lease.get(), 0) != 0) fail(ErrorCode::unavailable, "{}: {}", path, std::strerror(errno));
  return lease;
}

}  // namespace seaway::jobs
