// SPDX-License-Identifier: GPL-3.0-or-later
// A disk in memory under SQLite (a VFS), with what real disks do: it fills up, fails, and forgets at a power failure
// what was not synced. Deterministic. One thread.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace seaway::testing {

class SimDisk {
 public:
  /// Registers itself with SQLite under its name.
  SimDisk(std::string name, std::uint64_t seed);
  ~SimDisk();
  SimDisk(const SimDisk&) = delete;
  const std::string& name() const { return name_; }

  /// From the n-th operation that changes something on, counted from now, nothing works any more.
  void fail_after(int operations) { left_ = operations; }
  bool is_dead() const { return left_ == 0; }
  void set_full(bool full) { full_ = full; }
  /// After a crash, with every connection closed. `power`: of the machine; otherwise of the process, and all that
  /// was written stays.
  void crash(bool power);

  struct Write {
    std::int64_t at;
    std::string bytes;  ///< empty with truncate
    bool truncate = false;
  };
  struct File {
    std::string now, synced;
    std::vector<Write> unsynced;
    int holders = 0;  ///< connections with a lock, of whatever kind
  };
  struct Shared {
    std::vector<std::unique_ptr<char[]>> regions;
  };
  // For the VFS.
  bool may_change();                      ///< counts an operation
  bool full() const { return full_; }
  std::map<std::string, std::shared_ptr<File>> files;
  std::map<std::string, std::shared_ptr<Shared>> shared;
  std::mt19937_64 random;

 private:
  std::string name_;
  void* vfs_ = nullptr;
  int left_ = -1;
  bool full_ = false;
};

}  // namespace seaway::testing
