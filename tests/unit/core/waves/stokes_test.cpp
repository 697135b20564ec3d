#include "core/waves/stokes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"

namespace seaway::waves {
namespace {

RegularWaveSpec spec(double height, double depth) {
  RegularWaveSpec s;
  s.height = height;
  s.depth = depth;
  s.period = 1.4;
  return s;
}

/// Largest difference of elevation, velocity and speed from the exact wave, in parts of the wave's own.
double difference(double height, double depth, RegularWaveSpec::MeanFlow flow) {
  RegularWaveSpec s = spec(height, depth);
  s.mean_flow = flow;
  const auto exact = make_wave(s);
  s.theory = RegularWaveSpec::Theory::stokes_5;
  const auto series = make_wave(s);
  double worst = std::abs(series->celerity() / exact->celerity() - 1);
  const double speed = pi * height / 1.4;
  for (int i = 0; i < 20; ++i) {
    const double y = exact->length() * i / 20, scaled = series->length() * i / 20;
    worst = std::max(worst, std::abs(series->elevation(0, scaled, 0) - exact->elevation(0, y, 0)) / height);
    worst = std::max(worst, (series->velocity({0, scaled, -0.2 * depth}, 0) - exact->velocity({0, y, -0.2 * depth}, 0)).norm() / speed);
  }
  return worst;
}

TEST(Stokes, ApproachesTheExactWaveAtItsOrder) {
  for (const auto flow : {RegularWaveSpec::MeanFlow::zero_transport, RegularWaveSpec::MeanFlow::zero_eulerian})
    for (const double depth : {2.79, 0.6}) {
      const double low = difference(0.06, depth, flow), high = difference(0.12, depth, flow);
      EXPECT_LT(low, 1e-5) << depth;
      // Relative to the wave the first term left out is of fifth order: 2^5 = 32. A wrong coefficient shows as less.
      EXPECT_GT(high / low, 20) << depth;
    }
}

TEST(Stokes, PressureIsZeroAtTheSurface) {
  RegularWaveSpec s = spec(0.08, 2.79);
  s.theory = RegularWaveSpec::Theory::stokes_5;
  const auto wave = make_wave(s);
  for (double y = 0; y < 3; y += 0.17) EXPECT_NEAR(wave->pressure({0, y, wave->elevation(0, y, 0.3)}, 0.3), 0, 0.05) << "Pa, of 800";
  EXPECT_NEAR(wave->mean_transport(), 0, 1e-15);
}

TEST(Stokes, RefusesLongAndBreakingWaves) {
  RegularWaveSpec s = spec(0.05, 0.1);
  s.theory = RegularWaveSpec::Theory::stokes_5;
  EXPECT_THROW(make_wave(s), Error);
  s = spec(0.6, 2.79);
  s.theory = RegularWaveSpec::Theory::stokes_5;
  EXPECT_THROW(make_wave(s), Error);
}

}  // namespace
}  // namespace seaway::waves
