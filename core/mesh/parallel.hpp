// Block loops on threads. Each index is handled by exactly one thread and writes only its own block, and
// sums are taken per block and then in block order: the number of threads never changes a result.
// OpenMP is used here and nowhere else.
#pragma once

#include <exception>
#include <mutex>
#include <vector>

namespace seaway::mesh {

/// f(i) for i in [0, n). The first exception is kept and rethrown after the loop.
template <class F>
void parallel_for(int n, int threads, F&& f) {
  if (threads <= 1 || n < 2) {
    for (int i = 0; i < n; ++i) f(i);
    return;
  }
#ifdef _OPENMP
  std::exception_ptr first;
  std::mutex guard;
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int i = 0; i < n; ++i) {
    try {
      f(i);
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!first) first = std::current_exception();
    }
  }
  if (first) std::rethrow_exception(first);
#else
  for (int i = 0; i < n; ++i) f(i);
#endif
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
