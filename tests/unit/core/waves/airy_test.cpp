#include "core/waves/airy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"

namespace seaway::waves {
namespace {

TEST(Airy, WaveNumberSolvesDispersionFromShallowToDeep) {
  for (const double depth : {1e-3, 0.05, 0.5, 3.0, 100.0, 1e4}) {
    for (const double period : {0.3, 1.0, 5.0, 20.0}) {
      const double omega = 2 * pi / period;
      const double k = linear_wave_number(omega, depth, 9.81);
      EXPECT_NEAR(linear_omega(k, depth, 9.81) / omega, 1, 1e-14) << depth << " " << period;
    }
  }
}

TEST(Airy, HasTextbookVelocityAndPressure) {
  RegularWaveSpec spec;
  spec.theory = RegularWaveSpec::Theory::airy;
  spec.mean_flow = RegularWaveSpec::MeanFlow::zero_eulerian;
  spec.height = 0.02;
  spec.period = 1;
  spec.depth = 0.5;
  const auto wave = make_wave(spec);
  EXPECT_NEAR(wave->length(), 1.51298, 1e-5);
  const double omega = 2 * pi, k = omega / wave->celerity(), z = -0.2;
  const double ratio = std::cosh(k * 0.3) / std::sinh(k * 0.5);
  EXPECT_NEAR(wave->velocity({0, 0, z}, 0).y(), 0.01 * omega * ratio, 1e-12);
  EXPECT_NEAR(wave->velocity({0, 0, z}, -0.25).z(),
              0.01 * omega * std::sinh(k * 0.3) / std::sinh(k * 0.5), 1e-12);
  EXPECT_NEAR(wave->dynamic_pressure({0, 0, z}, 0),
              9810 * 0.01 * std::cosh(k * 0.3) / std::cosh(k * 0.5), 1e-9);
  EXPECT_NEAR(wave->pressure({0, 0, 0.01}, 0), 0, 1e-9);
}

TEST(Airy, ZeroTransportIsTheSecondOrderReturnCurrent) {
  RegularWaveSpec spec;
  spec.theory = RegularWaveSpec::Theory::airy;
  spec.height = 0.02;
  spec.period = 1;
  spec.depth = 0.5;
  const auto wave = make_wave(spec);
  EXPECT_NEAR(wave->mean_eulerian_velocity(), -9.81 * 4e-4 / (8 * wave->celerity() * 0.5), 1e-12);
  EXPECT_DOUBLE_EQ(wave->mean_transport(), 0);
}

TEST(Airy, RefusesWavesBeyondBreaking) {
  RegularWaveSpec spec;
  spec.theory = RegularWaveSpec::Theory::airy;
  spec.height = 0.4;
  spec.length = 2;
  spec.depth = 0.5;
  EXPECT_THROW(make_wave(spec), Error);
}

}  // namespace
}  // namespace seaway::waves
