// Observed orders and uncertainties of sequences whose order and limit are known.
#include "tests/validation/report/uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"

namespace seaway::validation {
namespace {

GridSeries power_series(const std::vector<double>& h, double limit, double factor, double order) {
  GridSeries s{h, {}, 2};
  for (const double x : h) s.value.push_back(limit + factor * std::pow(x, order));
  return s;
}

TEST(NumericalUncertainty, FindsTheOrderOfThreeMeshesOfAnyRatio) {
  for (const double order : {0.7, 1.0, 2.0, 3.1})
    for (const auto& h : {std::vector<double>{1, 2, 4}, {1, 1.5, 2.9}, {0.01, 0.012, 0.02}}) {
      const auto u = numerical_uncertainty(power_series(h, 5, -0.3, order));
      ASSERT_TRUE(u && u->order);
      EXPECT_NEAR(*u->order, order, 1e-6);  // bisection on rounded differences
      EXPECT_NEAR(*u->extrapolated, 5, 1e-9);
      EXPECT_TRUE(u->converging);
    }
}

TEST(NumericalUncertainty, UsesTheFactorOfSafetyOfTheOrder) {
  // Error of the finest mesh 0.3; P = 1: 1.6, P = 0.5: 2.025, P = 1.5: 9.8 [xing2010].
  EXPECT_NEAR(numerical_uncertainty(power_series({1, 2, 4}, 5, 0.3, 2))->expanded, 1.6 * 0.3, 1e-9);
  EXPECT_NEAR(numerical_uncertainty(power_series({1, 2, 4}, 5, 0.3, 1))->expanded, 2.025 * 0.3, 1e-9);
  EXPECT_NEAR(numerical_uncertainty(power_series({1, 2, 4}, 5, 0.3, 3))->expanded, 9.8 * 0.3, 1e-9);
}

TEST(NumericalUncertainty, OrderOfMeshesDoesNotMatter) {
  const auto a = numerical_uncertainty(power_series({1, 2, 4}, 5, 0.3, 1.3));
  const auto b = numerical_uncertainty(power_series({4, 1, 2}, 5, 0.3, 1.3));
  EXPECT_EQ(*a->order, *b->order);
  EXPECT_EQ(a->expanded, b->expanded);
}

TEST(NumericalUncertainty, LeastSquaresFindTheOrderOfFourMeshes) {
  const auto u = numerical_uncertainty(power_series({1, 1.4, 2, 2.8}, 7, 0.2, 1.6));
  ASSERT_TRUE(u && u->order);
  EXPECT_NEAR(*u->order, 1.6, 1e-4);  // the minimum of squares is flat: half the digits
  EXPECT_NEAR(*u->extrapolated, 7, 1e-4);
  EXPECT_NEAR(u->expanded, 1.25 * 0.2, 1e-4);
  EXPECT_TRUE(u->converging);
}

TEST(NumericalUncertainty, LeastSquaresBoundNoisyValues) {
  GridSeries s = power_series({1, 1.4, 2, 2.8, 4}, 7, 0.2, 2);
  const double noise[] = {0.01, -0.02, 0.015, -0.01, 0.02};
  for (std::size_t i = 0; i < 5; ++i) s.value[i] += noise[i];
  const auto u = numerical_uncertainty(s);
  EXPECT_GT(u->expanded, std::abs(s.value[0] - 7));  // the true error is inside
  EXPECT_LT(u->expanded, 1.0);
  EXPECT_GT(u->fit_deviation, 0.005);
}

TEST(NumericalUncertainty, SuperconvergenceFallsBackToFixedPowers) {
  const auto u = numerical_uncertainty(power_series({1, 1.4, 2, 2.8}, 7, 0.01, 5));
  EXPECT_NEAR(*u->order, 5, 1e-3);
  EXPECT_FALSE(u->converging);              // not of the order the theory has
  EXPECT_GT(u->expanded, 3 * 0.01);         // more than three times the true error
}

TEST(NumericalUncertainty, SaysWhenValuesDoNotConverge) {
  const auto oscillating = numerical_uncertainty({{1, 2, 4}, {5, 5.2, 4.9}, 2});
  EXPECT_FALSE(oscillating->order);
  EXPECT_FALSE(oscillating->converging);
  EXPECT_NEAR(oscillating->expanded, 0.9, 1e-12);
  EXPECT_NE(oscillating->method.find("oscillating"), std::string::npos);
  const auto diverging = numerical_uncertainty({{1, 2, 4}, {5, 4, 3.5}, 2});
  EXPECT_FALSE(diverging->order);
  EXPECT_NEAR(diverging->expanded, 4.5, 1e-12);
  EXPECT_NE(diverging->method.find("not converging"), std::string::npos);
}

TEST(NumericalUncertainty, TwoMeshesTakeTheFormalOrderAndThreeTimesTheError) {
  GridSeries s = power_series({1, 2}, 5, 0.3, 1);
  s.formal_order = 1;
  EXPECT_NEAR(numerical_uncertainty(s)->expanded, 3 * 0.3, 1e-12);
  EXPECT_FALSE(numerical_uncertainty(s)->order);
  EXPECT_FALSE(numerical_uncertainty({{1}, {5}, 2}));
}

TEST(NumericalUncertainty, RefusesWhatIsNoSeries) {
  EXPECT_THROW(numerical_uncertainty({{1, 1, 2}, {1, 2, 3}, 2}), Error);
  EXPECT_THROW(numerical_uncertainty({{1, 2}, {1}, 2}), Error);
  EXPECT_THROW(numerical_uncertainty({{1, -2}, {1, 2}, 2}), Error);
  EXPECT_THROW(numerical_uncertainty({{1, 2}, {1, std::nan("")}, 2}), Error);
}

TEST(Comparison, ErrorIsSignificantBeyondTwoValidationUncertainties) {
  const Comparison c = compare(10.0, 9.0, 0.6, 0.0, 0.4);  // u_num 0.3, u_val 0.5
  EXPECT_DOUBLE_EQ(c.error, 1.0);
  EXPECT_DOUBLE_EQ(c.u_val, 0.5);
  EXPECT_FALSE(c.significant());
  EXPECT_TRUE(compare(10.1, 9.0, 0.6, 0.0, 0.4).significant());
  EXPECT_DOUBLE_EQ(compare(0, 0, 0, 3, 4).u_val, 5);
}

}  // namespace
}  // namespace seaway::validation
