// What is read off the record of a run.
#include "tests/validation/support/run_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::validation {
namespace {

TEST(RunRecord, ConvergesWhenTheSwingsRepeatByTheRuleOfAStage) {
  // From its start, two periods after that of the run, the amplitude falls as 1 + exp(-n): it changes by less than 1 % over
  // two periods once exp(-n) (e^2 - 1) < 0.01, in the seventh period.
  RunRecord r;
  constexpr double period = 1.4;
  for (int i = 0; i <= 2000; ++i) {
    const double n = i / 100.0;
    r.t.push_back(n * period);
    r.roll.push_back(n < 2 ? 5.0 : (1 + std::exp(2 - n)) * std::cos(2 * pi * n));
    r.heave.push_back(0.01 * std::sin(2 * pi * n));
  }
  sim::EndRule rule;
  rule.min_periods = 4;
  const double at = r.converged_at(2 * period, rule, period);
  EXPECT_GT(at, 8.5 * period);
  EXPECT_LT(at, 10.5 * period);
  EXPECT_NEAR(std::remainder(at, period), 0, 1e-6);  // rules are looked at when a period is over
  rule.min_periods = 12;
  EXPECT_NEAR(r.converged_at(2 * period, rule, period), 14 * period, 1e-6);
  rule.tolerance = 1e-12;
  EXPECT_TRUE(std::isinf(r.converged_at(2 * period, rule, period)));
}

}  // namespace
}  // namespace seaway::validation
