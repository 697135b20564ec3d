#include "core/sim/cycle_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::sim {
namespace {

constexpr double period = 1.4, start = 0.35;

/// Two signals at uneven times: a sine of a slightly different period, and a constant with a
/// cosine.
std::vector<double> signals(double t, double own_period = period) {
  return {0.3 + 2.0 * std::cos(2 * pi * (t - start) / own_period - 0.7),
          -1.5 + 0.25 * std::sin(2 * pi * (t - start) / period)};
}
double next_time(double t, int k) { return t + 0.006 + 0.002 * std::sin(1.7 * k); }

CycleMonitor watched(double until, double own_period = period) {
  CycleMonitor monitor(start, period, 2);
  double t = start;
  for (int k = 0; t < until; ++k) {
    monitor.add(t, signals(t, own_period));
    t = next_time(t, k);
  }
  return monitor;
}

// Straight lines between samples 1/230 of a period apart: relative error of an amplitude
// (2 pi / 230)^2 / 12 = 6e-5, half of it again for the interpolated ends.
constexpr double chord = 1e-4;

TEST(CycleMonitor, FindsMeanAmplitudeAndPhaseOfEachSignal) {
  const CycleMonitor monitor = watched(start + 5.3 * period);
  ASSERT_EQ(monitor.count(), 5u);
  for (const auto& cycle : monitor.cycles()) {
    EXPECT_NEAR(cycle[0].mean, 0.3, 2 * chord);
    EXPECT_NEAR(cycle[0].amplitude, 2.0, 2 * chord);
    EXPECT_NEAR(cycle[0].phase, 0.7, chord);
    EXPECT_NEAR(cycle[1].mean, -1.5, chord);
    EXPECT_NEAR(cycle[1].amplitude, 0.25, chord);
    EXPECT_NEAR(cycle[1].phase, pi / 2, 2 * chord);
  }
  EXPECT_LT(monitor.motion_change({0, 1}, 2), 2 * chord);
  EXPECT_NEAR(monitor.average(0, 3).amplitude, 2.0, 2 * chord);
}

TEST(CycleMonitor, FindsThePeriodOfADetunedSine) {
  for (const double ratio : {0.97, 0.99, 1.01, 1.03}) {
    const CycleMonitor monitor = watched(start + 8.2 * period, ratio * period);
    // A sine cut to a foreign period leaks a part of order (ratio - 1) into the phase: second order
    // here.
    EXPECT_NEAR(monitor.signal_period(0, 3) / period, ratio, 3 * (ratio - 1) * (ratio - 1))
        << ratio;
    // The change of phase per cycle is what the end rule sees.
    EXPECT_NEAR(monitor.motion_change({0}, 2), std::abs(ratio - 1), 0.3 * std::abs(ratio - 1))
        << ratio;
    EXPECT_LT(monitor.motion_change({1}, 2), chord * 4);
  }
}

TEST(CycleMonitor, SeesADecayAndWaitsForEnoughCycles) {
  CycleMonitor monitor(0, 1, 1);
  for (double t = 0; t < 1.5; t += 0.01)
    monitor.add(t, {std::exp(-0.1 * t) * std::sin(2 * pi * t)});
  EXPECT_EQ(monitor.count(), 1u);
  EXPECT_TRUE(std::isinf(monitor.amplitude_change({0}, 1)));
  EXPECT_TRUE(std::isinf(monitor.motion_change({0}, 1)));
  for (double t = 1.5; t < 4.5; t += 0.01)
    monitor.add(t, {std::exp(-0.1 * t) * std::sin(2 * pi * t)});
  EXPECT_EQ(monitor.count(), 4u);
  EXPECT_NEAR(monitor.amplitude_change({0}, 1), 1 - std::exp(-0.1), 2e-4);
  EXPECT_NEAR(monitor.amplitude_change({0}, 2), 1 - std::exp(-0.2), 2e-4);
}

TEST(CycleMonitor, ClosesSeveralCyclesInOneLongStepAndIgnoresWhatCameBefore) {
  CycleMonitor monitor(1.0, 0.5, 1);
  monitor.add(0.2, {77});
  monitor.add(1.0, {0});
  monitor.add(2.6, {1.6});  // the line v = t - 1
  ASSERT_EQ(monitor.count(), 3u);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(monitor.cycles()[c][0].mean, 0.25 + 0.5 * static_cast<double>(c), 1e-14);
  CycleMonitor none(0, 0, 1);
  none.add(1, {1});
  none.add(2, {1});
  EXPECT_EQ(none.count(), 0u) << "no period, no cycles";
}

TEST(CycleMonitor, GoesOnToTheBitAfterSaveAndLoad) {
  CycleMonitor whole(start, period, 2), part(start, period, 2);
  double t = start;
  for (int k = 0; t < start + 6.5 * period; ++k) {
    whole.add(t, signals(t, 1.01 * period));
    part.add(t, signals(t, 1.01 * period));
    if (k % 97 == 96) part = CycleMonitor::load(part.save());
    t = next_time(t, k);
  }
  EXPECT_EQ(whole.save(), part.save());
  EXPECT_EQ(CycleMonitor::load(CycleMonitor().save()).save(), CycleMonitor().save());
}

}  // namespace
}  // namespace seaway::sim
