// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/analysis/harmonic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::analysis {
namespace {

constexpr double omega = 2 * pi / 1.4;

struct History {
  std::vector<double> t, x;
  Signal signal() const { return {t, x}; }
};

template <class F>
History sample(F f, double duration, double dt = 0.013) {
  History h;
  for (double t = 0; t < duration; t += dt) {
    h.t.push_back(t);
    h.x.push_back(f(t));
  }
  return h;
}

TEST(Harmonic, FindsMeanAmplitudePhaseAndSecondHarmonic) {
  const History h = sample([](double t) { return 0.3 + 2 * std::cos(omega * t + 0.7) + 0.25 * std::cos(2 * omega * t - 1); }, 20);
  const Harmonic f = fit_harmonic(h.signal(), omega, 5);
  EXPECT_EQ(f.periods, 5);
  EXPECT_NEAR(f.mean, 0.3, 1e-10);
  EXPECT_NEAR(f.amplitude, 2, 1e-10);
  EXPECT_NEAR(f.phase, 0.7, 1e-10);
  EXPECT_NEAR(f.second, 0.25, 1e-10);
  EXPECT_NEAR(f.amplitude_scatter, 0, 1e-9);
  EXPECT_NEAR(f.until - f.from, 7, 1e-9);
}

TEST(Harmonic, UnequalStepsDoNotMatter) {
  History h;
  for (double t = 0; t < 12; t += 0.01 + 0.009 * std::sin(40 * t)) {
    h.t.push_back(t);
    h.x.push_back(1 + 3 * std::cos(omega * t - 2));
  }
  const Harmonic f = fit_harmonic(h.signal(), omega, 6);
  EXPECT_NEAR(f.amplitude, 3, 1e-10);
  EXPECT_NEAR(f.phase, -2, 1e-10);
}

TEST(Harmonic, OnlyTheLastPeriodsCount) {
  const History h = sample([](double t) { return (t < 10 ? 7 : 1) * std::cos(omega * t); }, 20);
  EXPECT_NEAR(fit_harmonic(h.signal(), omega, 5).amplitude, 1, 1e-10);
  EXPECT_GT(fit_harmonic(h.signal(), omega, 12).amplitude_scatter, 0.5);
}

TEST(Harmonic, AGrowingResponseShowsItsTrend) {
  const History h = sample([](double t) { return (1 + 0.01 * t) * std::cos(omega * t); }, 20);
  const Harmonic f = fit_harmonic(h.signal(), omega, 6);
  EXPECT_NEAR(f.amplitude_trend, 0.01 * 1.4 * 5, 1e-3);
}

TEST(Harmonic, NoiseIsAveraged) {
  History h = sample([](double t) { return 2 * std::cos(omega * t + 3.1); }, 20);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 0.2);
  for (double& x : h.x) x += normal(generator);
  const Harmonic f = fit_harmonic(h.signal(), omega, 10);
  const double expected = 0.2 * std::sqrt(2 / (14 / 0.013));  // of an amplitude out of so many samples
  EXPECT_NEAR(f.amplitude, 2, 4 * expected);
  EXPECT_NEAR(f.amplitude_scatter, expected * std::sqrt(10), 0.8 * expected * std::sqrt(10));
  EXPECT_NEAR(f.phase, 3.1, 4 * expected / 2);
  EXPECT_LT(f.phase_scatter, 0.1) << "phases near pi are neighbours of those near -pi";
}

TEST(Harmonic, FewerPeriodsThanAskedForAreUsedAndNoneIsRefused) {
  const History h = sample([](double t) { return std::cos(omega * t); }, 3);
  EXPECT_EQ(fit_harmonic(h.signal(), omega, 5).periods, 2);
  EXPECT_THROW(fit_harmonic(sample([](double) { return 0.0; }, 1).signal(), omega, 5), Error);
  EXPECT_THROW(fit_harmonic(sample([](double) { return 0.0; }, 20, 0.3).signal(), omega, 5), Error);
}

TEST(Harmonic, WrapKeepsPi) {
  EXPECT_DOUBLE_EQ(wrap(3 * pi), pi);
  EXPECT_DOUBLE_EQ(wrap(-pi), pi);
  EXPECT_NEAR(wrap(7), 7 - 2 * pi, 1e-12);
}

}  // namespace
}  // namespace seaway::analysis
