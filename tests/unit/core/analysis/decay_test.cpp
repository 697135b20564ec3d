// SPDX-License-Identifier: GPL-3.0-or-later
// Histories with a known answer.
#include "core/analysis/decay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::analysis {
namespace {

struct History {
  std::vector<double> t, x;
  Signal signal() const { return {t, x}; }
};

/// mean + amplitude exp(-zeta w0 s) (cos + zeta/sqrt(1-zeta^2) sin): released at rest after `held` seconds.
History linear_decay(double amplitude, double period, double zeta, double mean = 0, double held = 0, double dt = 0.01,
                     double duration = 20) {
  History h;
  const double wd = 2 * pi / period, w0 = wd / std::sqrt(1 - zeta * zeta), side = zeta / std::sqrt(1 - zeta * zeta);
  for (double t = 0; t < duration; t += dt) {
    const double s = std::max(t - held, 0.0);
    h.t.push_back(t);
    h.x.push_back(mean + amplitude * std::exp(-zeta * w0 * s) * (std::cos(wd * s) + side * std::sin(wd * s)));
  }
  return h;
}

/// Half cosines between turning points that obey loss = a m + b m^2 exactly.
History extinction_decay(double first, double a, double b, double period, int half_cycles, double mean = 0, double dt = 0.01) {
  std::vector<double> peak{first};
  for (int i = 0; i <= half_cycles; ++i) {
    double next = peak.back();
    for (int k = 0; k < 200; ++k) {  // fixed point of p - next = a m + b m^2
      const double m = 0.5 * (peak.back() + next);
      next = peak.back() - a * m - b * m * m;
    }
    peak.push_back(next);
  }
  History h;
  for (double t = 0; t < 0.5 * period * half_cycles; t += dt) {
    const auto i = static_cast<std::size_t>(t / (0.5 * period));
    const double from = (i % 2 == 0 ? 1 : -1) * peak[i], to = (i % 2 == 0 ? -1 : 1) * peak[i + 1];
    const double s = t - 0.5 * period * static_cast<double>(i);
    h.t.push_back(t);
    h.x.push_back(mean + 0.5 * (from + to) + 0.5 * (from - to) * std::cos(2 * pi * s / period));
  }
  return h;
}

void add_noise(History& h, double sigma, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0, sigma);
  for (double& x : h.x) x += normal(generator);
}

TEST(Decay, LinearDampingGivesItsPeriodAndDamping) {
  const History h = linear_decay(18.3, 1.515, 0.04, -0.7);
  const Decay d = analyse_decay(h.signal());
  EXPECT_NEAR(d.damped_cosine.period.value, 1.515, 1e-6);
  EXPECT_NEAR(d.damped_cosine.damping_ratio.value, 0.04, 1e-6);
  EXPECT_NEAR(d.damped_cosine.mean.value, -0.7, 1e-6);
  EXPECT_NEAR(d.mean_period.value, 1.515, 1e-4);
  ASSERT_GE(d.cycles.size(), 6u);
  EXPECT_NEAR(d.peaks[0].angle, 18.3, 2e-3);
  EXPECT_NEAR(d.peaks[0].time, 0, 1e-9);
  const double ratio = std::exp(-0.04 / std::sqrt(1 - 0.04 * 0.04) * pi);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(d.peaks[i].angle, 18.3 * std::pow(-ratio, static_cast<double>(i)), 3e-3) << i;
    EXPECT_NEAR(d.peaks[i].time, 0.5 * 1.515 * static_cast<double>(i), 2e-3) << i;
  }
  EXPECT_NEAR(d.cycles[2].damping_ratio, 0.04, 2e-4);
  ASSERT_TRUE(d.extinction.has_value());
  EXPECT_NEAR(d.extinction->linear.value, 2 * (1 - ratio) / (1 + ratio), 2e-4);
  EXPECT_NEAR(d.extinction->quadratic.value, 0, 2e-5);
}

TEST(Decay, BeginsWhereAHeldHullIsReleased) {
  const History h = linear_decay(10, 1.4, 0.05, 0, 3.0);
  EXPECT_NEAR(h.t[begin_of_motion(h.signal())], 3.0, 0.011);
  const std::size_t from = begin_of_motion(h.signal());
  const Signal rest{std::span(h.t).subspan(from), std::span(h.x).subspan(from)};
  const Decay d = analyse_decay(rest);
  EXPECT_NEAR(d.peaks[0].angle, 10, 0.01);
  EXPECT_NEAR(d.peaks[1].time, 3.7, 5e-3);
}

