#include "core/waves/linear_sea.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/base/error.hpp"
#include "core/waves/airy.hpp"
#include "core/waves/vector_math.hpp"

namespace seaway::waves {
namespace {

constexpr double depth = 2.79, gravity = 9.81;

LinearSeaSpec jonswap(std::uint64_t seed = 1) {
  SpectrumSpec s;
  s.peak_period = 1.4;
  s.significant_height = 0.06;
  LinearSeaSpec sea;
  sea.components = make_components(s, seed);
  sea.peak_period = 1.4;
  sea.height = 0.06;
  sea.depth = depth;
  return sea;
}

TEST(VectorMath, AgreesWithTheLibrary) {
  for (double x = -5000; x < 5000; x += 0.737) {
    double c = 0, s = 0;
    cos_sin(x, c, s);
    EXPECT_NEAR(c, std::cos(x), 5e-16 * std::max(1.0, std::abs(x) * 1e-3));
    EXPECT_NEAR(s, std::sin(x), 5e-16 * std::max(1.0, std::abs(x) * 1e-3));
  }
  for (double x = -690; x < 690; x += 0.173) EXPECT_NEAR(exponential(x) / std::exp(x), 1, 2e-15) << x;
  EXPECT_EQ(exponential(0), 1);
  EXPECT_LT(exponential(-1e6), 1e-300);
}

TEST(LinearSea, IsTheSumOfAiryWaves) {
  const LinearSeaSpec spec = jonswap();
  const auto sea = make_linear_sea(spec);
  const double t = 3.7, y = 1.3, z = -0.21;
  double eta = 0, v = 0, w = 0;
  for (const Component& c : spec.components) {
    const double omega = 2 * pi * c.frequency, k = linear_wave_number(omega, depth, gravity), theta = k * y - omega * t - c.phase;
    eta += c.amplitude * std::cos(theta);
    v += c.amplitude * omega * std::cosh(k * (depth + z)) / std::sinh(k * depth) * std::cos(theta);
    w += c.amplitude * omega * std::sinh(k * (depth + z)) / std::sinh(k * depth) * std::sin(theta);
  }
  EXPECT_NEAR(sea->elevation(0, y, t), eta, 1e-14);
  const Vec3 u = sea->velocity({0, y, z}, t);
  EXPECT_NEAR(u.y(), v + sea->mean_eulerian_velocity(), 1e-13);
  EXPECT_NEAR(u.z(), w, 1e-13);
  EXPECT_NEAR(u.x(), 0, 1e-16);
}

TEST(LinearSea, ColumnsAgreeWithPointsBelowAndAboveTheSurface) {
  const auto sea = make_linear_sea(jonswap(3));
  std::array<double, 17> z;
  std::array<Vec3, 17> column;
  for (const double bottom : {-0.9, -0.08, 0.02, -2.78}) {
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = bottom + 0.01 * static_cast<double>(i);
    sea->column_velocity(0.3, -2.1, 11.3, z, column);
    for (std::size_t i = 0; i < z.size(); ++i)
      EXPECT_LT((column[i] - sea->velocity({0.3, -2.1, z[i]}, 11.3)).norm(), 1e-14) << z[i];
  }
}

TEST(LinearSea, VelocityIsSolenoidalContinuousAndDiesOutUpwards) {
  const auto sea = make_linear_sea(jonswap());
  const double h = 1e-5, t = 2.2;
  for (const double z : {-0.5, -0.01, 0.01, 0.03, 0.06, 0.2}) {
    const double dv = sea->velocity({0, 0.7 + h, z}, t).y() - sea->velocity({0, 0.7 - h, z}, t).y();
    const double dw = sea->velocity({0, 0.7, z + h}, t).z() - sea->velocity({0, 0.7, z - h}, t).z();
    EXPECT_NEAR(dv + dw, 0, 1e-5 * (std::abs(dv) + std::abs(dw)) + 1e-10) << z;
  }
  EXPECT_LT((sea->velocity({0, 0.7, 8}, t) - Vec3(0, sea->mean_eulerian_velocity(), 0)).norm(), 1e-4);
  EXPECT_NEAR(sea->velocity({0, 0.7, -depth}, t).z(), 0, 1e-18);
}

TEST(LinearSea, ZeroTransportTakesTheStokesDriftBack) {
  LinearSeaSpec spec = jonswap();
  const auto still = make_linear_sea(spec);
  spec.mean_flow = RegularWaveSpec::MeanFlow::zero_eulerian;
  const auto drifting = make_linear_sea(spec);
  EXPECT_EQ(still->mean_transport(), 0);
  EXPECT_EQ(drifting->mean_eulerian_velocity(), 0);
  EXPECT_NEAR(drifting->mean_transport(), -still->mean_eulerian_velocity() * depth, 1e-15);
  // To second order the drift is the mean of elevation times velocity at the surface.
  double flux = 0;
  constexpr int n = 40000;
  for (int i = 0; i < n; ++i) {
    const double t = 0.171 * i;
    flux += drifting->elevation(0, 0, t) * drifting->velocity({0, 0, 0}, t).y() / n;
  }
  EXPECT_NEAR(drifting->mean_transport(), flux, 0.03 * flux);
}

TEST(LinearSea, LongRunsHaveTheHeightOfTheComponents) {
  const LinearSeaSpec spec = jonswap();
  const auto sea = make_linear_sea(spec);
  double square = 0, highest = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double eta = sea->elevation(0, 0, 0.137 * i);
    square += eta * eta / n;
    highest = std::max(highest, std::abs(eta));
  }
  EXPECT_NEAR(4 * std::sqrt(square), statistics(spec.components).significant_height, 0.01 * 0.06);
  EXPECT_LT(highest, sea->crest());
}

TEST(LinearSea, ReflectedHeadingAndGridGiveTheSameSea) {
  LinearSeaSpec spec = jonswap();
  const auto port = make_linear_sea(spec);
  spec.heading = -pi / 2;
  const auto starboard = make_linear_sea(spec);
  EXPECT_NEAR(port->elevation(5, 1.3, 2), starboard->elevation(-7, -1.3, 2), 1e-14);
  for (const double heading : {pi / 2, 0.0, 0.7}) {
    spec.heading = heading;
    const auto sea = make_linear_sea(spec);
    std::array<double, 12> grid;
    sea->elevation_grid({0.1, 0.2, 0.03, 0.04, 4, 3}, 1.9, grid);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(grid[static_cast<std::size_t>(4 * j + i)], sea->elevation(0.1 + 0.03 * i, 0.2 + 0.04 * j, 1.9), 1e-15);
  }
}

TEST(Focus, AllCrestsMeetAtTheFocus) {
  LinearSeaSpec spec = jonswap();
  spec.components = focus(spec.components, 0.05, 2.5, 8, depth, gravity);
  spec.bounded_by_sum = true;
  spec.height = 0.1;
  const auto sea = make_linear_sea(spec);
  EXPECT_NEAR(sea->elevation(0, 2.5, 8), 0.05, 1e-14);
  EXPECT_NEAR(sea->crest(), 0.05, 1e-14);
  for (double t = 0; t < 16; t += 0.05) EXPECT_LE(sea->elevation(0, 2.5, t), 0.05 + 1e-15);
  spec.components = focus(spec.components, -0.05, 2.5, 8, depth, gravity);
  EXPECT_NEAR(make_linear_sea(spec)->elevation(0, 2.5, 8), -0.05, 1e-14);
}

TEST(Series, GivesBackWhatWasMeasured) {
  const double step = 0.05, place = 1.7, start = 3;
  constexpr int n = 600;  // 30 s: both waves are whole
  std::vector<double> measured;
  for (int i = 0; i < n; ++i)
    measured.push_back(0.02 * std::cos(2 * pi * 0.8 * step * i - 0.4) + 0.01 * std::cos(2 * pi * 1.1 * step * i + 2) + 0.003);
  LinearSeaSpec spec;
  spec.components = components_of_series(measured, step, start, 0.2, 3, place, depth, gravity);
  spec.peak_period = 1.25;
  spec.height = 0.06;
  spec.depth = depth;
  const auto sea = make_linear_sea(spec);
  for (int i = 0; i < n; i += 37) EXPECT_NEAR(sea->elevation(0, place, start + step * i), measured[static_cast<std::size_t>(i)] - 0.003, 1e-12);
  EXPECT_THROW(components_of_series(measured, step, 0, 0.2, 11, 0, depth, gravity), Error) << "not resolved";
  EXPECT_THROW(components_of_series({1, 2}, step, 0, 0.2, 3, 0, depth, gravity), Error);
}

TEST(LinearSea, RefusesSeasThatBreak) {
  LinearSeaSpec spec = jonswap();
  spec.height = 0.3;
  EXPECT_THROW(make_linear_sea(spec), Error);
  spec = jonswap();
  spec.components.clear();
  EXPECT_THROW(make_linear_sea(spec), Error);
}

}  // namespace
}  // namespace seaway::waves
