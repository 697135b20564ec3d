// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/analysis/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace seaway::analysis {
namespace {

TEST(Student, MatchesTheTable) {
  // Two-sided 5 % points, printed digits of the usual table.
  EXPECT_NEAR(student_95(1), 12.706, 5e-4);
  EXPECT_NEAR(student_95(2), 4.303, 5e-4);
  EXPECT_NEAR(student_95(5), 2.571, 5e-4);
  EXPECT_NEAR(student_95(10), 2.228, 5e-4);
  EXPECT_NEAR(student_95(30), 2.042, 5e-4);
  EXPECT_NEAR(student_95(1000), 1.962, 5e-4);
}

TEST(LeastSquares, GivesTheTextbookLineWithItsInterval) {
  // y = 1, 3, 2, 5, 4 at x = 0 .. 4: slope 0.8, intercept 1.4; sum of squares 3.6, so that the slope has the standard
  // error sqrt(3.6 / 3 / 10) and the interval 3.182 of it.
  const Eigen::VectorXd y = (Eigen::VectorXd(5) << 1, 3, 2, 5, 4).finished();
  const auto fit = minimise(
      [&](const Eigen::VectorXd& p, Eigen::VectorXd& r) {
        for (int i = 0; i < 5; ++i) r[i] = y[i] - p[0] - p[1] * i;
      },
      5, Eigen::VectorXd::Zero(2));
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.parameters[0], 1.4, 1e-8);
  const Estimate slope = fit.estimate(1);
  EXPECT_NEAR(slope.value, 0.8, 1e-8);
  EXPECT_NEAR(slope.interval, 3.1824 * std::sqrt(3.6 / 3 / 10), 1e-3);
}

TEST(LeastSquares, WithoutSpareDataThereIsNoInterval) {
  const auto fit = minimise([](const Eigen::VectorXd& p, Eigen::VectorXd& r) { r[0] = p[0] - 3; }, 1, Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(fit.parameters[0], 3, 1e-9);
  EXPECT_LT(fit.estimate(0).interval, 0);
}

TEST(CorrelationLength, IsOneForAlternatingAndLargeForSmoothRests) {
  Eigen::VectorXd alternating(100), smooth(1000);
  for (int i = 0; i < 100; ++i) alternating[i] = i % 2 == 0 ? 1 : -1;
  for (int i = 0; i < 1000; ++i) smooth[i] = std::sin(0.01 * i);
  EXPECT_EQ(correlation_length(alternating), 1);
  EXPECT_GT(correlation_length(smooth), 100);
}

}  // namespace
}  // namespace seaway::analysis
