#include "core/transfer/prbf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

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

class PrbfKernel : public testing::TestWithParam<Kernel> {};

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
                         testing::Values(Kernel::r, Kernel::r3, Kernel::thin_plate, Kernel::multiquadric,
                                         Kernel::gaussian, Kernel::wendland_c2));

/// The points of an edge^3 lattice so that every b^3-th of them is one shifted sublattice.
std::vector<Vec3> lattice_by_sublattices(int edge, int b) {
  std::vector<Vec3> x;
  const int m = edge / b;
  for (int kk = 0; kk < m; ++kk)
    for (int jj = 0; jj < m; ++jj)
      for (int ii = 0; ii < m; ++ii)
        for (int k = 0; k < b; ++k)
          for (int j = 0; j < b; ++j)
            for (int i = 0; i < b; ++i) x.emplace_back(ii * b + i, jj * b + j, kk * b + k);
  return x;
}

/// Amplitudes of plane waves after the average of 125 sublattices of a 40^3 lattice, at points in its middle.
std::vector<double> amplitudes(Kernel kernel, const std::vector<Vec3>& waves) {
  const std::vector<Vec3> points = lattice_by_sublattices(40, 5);
  std::vector<Vec3> targets;
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> middle(14, 25);
  for (int t = 0; t < 256; ++t) targets.emplace_back(middle(rng), middle(rng), middle(rng));
  const auto fields = [&](const std::vector<Vec3>& x) {
    Eigen::MatrixXd f(static_cast<Eigen::Index>(x.size()), static_cast<Eigen::Index>(2 * waves.size()));
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t w = 0; w < waves.size(); ++w) {
        f(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(2 * w)) = std::cos(waves[w].dot(x[i]));
        f(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(2 * w + 1)) = std::sin(waves[w].dot(x[i]));
      }
    return f;
  };
  PrbfOptions options;
  options.k = 125;
  options.kernel = kernel;
  const Eigen::MatrixXd s = prbf_interpolate<3>(options, points, fields(points), targets);
  const Eigen::MatrixXd exact = fields(targets);
  std::vector<double> out;
  for (Eigen::Index w = 0; w < exact.cols(); w += 2)
    out.push_back(s.middleCols(w, 2).cwiseProduct(exact.middleCols(w, 2)).sum() /
                  static_cast<double>(targets.size()));
  return out;
}

void check_filter(Kernel kernel, int beta) {
  const Vec3 direction = Vec3(1, 0.6, 0.35).normalized();
  std::vector<Vec3> waves;
  for (const double cells : {4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 40.0})
    waves.push_back(direction * (2 * pi / cells));
  const std::vector<double> found = amplitudes(kernel, waves);
  for (std::size_t w = 0; w < waves.size(); ++w)
    EXPECT_NEAR(found[w], prbf_filter(waves[w], 5, beta), 0.02) << 2 * pi / waves[w].norm() << " cells";
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
