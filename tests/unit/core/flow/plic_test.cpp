#include "core/flow/plic.hpp"

#include <gtest/gtest.h>

#include <random>

namespace seaway::flow {
namespace {

template <int Dim>
std::array<double, Dim> random_normal(std::mt19937& rng) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::array<double, Dim> n{};
  double sum = 0;
  for (double& x : n) sum += std::abs(x = uniform(rng));
  for (double& x : n) x /= sum;
  return n;
}

template <int Dim>
void check_inverse() {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    auto n = random_normal<Dim>(rng);
    if (trial % 5 == 0) n[0] = 0;
    if (trial % 7 == 0) n[Dim - 1] *= 1e-9;
    const double vof = uniform(rng);
    EXPECT_NEAR(plane_fraction<Dim>(n, plane_constant<Dim>(n, vof)), vof, 3e-13);
  }
}
TEST(Plic, ConstantIsTheInverseOfTheFractionIn2D) { check_inverse<2>(); }
TEST(Plic, ConstantIsTheInverseOfTheFractionIn3D) { check_inverse<3>(); }

template <int Dim>
void check_children() {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    Plane<Dim> plane{random_normal<Dim>(rng), 0};
    const double vof = uniform(rng);
    plane.d = plane_constant<Dim>(plane.normal, vof);
    double sum = 0;
    for (int c = 0; c < (1 << Dim); ++c) {
      const auto child = child_plane<Dim>(plane, c);
      sum += plane_fraction<Dim>(child.normal, child.d);
    }
    EXPECT_NEAR(sum / (1 << Dim), vof, 1e-12);
  }
}
TEST(Plic, ChildrenShareTheParentsWaterIn2D) { check_children<2>(); }
TEST(Plic, ChildrenShareTheParentsWaterIn3D) { check_children<3>(); }

template <int Dim>
void check_normal() {  // exact fractions of a plane with a small slope: centred columns are exact
  std::array<double, Dim> n{};
  double sum = 0;
  for (std::size_t a = 0; a < Dim; ++a) sum += n[a] = a + 1 == Dim ? 1.0 : 0.2 / (1.0 + static_cast<double>(a));
  for (double& x : n) x /= sum;
  const double d = 0.5 * sum / sum;
  double stencil[27];
  int e = 0;
  for (int k = Dim == 2 ? 0 : -1; k <= (Dim == 2 ? 0 : 1); ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        double shifted = d - n[0] * i - n[1] * j;
        if constexpr (Dim == 3) shifted -= n[2] * k;
        stencil[e++] = plane_fraction<Dim>(n, shifted);
      }
  const auto found = interface_normal<Dim>(stencil);
  for (std::size_t a = 0; a < Dim; ++a) EXPECT_NEAR(found[a], n[a], 1e-12);
}
TEST(Plic, NormalOfAGentlePlaneIsExactIn2D) { check_normal<2>(); }
TEST(Plic, NormalOfAGentlePlaneIsExactIn3D) { check_normal<3>(); }

TEST(Plic, SweptWaterOfBothHalvesIsTheCellsWater) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 500; ++trial) {
    Plane<2> plane{random_normal<2>(rng), 0};
    const double vof = 0.01 + 0.98 * uniform(rng), c = uniform(rng);
    plane.d = plane_constant<2>(plane.normal, vof);
    const double out = swept_water<2>(plane, vof, 0, c) - swept_water<2>(plane, vof, 0, c - 1);
    EXPECT_NEAR(out, vof, 1e-12);
  }
}

}  // namespace
}  // namespace seaway::flow
