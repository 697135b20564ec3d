#include "core/transfer/prbf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/error.hpp"
#include "tests/unit/core/transfer/filter_law.hpp"

namespace seaway::transfer {
namespace {

template <int Dim>
std::vector<Vec<Dim>> random_points(int n, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec<Dim>> x(static_cast<std::size_t>(n));
  for (auto& p : x)
    for (int a = 0; a < Dim; ++a) p[a] = 3 + 2 * uniform(rng);
  return x;
}

/// A linear field and a curved one.
template <int Dim>
Eigen::MatrixXd two_fields(const std::vector<Vec<Dim>>& x) {
  Eigen::MatrixXd f(static_cast<Eigen::Index>(x.size()), 2);
  for (std::size_t i = 0; i < x.size(); ++i) {
    f(static_cast<Eigen::Index>(i), 0) = 2 + x[i][0] - 3 * x[i][Dim - 1];
    f(static_cast<Eigen::Index>(i), 1) = std::sin(x[i][0]) * std::cos(x[i][1]);
  }
  return f;
}

class PrbfKernel : public ::testing::TestWithParam<Kernel> {};

TEST_P(PrbfKernel, OneSubsetPassesThroughItsPoints) {
  const auto points = random_points<3>(300, 1);
  PrbfOptions options;
  options.k = 1;
  options.kernel = GetParam();
  PrbfReport report;
  const Eigen::MatrixXd f = two_fields<3>(points);
  const Eigen::MatrixXd s = prbf_interpolate<3>(options, points, f, points, 1, &report);
  EXPECT_LT((s - f).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(report.indefinite, 0);
  EXPECT_EQ(report.degenerate, 0);
}

TEST_P(PrbfKernel, TheAverageReproducesLinearFields) {
  const auto points = random_points<2>(800, 2), targets = random_points<2>(100, 3);
  PrbfOptions options;
  options.k = 20;
  options.kernel = GetParam();
  const Eigen::MatrixXd s = prbf_interpolate<2>(options, points, two_fields<2>(points), targets);
  EXPECT_LT((s - two_fields<2>(targets)).col(0).cwiseAbs().maxCoeff(), 1e-9);
}
INSTANTIATE_TEST_SUITE_P(All, PrbfKernel,
                         ::testing::Values(Kernel::r, Kernel::r3, Kernel::thin_plate, Kernel::multiquadric,
                                         Kernel::gaussian, Kernel::wendland_c2));

void check_filter(Kernel kernel, int beta) {
  for (const auto& mode : testing::filter_modes(kernel, beta))
    EXPECT_NEAR(mode.amplitude, mode.law, 0.02) << mode.cells << " cells a wavelength";
}
TEST(Prbf, CubicFollowsTheFilterLaw) { check_filter(Kernel::r3, 3); }
TEST(Prbf, LinearKernelFollowsTheFilterLaw) { check_filter(Kernel::r, 1); }

TEST(Prbf, ThreadsChangeNoBit) {
  const auto points = random_points<2>(900, 4), targets = random_points<2>(333, 5);
  PrbfOptions options;
  options.k = 7;
  options.ordering = Ordering::shuffle;
  const Eigen::MatrixXd f = two_fields<2>(points);
  const Eigen::MatrixXd one = prbf_interpolate<2>(options, points, f, targets, 1);
  for (const int threads : {2, 4}) EXPECT_EQ(one, prbf_interpolate<2>(options, points, f, targets, threads));
}

TEST(Prbf, AnyOrderingKeepsResolvedFields) {
  const auto points = random_points<2>(2000, 6), targets = random_points<2>(200, 7);
  const Eigen::MatrixXd f = two_fields<2>(points), exact = two_fields<2>(targets);
  for (const Ordering ordering : {Ordering::as_is, Ordering::morton, Ordering::shuffle}) {
    PrbfOptions options;
    options.k = 8;
    options.ordering = ordering;
    const Eigen::MatrixXd s = prbf_interpolate<2>(options, points, f, targets);
    EXPECT_LT((s - exact).col(1).norm() / exact.col(1).norm(), 0.01);
  }
}

TEST(Prbf, PointsOnALineAreSolvedOnIt) {  // a stride that picks one column of a lattice
  std::vector<Vec2> points;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 8; ++i) points.emplace_back(i, j);
  PrbfOptions options;
  options.k = 8;
  PrbfReport report;
  const Eigen::MatrixXd s = prbf_interpolate<2>(options, points, two_fields<2>(points), points, 1, &report);
  EXPECT_EQ(report.degenerate, 8);
  EXPECT_TRUE(s.allFinite());
}

TEST(Prbf, RefusesWhatDoesNotFit) {
  const auto points = random_points<2>(400, 8);
  const Eigen::MatrixXd f = two_fields<2>(points);
  PrbfOptions options;
  options.k = 2;
  options.memory_limit = 1e5;
  try {
    prbf_interpolate<2>(options, points, f, points);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::resource_exhausted);
  }
  options = {};
  options.k = 300;  // one point a subset
  EXPECT_THROW(prbf_interpolate<2>(options, points, f, points), Error);
  options = {};
  options.k = 4;
  options.tail_degree = 0;  // too low for r^3
  EXPECT_THROW(prbf_interpolate<2>(options, points, f, points), Error);
}

}  // namespace
}  // namespace seaway::transfer
