// SPDX-License-Identifier: GPL-3.0-or-later
// The shared memory between a test and the programs whose disk it fills.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace seaway::testing {

struct DiskFullControl {
  std::atomic<std::int64_t> writes;     ///< so far, refused ones included
  std::atomic<std::int64_t> full_from;  ///< number of the first write that fails; < 0: none
  std::atomic<std::int64_t> refused;
  std::atomic<std::int64_t> syncs_fail;  ///< not 0: fsync and fdatasync of those files fail
  std::atomic<std::int64_t> threads_fail;     ///< not 0: no thread and no process can be made
  std::atomic<std::int64_t> threads_refused;  ///< so far
};

/// Made by the test before the programs start, in a file that SEAWAY_DISK_FULL_CONTROL names to them.
class SharedDiskControl {
 public:
  explicit SharedDiskControl(const std::string& file) {
    const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    void* memory = fd >= 0 && ::ftruncate(fd, sizeof(DiskFullControl)) == 0
                       ? ::mmap(nullptr, sizeof(DiskFullControl), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0)
                       : MAP_FAILED;
    if (fd >= 0) ::close(fd);
    if (memory == MAP_FAILED) throw std::runtime_error("no shared memory for the disk");
    control_ = static_cast<DiskFullControl*>(memory);
    control_->full_from = -1;
  }
  ~SharedDiskControl() { ::munmap(control_, sizeof(DiskFullControl)); }
  SharedDiskControl(const SharedDiskControl&) = delete;
  SharedDiskControl& operator=(const SharedDiskControl&) = delete;
  DiskFullControl* operator->() const { return control_; }

 private:
  DiskFullControl* control_;
};

}  // namespace seaway::testing
