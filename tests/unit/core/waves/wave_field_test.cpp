#include "core/waves/wave_field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.hpp"

namespace seaway::waves {
namespace {

RegularWaveSpec section_wave(RegularWaveSpec::Theory theory) {
  RegularWaveSpec spec;
  spec.theory = theory;
  spec.height = 0.061;
  spec.period = 1.4;
  spec.depth = 2.79;
  return spec;
}

constexpr RegularWaveSpec::Theory theories[] = {RegularWaveSpec::Theory::stream_function,
                                                RegularWaveSpec::Theory::airy};

TEST(WaveField, TravelsAlongItsHeadingWithCelerity) {
  for (const double heading : {0.0, 0.7, pi / 2, pi, -1.2}) {
    RegularWaveSpec spec = section_wave(theories[0]);
    spec.heading = heading;
    const auto wave = make_wave(spec);
    const double t = 0.37, s = wave->celerity() * t;
    EXPECT_NEAR(wave->elevation(s * std::cos(heading), s * std::sin(heading), t), wave->crest(),
                1e-12);
    EXPECT_NEAR(wave->elevation(0.3, 0.2, 0.1), wave->elevation(0.3, 0.2, 0.1 + wave->period()),
                1e-12);
    // Water under the crest moves with the wave.
    const Vec3 u = wave->velocity({0, 0, 0}, 0);
    EXPECT_NEAR(std::atan2(u.y(), u.x()), heading > pi - 1e-9 ? pi : heading, 1e-9);
    EXPECT_GT(u.norm(), 0.1);
  }
}

TEST(WaveField, PositivePhaseLeads) {
  RegularWaveSpec spec = section_wave(theories[0]);
  spec.phase = 0.4;
  const auto wave = make_wave(spec);
  EXPECT_NEAR(wave->elevation(0, 0, -0.4 * wave->period() / (2 * pi)), wave->crest(), 1e-12);
}

TEST(WaveField, VelocityIsSolenoidalAndContinuousEverywhere) {
  for (const auto theory : theories) {
    const auto wave = make_wave(section_wave(theory));
    const double d = 1e-4, t = 0.21,
                 rate = wave->height() * std::pow(2 * pi / wave->period(), 1) * 3;
    for (double z = -2.7; z < 1.0; z += 0.0371) {
      for (double y = 0; y < wave->length(); y += 0.31) {
        const double div =
            (wave->velocity({0, y + d, z}, t).y() - wave->velocity({0, y - d, z}, t).y() +
             wave->velocity({0, y, z + d}, t).z() - wave->velocity({0, y, z - d}, t).z()) /
            (2 * d);
        EXPECT_NEAR(div, 0, 1e-4 * rate)
            << z;  // difference across the crest level is of first order
        const Vec3 jump = wave->velocity({0, y, z + 1e-7}, t) - wave->velocity({0, y, z - 1e-7}, t);
        EXPECT_LT(jump.norm(), 1e-5 * rate);
      }
    }
    const double top = wave->crest();
    const Vec3 jump = wave->velocity({0, 0.4, top + 1e-9}, t) - wave->velocity({0, 0.4, top}, t);
    EXPECT_LT(jump.norm(), 1e-7 * rate);
  }
}

TEST(WaveField, VelocityDiesOutHighAboveAndVanishesVerticallyAtTheBed) {
  for (const auto theory : theories) {
    const auto wave = make_wave(section_wave(theory));
    EXPECT_NEAR(wave->velocity({0, 0.3, 20}, 0.1).y(), wave->mean_eulerian_velocity(), 1e-12);
    EXPECT_EQ(wave->velocity({0, 0.3, -2.79}, 0.1).z(), 0);
    EXPECT_EQ(wave->velocity({0, 0.3, -5}, 0.1), wave->velocity({0, 0.3, -2.79}, 0.1));
    double largest = 0;
    for (double z = 0; z < 5; z += 0.01) {
      largest = std::max(largest, wave->velocity({0, 0.05, z}, 0).norm());
    }
    EXPECT_LT(largest, 2 * wave->height() * pi / wave->period());
  }
}

TEST(WaveField, ColumnsEqualPoints) {
  for (const auto theory : theories) {
    RegularWaveSpec spec = section_wave(theory);
    spec.heading = 0.3;
    const auto wave = make_wave(spec);
    const std::vector<double> z{-3, -2.79, -1, -0.1, 0, 0.02, wave->crest(), 0.05, 0.5};
    std::vector<Vec3> v(z.size());
    wave->column_velocity(0.4, -0.2, 0.33, z, v);
    for (std::size_t i = 0; i < z.size(); ++i) {
      EXPECT_EQ(v[i], wave->velocity({0.4, -0.2, z[i]}, 0.33));
    }
  }
}

TEST(WaveField, PressureGradientBalancesAcceleration) {
  const auto wave = make_wave(section_wave(theories[0]));
  const double d = 1e-4, y = 0.35, z = -0.08, t = 0.2;
  const auto u = [&](double yy, double zz, double tt) { return wave->velocity({0, yy, zz}, tt); };
  const Vec3 here = u(y, z, t);
  const Vec3 acceleration = (u(y, z, t + d) - u(y, z, t - d)) / (2 * d) +
                            here.y() * (u(y + d, z, t) - u(y - d, z, t)) / (2 * d) +
                            here.z() * (u(y, z + d, t) - u(y, z - d, t)) / (2 * d);
  const auto p = [&](double yy, double zz) { return wave->pressure({0, yy, zz}, t); };
  EXPECT_NEAR(acceleration.y(), -(p(y + d, z) - p(y - d, z)) / (2 * d) / 1000, 1e-6);
  EXPECT_NEAR(acceleration.z(), -(p(y, z + d) - p(y, z - d)) / (2 * d) / 1000 - 9.81, 1e-6);
}

TEST(WaveField, BoundsHold) {
  const auto wave = make_wave(section_wave(theories[0]));
  double slope = 0;
  for (int i = 0; i < 500; ++i) {
    const double y = wave->length() * i / 500;
    const double eta = wave->elevation(0, y, 0);
    EXPECT_LE(eta, wave->crest() + 1e-12);
    EXPECT_GE(eta, wave->trough() - 1e-12);
    slope = std::max(slope, std::abs(wave->elevation(0, y + 1e-5, 0) - eta) / 1e-5);
  }
  EXPECT_LE(slope, wave->max_slope());
  EXPECT_NEAR(wave->crest() - wave->trough(), 0.061, 1e-12);
}

TEST(WaveField, RefusesNonsense) {
  const auto message = [](auto change) -> std::string {
    RegularWaveSpec spec = section_wave(theories[0]);
    change(spec);
    try {
      make_wave(spec);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::invalid_argument);
      return e.what();
    }
    return "accepted";
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(message([](auto& s) { s.height = 0; }), HasSubstr("wave height is 0"));
  EXPECT_THAT(message([](auto& s) { s.height = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("wave height is nan"));
  EXPECT_THAT(message([](auto& s) { s.depth = -1; }), HasSubstr("wave depth is -1"));
  EXPECT_THAT(message([](auto& s) { s.length = 3; }), HasSubstr("exactly one"));
  EXPECT_THAT(message([](auto& s) { s.period = 0; }), HasSubstr("exactly one"));
  EXPECT_THAT(message([](auto& s) { s.period = std::numeric_limits<double>::infinity(); }),
              HasSubstr("wave period is inf"));
}

TEST(WaveField, RefusesLengthsOutOfAllProportionToTheDepth) {
  using Theory = RegularWaveSpec::Theory;
  for (const Theory theory : {Theory::airy, Theory::stokes_5, Theory::stream_function}) {
    for (const double size : {1e-200, 1e120, 1e200}) {
      for (const bool by_length : {true, false}) {
        RegularWaveSpec spec;
        spec.theory = theory;
        spec.height = 1e-3;
        spec.depth = 1;
        (by_length ? spec.length : spec.period) = size;
        EXPECT_THROW(make_wave(spec), Error) << size << (by_length ? " m" : " s");
      }
    }
  }
}

}  // namespace
}  // namespace seaway::waves