TEST(Decay, ARecordThatBeginsInACycleLosesItsFirstPart) {
  const History h = linear_decay(10, 1.4, 0.05);
  const Signal rest{std::span(h.t).subspan(20), std::span(h.x).subspan(20)};
  const Decay d = analyse_decay(rest);
  EXPECT_NEAR(d.peaks[0].time, 0.7, 2e-3) << "the first turning point after a crossing";
  EXPECT_NEAR(d.damped_cosine.period.value, 1.4, 1e-6);
  ASSERT_TRUE(d.peaks[0].period.has_value());
  EXPECT_NEAR(*d.peaks[0].period, 1.4, 1e-3);
}

TEST(Decay, FindsBothExtinctionCoefficients) {
  const History h = extinction_decay(18.3, 0.05, 0.012, 1.5, 18, 0.4);
  const Decay d = analyse_decay(h.signal());
  ASSERT_TRUE(d.extinction.has_value());
  // The second derivative jumps at the turning points, which the quartic around them sees: a part in a thousand.
  EXPECT_NEAR(d.extinction->linear.value, 0.05, 0.05 * 0.01);
  EXPECT_NEAR(d.extinction->quadratic.value, 0.012, 0.012 * 0.01);
  EXPECT_NEAR(d.extinction->mean.value, 0.4, 0.01);
}

TEST(Decay, OnePercentNoiseMovesThePeriodByLessThanATenthOfAPercent) {
  History h = linear_decay(18.3, 1.515, 0.02);
  add_noise(h, 0.183, 7);
  const Decay d = analyse_decay(h.signal(), {0.1});
  EXPECT_NEAR(d.damped_cosine.period.value, 1.515, 1.5e-3);
  EXPECT_NEAR(d.mean_period.value, 1.515, 3e-3);
  EXPECT_NEAR(d.damped_cosine.damping_ratio.value, 0.02, 0.02 * 0.02);
}

/// Part of the trials whose 95 % interval covers the truth, for period, damping ratio, linear and quadratic extinction.
TEST(Decay, IntervalsCoverTheTruthAsOftenAsTheySay) {
  constexpr int trials = 300;
  int period = 0, damping = 0, linear = 0, quadratic = 0;
  for (unsigned seed = 0; seed < trials; ++seed) {
    History cosine = linear_decay(18.3, 1.515, 0.03, 0, 0, 0.02, 14);
    History extinct = extinction_decay(18.3, 0.05, 0.006, 1.5, 14, 0, 0.02);
    add_noise(cosine, 0.183, seed);
    add_noise(extinct, 0.183, 1000 + seed);
    const Decay a = analyse_decay(cosine.signal(), {0.1}), b = analyse_decay(extinct.signal(), {0.1});
    const auto covers = [](const Estimate& e, double truth) { return std::abs(e.value - truth) <= e.interval; };
    period += covers(a.damped_cosine.period, 1.515);
    damping += covers(a.damped_cosine.damping_ratio, 0.03);
    linear += covers(b.extinction->linear, 0.05);
    quadratic += covers(b.extinction->quadratic, 0.006);
  }
  // 95 % of 300 is 285; the scatter of a count like that is sqrt(300 0.95 0.05) = 3.8, three times of it are 11.
  for (const int count : {period, damping, linear, quadratic}) {
    EXPECT_GE(count, 285 - 12);
    EXPECT_LE(count, 285 + 12);
  }
}

TEST(Decay, WhatIsNoDecayIsRefused) {
  History flat{{}, {}};
  for (int i = 0; i < 100; ++i) {
    flat.t.push_back(0.01 * i);
    flat.x.push_back(0);
  }
  EXPECT_THROW(analyse_decay(flat.signal()), Error);
  History rising = flat;
  for (std::size_t i = 0; i < rising.x.size(); ++i) rising.x[i] = 0.1 * static_cast<double>(i);
  EXPECT_THROW(analyse_decay(rising.signal()), Error);
  rising.x[3] = std::nan("");
  EXPECT_THROW(analyse_decay(rising.signal()), Error);
}

}  // namespace
}  // namespace seaway::analysis
