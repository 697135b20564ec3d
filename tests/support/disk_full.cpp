// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded into the programs under test (LD_PRELOAD): a disk that is full from the N-th write on, until it is not, or whose
// syncs fail; and a system that makes no more threads and processes.
// Counts writes to files below SEAWAY_DISK_FULL_FOLDER over all processes, in the file that
// SEAWAY_DISK_FULL_CONTROL names (see disk_full.hpp).
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cstdio>

#include "tests/support/disk_full.hpp"

namespace {

using seaway::testing::DiskFullControl;

DiskFullControl* control() {
  static DiskFullControl* const shared = [] {
    const char* file = getenv("SEAWAY_DISK_FULL_CONTROL");
    const int fd = file != nullptr ? open(file, O_RDWR | O_CLOEXEC) : -1;
    if (fd < 0) return static_cast<DiskFullControl*>(nullptr);
    void* memory = mmap(nullptr, sizeof(DiskFullControl), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    close(fd);
    return memory == MAP_FAILED ? nullptr : static_cast<DiskFullControl*>(memory);
  }();
  return shared;
}

/// What to do with a file; null: leave it alone.
DiskFullControl* control_of(int fd) {
  static const char* const folder = getenv("SEAWAY_DISK_FULL_FOLDER");
  DiskFullControl* shared = folder != nullptr ? control() : nullptr;
  if (shared == nullptr) return nullptr;
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t n = readlink(link, path, sizeof path - 1);
  if (n <= 0) return nullptr;
  path[n] = 0;
  return strncmp(path, folder, strlen(folder)) == 0 ? shared : nullptr;
}

/// Counts the write; true if it must fail.
bool is_refused(int fd) {
  DiskFullControl* shared = control_of(fd);
  if (shared == nullptr) return false;
  const auto number = shared->writes.fetch_add(1) + 1;
  const auto from = shared->full_from.load();
  if (from < 0 || number < from) return false;
  shared->refused.fetch_add(1);
  errno = ENOSPC;
  return true;
}

bool sync_fails(int fd) {
  const DiskFullControl* shared = control_of(fd);
  if (shared == nullptr || shared->syncs_fail.load() == 0) return false;
  errno = EIO;
  return true;
}

bool thread_is_refused() {
  DiskFullControl* shared = control();
  if (shared == nullptr || shared->threads_fail.load() == 0) return false;
  shared->threads_refused.fetch_add(1);
  return true;
}

template <class F>
F next(F, const char* name) {
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {
ssize_t write(int fd, const void* data, size_t size) {
  static const auto real = next(&write, "write");
  return is_refused(fd) ? -1 : real(fd, data, size);
}
ssize_t pwrite(int fd, const void* data, size_t size, off_t at) {
  static const auto real = next(&pwrite, "pwrite");
  return is_refused(fd) ? -1 : real(fd, data, size, at);
}
ssize_t pwrite64(int fd, const void* data, size_t size, off64_t at) {
  static const auto real = next(&pwrite64, "pwrite64");
  return is_refused(fd) ? -1 : real(fd, data, size, at);
}
int fsync(int fd) {
  static const auto real = next(&fsync, "fsync");
  return sync_fails(fd) ? -1 : real(fd);
}
int fdatasync(int fd) {
  static const auto real = next(&fdatasync, "fdatasync");
  return sync_fails(fd) ? -1 : real(fd);
}
ssize_t writev(int fd, const iovec* parts, int count) {
  static const auto real = next(&writev, "writev");
  return is_refused(fd) ? -1 : real(fd, parts, count);
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* argument) {
  static const auto real = next(&pthread_create, "pthread_create");
  return thread_is_refused() ? EAGAIN : real(thread, attributes, run, argument);
}
int posix_spawn(pid_t* pid, const char* path, const posix_spawn_file_actions_t* files, const posix_spawnattr_t* attributes,
                char* const arguments[], char* const environment[]) {
  static const auto real = next(&posix_spawn, "posix_spawn");
  return thread_is_refused() ? EAGAIN : real(pid, path, files, attributes, arguments, environment);
}
}
