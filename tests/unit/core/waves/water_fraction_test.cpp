#include "core/waves/water_fraction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace seaway::waves {
namespace {

std::unique_ptr<const WaveField> wave_with(double heading) {
  RegularWaveSpec spec;
  spec.height = 0.061;
  spec.period = 1.4;
  spec.depth = 2.79;
  spec.heading = heading;
  return make_wave(spec);
}

TEST(WaterFraction, PlaneVolumeMatchesQuadrature) {
  const auto quadrature = [](double a, double p, double q) {
    constexpr int n = 1000;
    double sum = 0;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        sum += std::max(0.0, a + p * ((i + 0.5) / n - 0.5) + q * ((j + 0.5) / n - 0.5));
      }
    }
    return sum / n / n;
  };
  for (const double a : {-0.6, -0.2, 0.0, 0.13, 0.4}) {
    for (const double p : {-1.0, 0.3, 0.7}) {
      for (const double q : {0.0, 1e-6, 0.2, -0.9}) {
        EXPECT_NEAR(mean_positive_part(a, p, q), quadrature(a, p, q), 2e-6)
            << a << " " << p << " " << q;
      }
    }
  }
}

TEST(WaterFraction, MatchesFineQuadratureInSections) {
  const auto wave = wave_with(pi / 2);
  const double h = 0.02;
  double worst = 0;
  for (double y = 0; y < wave->length(); y += 3 * h) {
    for (double z = -0.06; z < 0.06; z += h) {
      constexpr int n = 4000;
      double exact = 0;
      for (int i = 0; i < n; ++i) {
        const double eta = wave->elevation(0, y + h * (i + 0.5) / n, 0.3);
        exact += std::clamp((eta - z) / h, 0.0, 1.0) / n;
      }
      const double f = water_fraction<2>(*wave, Vec2(y, z), Vec2(y + h, z + h), 0.3);
      worst = std::max(worst, std::abs(f - exact));
    }
  }
  EXPECT_LT(worst, 1e-6);
}

TEST(WaterFraction, ColumnOfCellsHoldsTheWaterUnderTheSurface) {
  const auto wave = wave_with(pi / 2);
  const int n = 64;
  const double h = wave->length() / n;
  double volume = 0;
  for (int j = 0; j < n; ++j) {
    for (int k = -3; k < 3; ++k) {
      volume +=
          h * h * water_fraction<2>(*wave, Vec2(j * h, k * h), Vec2((j + 1) * h, (k + 1) * h), 0.1);
    }
  }
  // Mean level zero: half of the cells' volume. Errors of single cells (1e-6) add up without sign.
  EXPECT_NEAR(volume, 3 * h * wave->length(), 1e-7 * h * wave->length());
}

TEST(WaterFraction, ThreeDimensionalBoxesAgreeWithSectionsAndQuadrature) {
  const auto along_y = wave_with(pi / 2);
  for (double z = -0.05; z < 0.05; z += 0.013) {
    const double f2 = water_fraction<2>(*along_y, Vec2(0.5, z), Vec2(0.52, z + 0.02), 0.2);
    const double f3 =
        water_fraction<3>(*along_y, Vec3(-0.3, 0.5, z), Vec3(-0.28, 0.52, z + 0.02), 0.2);
    EXPECT_NEAR(f2, f3, 2e-6);
  }
  const auto oblique = wave_with(0.6);
  for (double z = -0.05; z < 0.05; z += 0.007) {
    constexpr int n = 400;
    double exact = 0;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const double eta =
            oblique->elevation(0.7 + 0.02 * (i + 0.5) / n, 0.5 + 0.02 * (j + 0.5) / n, 0.2);
        exact += std::clamp((eta - z) / 0.02, 0.0, 1.0) / n / n;
      }
    }
    const double f =
        water_fraction<3>(*oblique, Vec3(0.7, 0.5, z), Vec3(0.72, 0.52, z + 0.02), 0.2);
    EXPECT_NEAR(f, exact, 3e-6) << z;
  }
}

TEST(WaterFraction, IsOneBelowAndZeroAbove) {
  const auto wave = wave_with(pi / 2);
  EXPECT_EQ(water_fraction<2>(*wave, Vec2(0, -0.5), Vec2(0.1, -0.4), 0), 1);
  EXPECT_EQ(water_fraction<2>(*wave, Vec2(0, 0.4), Vec2(0.1, 0.5), 0), 0);
}

}  // namespace
}  // namespace seaway::waves
