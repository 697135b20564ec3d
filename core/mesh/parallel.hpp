// Block loops on threads. Each index is handled by exactly one thread and writes only its own block, and
// sums are taken per block and then in block order: the number of threads never changes a result.
//
// Indices are handed out in chunks as threads ask for them: a core that other programs keep busy delays its
// own chunk only, where a fixed share would hold up every loop of the time step.
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace seaway::mesh {

/// Helpers of one calling thread; made on its first parallel loop and ended with it.
class ThreadTeam {
 public:
  ~ThreadTeam();
  /// Calls body(context, begin, end) for chunks that cover [0, n); returns when all are done.
  void run(int n, int threads, void (*body)(void*, int, int), void* context);
  /// The team of the calling thread.
  static ThreadTeam& mine();

 private:
  void work(const std::stop_token& stop);
  void take_chunks();

  std::vector<std::jthread> helpers_;
  std::atomic<unsigned> generation_{0};
  std::atomic<bool> open_{false};   ///< a loop is running and may be joined
  std::atomic<int> joined_{0};      ///< helpers inside the loop
  std::atomic<int> next_{0};
  void (*body_)(void*, int, int) = nullptr;
  void* context_ = nullptr;
  int n_ = 0, chunk_ = 1;
};

/// f(i) for i in [0, n). The first exception is kept and rethrown after the loop.
template <class F>
void parallel_for(int n, int threads, F&& f) {
  if (threads <= 1 || n < 2) {
    for (int i = 0; i < n; ++i) f(i);
    return;
  }
  struct Loop {
    F* f;
    std::exception_ptr first;
    std::mutex guard;
  } loop{&f, nullptr, {}};
  ThreadTeam::mine().run(
      n, threads,
      [](void* context, int begin, int end) {
        auto* l = static_cast<Loop*>(context);
        try {
          for (int i = begin; i < end; ++i) (*l->f)(i);
        } catch (...) {
          const std::lock_guard lock(l->guard);
          if (!l->first) l->first = std::current_exception();
        }
      },
      &loop);
  if (loop.first) std::rethrow_exception(loop.first);
}

/// f(item) for the items of a list.
template <class F>
void for_each(const std::vector<int>& items, int threads, F&& f) {
  parallel_for(static_cast<int>(items.size()), threads, [&](int i) { f(items[static_cast<std::size_t>(i)]); });
}

/// Sum of f(i), each computed on its own, added in the order of i.
template <class F>
double parallel_sum(int n, int threads, F&& f) {
  if (threads <= 1) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += f(i);
    return sum;
  }
  std::vector<double> part(static_cast<std::size_t>(n));
  parallel_for(n, threads, [&](int i) { part[static_cast<std::size_t>(i)] = f(i); });
  double sum = 0;
  for (const double x : part) sum += x;
  return sum;
}

/// Largest f(i), at least `floor`; NaN wins, so that a blow-up is seen.
template <class F>
double parallel_max(int n, int threads, double floor, F&& f) {
  std::vector<double> part(static_cast<std::size_t>(n));
  parallel_for(n, threads, [&](int i) { part[static_cast<std::size_t>(i)] = f(i); });
  double largest = floor;
  for (const double x : part) {
    if (!(x <= largest)) largest = x;
    if (x != x) return x;
  }
  return largest;
}

}  // namespace seaway::mesh
