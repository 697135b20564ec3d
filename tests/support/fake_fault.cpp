// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/fake_fault.hpp"

#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

namespace seaway::testing {
namespace {

/// Dies as the hardware would make it die, also where a sanitizer has a handler of its own.
[[noreturn]] void die_by(int number) {
  ::signal(number, SIG_DFL);
  ::raise(number);
  std::abort();
}

[[noreturn]] void take_memory() {
  std::vector<std::unique_ptr<char[]>> all;
  for (;;) {
    constexpr std::size_t piece = 16 << 20;
    all.push_back(std::make_unique<char[]>(piece));
    std::memset(all.back().get(), 1, piece);
  }
}

[[noreturn]] void fill_disk(const std::string& folder) {
  for (int i = 0;; ++i) {
    std::ofstream(folder + "/big" + std::to_string(i)) << std::string(1 << 18, 'x');
    ::usleep(20'000);
  }
}

}  // namespace

FakeFault::FakeFault(const std::string& title, const std::string& folder) : folder_(folder) {
  const auto at = title.find("fault ");
  if (at == std::string::npos) return;
  char kind[16] = {};
  long long sequence = 0;
  int times = 0;
  if (std::sscanf(title.c_str() + at, "fault %15[a-z]@%lldx%d", kind, &sequence, &times) < 2) return;
  kind_ = kind;
  at_ = sequence;
  times_ = times;
}

void FakeFault::before(std::int64_t sequence) {
  if (kind_.empty() || sequence != at_) return;
  if (times_ > 0) {
    const std::string file = folder_ + ".faults";
    int done = 0;
    std::ifstream(file) >> done;
    if (done >= times_) return;
    std::ofstream(file) << done + 1;
  }
  strike();
}

void FakeFault::strike() {
  if (kind_ == "segv") {
    std::fprintf(stderr, "about to follow a bad pointer\n");
    die_by(SIGSEGV);
  }
  if (kind_ == "fpe") die_by(SIGFPE);
  if (kind_ == "abort") die_by(SIGABRT);
  if (kind_ == "exit") ::_exit(9);
  if (kind_ == "sleep") ::raise(SIGSTOP);
  if (kind_ == "memory") take_memory();
  if (kind_ == "disk") fill_disk(folder_);
  if (kind_ == "deaf") deaf_ = true;
  if (kind_ == "throw") throw std::runtime_error("thrown on purpose");
  if (kind_ == "hang")
    for (volatile unsigned long n = 0;;) {
      const unsigned long next = n + 1;
      n = next;
    }
}

}  // namespace seaway::testing
