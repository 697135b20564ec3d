#include "core/transfer/split_vof.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/constants.hpp"
#include "core/field/restrict.hpp"
#include "core/transfer/coarsen.hpp"
#include "core/transfer/linear.hpp"
#include "core/transfer/local_rbf.hpp"
#include "tests/unit/core/transfer/meshes.hpp"

namespace seaway::transfer {
namespace {

using namespace testing;

template <int Dim>
void check_random_cells() {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  double stencil[27], children[8];
  for (int trial = 0; trial < 20000; ++trial) {
    for (double& x : stencil) x = trial % 3 == 0 ? std::round(uniform(rng)) : uniform(rng);
    double vof = uniform(rng);
    if (trial % 10 == 0) vof = 1e-8 * vof;
    if (trial % 10 == 1) vof = 1 - 1e-8 * vof;
    if (trial % 10 == 2) vof = std::round(vof);
    stencil[Dim == 2 ? 4 : 13] = vof;
    split_cell<Dim>(vof, stencil, children);
    double sum = 0;
    for (int c = 0; c < (1 << Dim); ++c) {
      EXPECT_GE(children[c], 0);
      EXPECT_LE(children[c], 1);
      sum += children[c];
    }
    EXPECT_NEAR(sum / (1 << Dim), vof, 1e-15);
  }
}
TEST(SplitVof, ChildrenAreBoundedAndShareTheWaterIn2D) { check_random_cells<2>(); }
TEST(SplitVof, ChildrenAreBoundedAndShareTheWaterIn3D) { check_random_cells<3>(); }

/// Rms error of the children of mixed cells on a wave of steepness 0.06, 32 coarse cells a wavelength.
template <int Dim>
std::pair<double, double> wave_error() {
  const auto grid = unit_tank<Dim>(Dim == 2 ? 2 : 4);
  const double length = grid.upper[0];
  const Forest<Dim> from = boxed<Dim>(grid, 0, 0, 0), to = boxed<Dim>(grid, 0, 1, 1);
  const Function<Dim> surface = [=](const Vec<Dim>& x) {
    const double along = Dim == 2 ? x[0] : x[0] + x[1];  // oblique, periods fit the tank
    return 0.513 * length + 0.03 * length * std::cos(2 * pi * along / length);
  };
  CellField<double, Dim> coarse, exact, split(to), interpolated(to);
  fill_water<Dim>(to, surface, exact);
  const MeshPair<Dim> back(to, from), pair(from, to);
  coarse = CellField<double, Dim>(from);
  copy_or_coarsen(to, from, back, exact, coarse);
  split_vof(from, to, pair, coarse, split);
  const auto table = child_cells<Dim>(1, rbf_rule<Dim>({}));
  refine_cells<Dim>(from, to, pair, *table, {Limit::bounds, 0, 1}, coarse, interpolated);
  double error = 0, other = 0;
  int count = 0;
  for (const int b : to.leaves())
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      const double e = exact.block(b)[i];
      if (e <= 0 || e >= 1) continue;
      error += std::pow(split.block(b)[i] - e, 2);
      other += std::pow(interpolated.block(b)[i] - e, 2);
      ++count;
    }
  return {std::sqrt(error / count), std::sqrt(other / count)};
}
TEST(SplitVof, FollowsAWaveMuchCloserThanInterpolationIn2D) {
  const auto [split, interpolated] = wave_error<2>();
  EXPECT_LT(split, 0.01);
  EXPECT_LT(split, interpolated / 10);
}
TEST(SplitVof, FollowsAWaveMuchCloserThanInterpolationIn3D) {
  const auto [split, interpolated] = wave_error<3>();
  EXPECT_LT(split, 0.015);  // the oblique wave is shorter: 23 cells a wavelength
  EXPECT_LT(split, interpolated / 10);
}

}  // namespace
}  // namespace seaway::transfer
