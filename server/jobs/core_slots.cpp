// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/core_slots.hpp"

#include <sched.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <utility>

namespace seaway::jobs {
namespace {

/// Of the calling thread; empty if the kernel does not say, as on machines with more than CPU_SETSIZE CPUs.
std::vector<int> affinity() {
  cpu_set_t set;
  std::vector<int> out;
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return out;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &set)) out.push_back(cpu);
  return out;
}

bool set_affinity(const std::vector<int>& cpus) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int cpu : cpus) CPU_SET(cpu, &set);
  return ::sched_setaffinity(0, sizeof set, &set) == 0;
}

/// First one CPU of each core, then the second ones ...
std::vector<int> one_of_each_core_first(const std::vector<Cpu>& cpus) {
  std::map<std::string, int> seen;
  std::vector<std::pair<int, int>> ranked;  // how many of its core are before it, number
  for (const Cpu& cpu : cpus) ranked.emplace_back(seen[cpu.core]++, cpu.number);
  std::sort(ranked.begin(), ranked.end());
  std::vector<int> out;
  for (const auto& [rank, number] : ranked) out.push_back(number);
  return out;
}

/// All CPUs of a core one after the other, cores by their first CPU.
std::vector<int> core_by_core(const std::vector<Cpu>& cpus) {
  std::map<std::string, int> first;
  for (const Cpu& cpu : cpus) first.try_emplace(cpu.core, cpu.number);
  std::vector<std::pair<int, int>> ranked;
  for (const Cpu& cpu : cpus) ranked.emplace_back(first[cpu.core], cpu.number);
  std::sort(ranked.begin(), ranked.end());
  std::vector<int> out;
  for (const auto& [core, number] : ranked) out.push_back(number);
  return out;
}

std::size_t count_cores(const std::vector<Cpu>& cpus) {
  std::set<std::string> cores;
  for (const Cpu& cpu : cpus) cores.insert(cpu.core);
  return cores.size();
}

}  // namespace

std::vector<Cpu> available_cpus() {
  std::vector<Cpu> out;
  for (const int number : affinity()) {
    const std::string name = "cpu" + std::to_string(number);
    std::string siblings;
    std::ifstream("/sys/devices/system/cpu/" + name + "/topology/thread_siblings_list") >> siblings;
    out.push_back({number, siblings.empty() ? name : siblings});
  }
  return out;
}

CoreSlots::CoreSlots(std::vector<Cpu> cpus, int jobs, int threads) {
  const auto n = static_cast<std::size_t>(std::max(1, jobs)), width = static_cast<std::size_t>(std::max(1, threads));
  sets_.resize(n);
  users_.resize(n);
  if (width >= cpus.size()) return;
  std::sort(cpus.begin(), cpus.end(), [](const Cpu& a, const Cpu& b) { return a.number < b.number; });
  const std::vector<int> order = n * width <= count_cores(cpus) ? one_of_each_core_first(cpus) : core_by_core(cpus);
  for (std::size_t i = 0; i < n * width; ++i) sets_[i / width].push_back(order[i % order.size()]);
}

CoreSlots::Slot CoreSlots::take() {
  const std::lock_guard lock(mutex_);
  const auto least = std::min_element(users_.begin(), users_.end());
  ++*least;
  return {*this, static_cast<std::size_t>(least - users_.begin())};
}

void CoreSlots::give_back(std::size_t index) {
  const std::lock_guard lock(mutex_);
  --users_[index];
}

KeepToCpus::KeepToCpus(const std::vector<int>& cpus) {
  if (cpus.empty()) return;
  own_ = affinity();
  kept_ = !own_.empty() && set_affinity(cpus);
}

KeepToCpus::~KeepToCpus() {
  if (!own_.empty()) set_affinity(own_);
}

}  // namespace seaway::jobs
