#include "core/base/run_context.hpp"

#include <gtest/gtest.h>

namespace seaway {
namespace {

TEST(RunContext, QuietContextLogsNowhereAndNeverStops) {
  const RunContext context = quiet_context(3);
  ASSERT_NE(context.log, nullptr);
  context.log->info("unseen");
  EXPECT_FALSE(context.stop.stop_requested());
  EXPECT_EQ(context.threads, 3);
}

TEST(RunContext, CpuSecondsGrowWithWork) {
  const double start = process_cpu_seconds();
  volatile double sum = 0;
  while (process_cpu_seconds() < start + 0.01) sum = sum + 1;
  EXPECT_GT(process_cpu_seconds(), start);
}

}  // namespace
}  // namespace seaway
