// SPDX-License-Identifier: GPL-3.0-or-later
// Which CPUs a job keeps to. The server divides its own among the jobs that may run at the same time.
#pragma once

#include <mutex>
#include <string>
#include <vector>

namespace seaway::jobs {

/// A CPU as the kernel numbers it, and the core that it is a hardware thread of.
struct Cpu {
  int number = 0;
  std::string core;  ///< the same text for the hardware threads of a core
  bool operator==(const Cpu&) const = default;
};

/// The CPUs that this process may use, by number; none if the system does not say.
std::vector<Cpu> available_cpus();

/// Sets of `threads` CPUs for `jobs` jobs. No CPU is in two sets unless there are too few, and then each in about as many.
/// Where there is a core for each thread, a set has one CPU of each of its cores, and no core is in two sets; where there is
/// not, the CPUs of a core stay together.
class CoreSlots {
 public:
  CoreSlots(std::vector<Cpu> cpus, int jobs, int threads);

  /// The CPUs of one job, until the object goes. Empty: all of them, there is nothing to choose.
  class Slot {
   public:
    Slot(CoreSlots& slots, std::size_t index) : slots_(slots), index_(index) {}
    ~Slot() { slots_.give_back(index_); }
    Slot(const Slot&) = delete;
    const std::vector<int>& cpus() const { return slots_.sets_[index_]; }

   private:
    CoreSlots& slots_;
    std::size_t index_;
  };
  /// Of a job that begins; one that is in use if more than `jobs` are.
  Slot take();

 private:
  void give_back(std::size_t index);

  std::vector<std::vector<int>> sets_;
  std::mutex mutex_;
  std::vector<int> users_;
};

/// The calling thread, and what it starts meanwhile, keeps to these CPUs until the object goes; empty: to those that it has.
class KeepToCpus {
 public:
  explicit KeepToCpus(const std::vector<int>& cpus);
  ~KeepToCpus();
  KeepToCpus(const KeepToCpus&) = delete;
  /// False: the system did not let it, for example because a CPU is gone. The thread has its own ones then.
  bool is_kept() const { return kept_; }

 private:
  std::vector<int> own_;  ///< to go back to; empty: nothing was changed
  bool kept_ = true;
};

}  // namespace seaway::jobs
