// How long the waves take in the relaxation zones' use: columns of 8 heights, as a block has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/waves/linear_sea.hpp"
#include "core/waves/water_fraction.hpp"
#include "core/waves/wave_field.hpp"

namespace seaway::waves {
namespace {

template <class Work>
double nanoseconds(int count, Work&& work) {
  double best = 1e30;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count() / count);
  }
  return best;
}

void measure(const char* name, const std::unique_ptr<const WaveField>& wave, double limit) {
  const double height = wave->height();
  constexpr int n_columns = 2500, n_z = 8;
  std::array<double, n_z> z;
  std::array<Vec3, n_z> v;
  double sum = 0;
  const auto columns = [&](double bottom) {
    return nanoseconds(n_columns * n_z, [&] {
      for (int i = 0; i < n_columns; ++i) {
        for (int k = 0; k < n_z; ++k) z[k] = bottom + 0.01 * k + 1e-6 * i;
        wave->column_velocity(0, 0.002 * i, 0.3, z, v);
        sum += v[3].y();
      }
    });
  };
  const double water = columns(-0.12), air = columns(height);
  const double point = nanoseconds(20000, [&] {
    for (int i = 0; i < 20000; ++i) sum += wave->velocity({0, 0.001 * i, -0.05}, 0.2).z();
  });
  const double eta = nanoseconds(20000, [&] {
    for (int i = 0; i < 20000; ++i) sum += wave->elevation(0, 0.001 * i, 0.2);
  });
  const double cell = nanoseconds(20000, [&] {
    for (int i = 0; i < 20000; ++i) {
      sum += water_fraction<2>(*wave, Vec2(0.001 * i, -0.01), Vec2(0.001 * i + 0.02, 0.01), 0.2);
    }
  });
  std::printf(
      "%s: column %.1f ns (air %.1f), point %.1f, elevation %.1f, cell at the surface %.0f\n", name,
      water, air, point, eta, cell);
  EXPECT_TRUE(std::isfinite(sum));
  EXPECT_LT(water, limit);
}

std::unique_ptr<const WaveField> regular(double height, double period, double depth) {
  RegularWaveSpec spec;
  spec.height = height;
  spec.period = period;
  spec.depth = depth;
  return make_wave(spec);
}

std::unique_ptr<const WaveField> irregular(int n) {
  SpectrumSpec spectrum;
  spectrum.peak_period = 1.4;
  spectrum.significant_height = 0.061;
  spectrum.n_components = n;
  LinearSeaSpec sea;
  sea.components = make_components(spectrum, 1);
  sea.peak_period = 1.4;
  sea.height = 0.061;
  sea.depth = 2.79;
  return make_linear_sea(sea);
}

TEST(WaveSpeed, ColumnsOfEightHeights) {
  // Limits are twice what one core of 2020 needs, for machines that are busy.
  measure("example wave", regular(0.061, 1.4, 2.79), 120);
  measure("steep wave in shallow water", regular(0.1, 1.2, 0.4), 200);
  measure("sea of 100 waves", irregular(100), 600);
}

}  // namespace
}  // namespace seaway::waves
