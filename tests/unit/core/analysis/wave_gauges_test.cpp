// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/analysis/wave_gauges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/constants.hpp"

namespace seaway::analysis {
namespace {

struct Wave {
  double amplitude, frequency, phase;
};

double wave_number(double f) { return 4 * pi * pi * f * f / 9.81; }

/// 60 waves between 0.4 and 1.4 Hz, heaped about 0.7 Hz, at frequencies that fit no window.
std::vector<Wave> sea() {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> random(0, 1);
  std::vector<Wave> out;
  for (int i = 0; i < 60; ++i) {
    const double f = 0.4 + (i + random(generator)) / 60;
    out.push_back({0.01 * std::exp(-8 * (f - 0.7) * (f - 0.7) / 0.1), f, 2 * pi * random(generator)});
  }
  return out;
}

/// What a gauge sees of the sea and of a part of it that comes back.
std::vector<double> record(const std::vector<double>& t, double place, double reflection) {
  std::vector<double> x;
  const auto waves = sea();
  for (const double now : t) {
    double eta = 0.002;
    for (const Wave& w : waves) {
      const double k = wave_number(w.frequency), omega = 2 * pi * w.frequency;
      eta += w.amplitude * (std::cos(k * place - omega * now + w.phase) + reflection * std::cos(k * place + omega * now + 1.7 * w.phase));
    }
    x.push_back(eta);
  }
  return x;
}

TEST(WaveGauges, SeparateWhatComesFromWhatGoesBack) {
  std::vector<double> t;
  for (int i = 0; i < 4000; ++i) t.push_back(0.035 * i);
  const auto f = frequencies_of(t.back() - t.front(), 0.35, 1.45);
  std::vector<double> k;
  for (const double one : f) k.push_back(wave_number(one));
  for (const double reflection : {0.0, 0.03, 0.3}) {
    std::vector<Gauge> gauges;
    for (const double place : {0.0, 0.31, 0.8}) gauges.push_back({place, transform({t, record(t, place, reflection)}, f)});
    const Separation s = separate(gauges, k);
    double energy = 0;
    for (const Wave& w : sea()) energy += 0.5 * w.amplitude * w.amplitude;
    EXPECT_NEAR(s.reflection, reflection, 0.01 + 0.05 * reflection) << "neighbours in frequency share bins, whose wave number is not theirs";
    EXPECT_NEAR(s.incident_height, 4 * std::sqrt(energy), 0.06 * 4 * std::sqrt(energy)) << "60 waves in 140 s";
  }
}

TEST(WaveGauges, HeightPeriodAndPeakOfOneWave) {
  std::vector<double> t, x;
  for (double now = 0; now <= 14.001; now += 0.02) {
    t.push_back(now);
    x.push_back(0.3 + 0.05 * std::cos(2 * pi * now / 1.4 + 0.4));
  }
  EXPECT_NEAR(significant_height({t, x}), 4 * 0.05 / std::sqrt(2), 1e-4);
  EXPECT_NEAR(mean_up_crossing_period({t, x}), 1.4, 1e-4);
  const auto f = frequencies_of(14, 0.3, 2);
  const auto a = transform({t, x}, f);
  EXPECT_NEAR(peak_period(f, a, 0.03), 1.4, 0.005);
  for (std::size_t i = 0; i < f.size(); ++i)
    if (std::abs(f[i] - 1 / 1.4) < 1e-9) {
      EXPECT_NEAR(std::abs(a[i]), 0.05, 1e-4);
      EXPECT_NEAR(std::arg(a[i]), 0.4, 1e-2);
    }
}

}  // namespace
}  // namespace seaway::analysis
