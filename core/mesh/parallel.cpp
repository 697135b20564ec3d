#include "core/mesh/parallel.hpp"

#include <algorithm>

namespace seaway::mesh {
namespace {

/// Polite busy waiting: loops of a time step follow each other within microseconds.
constexpr int spins = 4000;

void pause_core() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

ThreadTeam& ThreadTeam::mine() {
  thread_local ThreadTeam team;
  return team;
}

ThreadTeam::~ThreadTeam() {
  for (auto& helper : helpers_) helper.request_stop();
  generation_.fetch_add(1);
  generation_.notify_all();
}

void ThreadTeam::take_chunks() {
  for (;;) {
    const int begin = next_.fetch_add(chunk_);
    if (begin >= n_) return;
    body_(context_, begin, std::min(begin + chunk_, n_));
  }
}

void ThreadTeam::work(const std::stop_token& stop) {
  unsigned seen = 0;
  for (;;) {
    unsigned now = generation_.load();
    for (int i = 0; i < spins && now == seen; ++i) {
      pause_core();
      now = generation_.load();
    }
    if (now == seen) {
      generation_.wait(seen);
      continue;
    }
    seen = now;
    if (stop.stop_requested()) return;
    // Join before looking: either this helper sees the loop closed, or the caller sees it inside.
    joined_.fetch_add(1);
    if (open_.load()) take_chunks();
    joined_.fetch_sub(1);
  }
}

void ThreadTeam::run(int n, int threads, void (*body)(void*, int, int), void* context) {
  while (static_cast<int>(helpers_.size()) < threads - 1)
    helpers_.emplace_back([this](const std::stop_token& stop) { work(stop); });
  body_ = body;
  context_ = context;
  n_ = n;
  chunk_ = std::max(1, n / (8 * threads));
  next_.store(0);
  open_.store(true);
  generation_.fetch_add(1);
  generation_.notify_all();
  take_chunks();
  open_.store(false);
  for (int i = 0; joined_.load() != 0; ++i) {
    if (i < spins) pause_core();
    else std::this_thread::yield();
  }
}

}  // namespace seaway::mesh
