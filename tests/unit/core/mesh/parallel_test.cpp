#include "core/mesh/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace seaway::mesh {
namespace {

TEST(Parallel, EveryIndexIsHandledOnce) {
  for (const int threads : {1, 2, 4}) {
    std::vector<std::atomic<int>> visits(1000);
    parallel_for(1000, threads, [&](int i) { ++visits[static_cast<std::size_t>(i)]; });
    for (const auto& v : visits) EXPECT_EQ(v, 1);
  }
}

TEST(Parallel, SumsHaveTheSameBitsOnAnyNumberOfThreads) {
  const auto term = [](int i) { return std::sin(i) * std::pow(10.0, i % 13 - 6); };
  const double one = parallel_sum(5000, 1, term);
  for (const int threads : {2, 3, 4}) EXPECT_EQ(parallel_sum(5000, threads, term), one);
}

TEST(Parallel, MaximumIsAtLeastItsFloorAndShowsNaN) {
  const auto square = [](int i) { return -1.0 - i; };
  EXPECT_EQ(parallel_max(10, 2, 0.5, square), 0.5);
  EXPECT_EQ(parallel_max(10, 2, -5, square), -1);
  const auto broken = [](int i) { return i == 7 ? std::numeric_limits<double>::quiet_NaN() : i; };
  EXPECT_TRUE(std::isnan(parallel_max(10, 2, 0, broken)));
}

TEST(Parallel, TheFirstExceptionReachesTheCaller) {
  for (const int threads : {1, 4})
    EXPECT_THROW(parallel_for(100, threads,
                              [](int i) {
                                if (i == 50) throw std::runtime_error("fifty");
                              }),
                 std::runtime_error);
}

}  // namespace
}  // namespace seaway::mesh
