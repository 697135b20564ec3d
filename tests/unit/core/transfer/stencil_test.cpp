#include <gtest/gtest.h>

#include "core/transfer/linear.hpp"
#include "core/transfer/local_rbf.hpp"

namespace seaway::transfer {
namespace {

using mesh::BlockShape;

/// Largest error of a polynomial of `degree` at the targets of the stencil at `i`.
template <int Dim>
double polynomial_error(StencilTable<Dim>& table, const std::vector<Vec<Dim>>& targets,
                        const IVec<Dim>& i, const IVec<Dim>& first, const IVec<Dim>& last, int degree) {
  const Eigen::RowVectorXd powers = monomials<Dim>(Vec<Dim>::Zero(), degree);
  Eigen::VectorXd c(powers.size());
  for (Eigen::Index q = 0; q < c.size(); ++q) c[q] = 0.7 + 0.31 * static_cast<double>(q % 5);
  const auto f = [&](const Vec<Dim>& x) {
    const Eigen::RowVectorXd m = monomials<Dim>(x, degree);
    double sum = 0;
    for (Eigen::Index q = 0; q < c.size(); ++q) sum += m[q] * c[q];
    return sum;
  };
  field::Scratch<double, Dim> scratch;
  field::for_box<Dim>(field::filled<Dim>(-2), field::filled<Dim>(BlockShape<Dim>::n + 3),
                      [&](const IVec<Dim>& at) {
    Vec<Dim> x;
    bool inside = true;
    for (int a = 0; a < Dim; ++a) {
      x[a] = at[a] - i[a];
      inside = inside && at[a] >= first[a] && at[a] <= last[a];
    }
    scratch(at) = inside ? f(x) : 1e30;  // must not be read
  });
  const Stencil& s = table.at(i, first, last);
  double error = 0;
  for (int t = 0; t < s.targets; ++t) {
    double sum = 0;
    for (int j = 0; j < s.points; ++j)
      sum += s.weight[static_cast<std::size_t>(t * s.points + j)] *
             (&scratch(i))[s.offset[static_cast<std::size_t>(j)]];
    error = std::max(error, std::abs(sum - f(targets[static_cast<std::size_t>(t)])));
  }
  return error;
}

template <int Dim>
std::vector<Vec<Dim>> children() {
  std::vector<Vec<Dim>> out;
  for (int c = 0; c < BlockShape<Dim>::children; ++c) {
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = (c >> a) & 1 ? 0.25 : -0.25;
    out.push_back(x);
  }
  return out;
}

template <int Dim>
void check_reproduction(int degree, int radius) {
  const auto table = child_cells<Dim>(radius, rbf_rule<Dim>({degree, 6.0}));
  const auto all = field::filled<Dim>(-2), to = field::filled<Dim>(BlockShape<Dim>::n + 1);
  const auto inside = field::filled<Dim>(4);
  EXPECT_LT(polynomial_error<Dim>(*table, children<Dim>(), inside, all, to, degree), 1e-12);
  EXPECT_FALSE(table->at(inside, all, to).fell_back);
  EXPECT_LT(table->at(inside, all, to).lebesgue, 3);
  // In a corner of the tank at least linear functions stay exact.
  const auto corner = field::filled<Dim>(0);
  const bool fell_back = table->at(corner, corner, to).fell_back;
  EXPECT_EQ(fell_back, degree == 2 && radius == 1);
  EXPECT_LT(polynomial_error<Dim>(*table, children<Dim>(), corner, corner, to, fell_back ? 1 : degree),
            1e-12);
}
TEST(LocalRbf, ReproducesPolynomialsOfItsTailIn2D) {
  for (const int degree : {1, 2})
    for (const int radius : {1, 2}) check_reproduction<2>(degree, radius);
}
TEST(LocalRbf, ReproducesPolynomialsOfItsTailIn3D) {
  for (const int degree : {1, 2})
    for (const int radius : {1, 2}) check_reproduction<3>(degree, radius);
}

TEST(LocalRbf, FaceStencilsReproduceQuadratics) {
  const auto all = field::filled<3>(-2), to = field::filled<3>(BlockShape<3>::n + 1);
  const IVec<3> inside{4, 4, 4};
  for (int axis = 0; axis < 3; ++axis) {
    const auto on = faces_on<3>(axis, 1, rbf_rule<3>({2, 6.0}));
    const auto between = faces_between<3>(axis, 1, rbf_rule<3>({2, 6.0}));
    std::vector<Vec<3>> targets_on, targets_between;
    for (auto x : children<3>()) {
      if (x[axis] > 0) continue;
      x[axis] = 0;
      targets_on.push_back(x);
      x[axis] = 0.5;
      targets_between.push_back(x);
    }
    EXPECT_LT(polynomial_error<3>(*on, targets_on, inside, all, to, 2), 1e-12);
    EXPECT_LT(polynomial_error<3>(*between, targets_between, inside, all, to, 2), 1e-12);
  }
}

TEST(LocalRbf, FallsBackWhereThePointsDoNotSpanTheSpace) {
  const std::vector<Vec<2>> line{{-1, 0}, {0, 0}, {1, 0}}, target{{0.25, 0.25}};
  const PointWeights w = rbf_weights<2>(line, target, {});
  EXPECT_TRUE(w.fell_back);
  EXPECT_EQ(w.weight(0, 1), 1.0);  // a copy of the middle value
}

TEST(LocalRbf, LowersTheDegreeWhenWeightsAreTooLarge) {
  const std::vector<Vec<2>> points{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, target{{-9, -9}};
  const PointWeights w = rbf_weights<2>(points, target, {1, 6.0});
  EXPECT_TRUE(w.fell_back);
  EXPECT_LE(w.lebesgue, 6.0);
}

template <int Dim>
void check_linear() {
  const auto table = child_cells<Dim>(1, linear_rule<Dim>());
  const auto all = field::filled<Dim>(-2), to = field::filled<Dim>(BlockShape<Dim>::n + 1);
  const auto inside = field::filled<Dim>(4);
  const Stencil& s = table->at(inside, all, to);
  for (const double w : s.weight) EXPECT_GE(w, 0);
  EXPECT_LT(polynomial_error<Dim>(*table, children<Dim>(), inside, all, to, 1), 1e-14);
  const auto corner = field::filled<Dim>(0);
  EXPECT_LT(polynomial_error<Dim>(*table, children<Dim>(), corner, corner, to, 1), 1e-12);
}
TEST(Linear, IsConvexInsideAndExactForLinearsIn2D) { check_linear<2>(); }
TEST(Linear, IsConvexInsideAndExactForLinearsIn3D) { check_linear<3>(); }

}  // namespace
}  // namespace seaway::transfer
