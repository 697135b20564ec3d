#include "core/field/restrict.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/field/gather.hpp"
#include "tests/unit/core/field/meshes.hpp"

namespace seaway::field {
namespace {

using namespace testing;

template <int Dim>
double sum_of(const double* values, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += values[i];
  return sum;
}

template <int Dim>
void check_means() {
  const auto forest = small_forest<Dim>(0.2, 1.2, 3);
  CellField<double, Dim> f(forest);
  fill_cells<Dim>(
      forest, [](const Vec<Dim>& x) { return noise<Dim>(x); }, f);
  const CellField<double, Dim> before = f;
  restrict_cells(forest, f);
  for (const int b : forest.leaves())
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) EXPECT_EQ(f.block(b)[i], before.block(b)[i]);
  EXPECT_FALSE(forest.interface_parents().empty());
  for (const int b : forest.interface_parents()) {
    const Block<Dim>& parent = forest.block(b);
    // Conserved: the parent's content is its children's.
    double children = 0;
    for (const int c : parent.child)
      children += sum_of<Dim>(f.block(c), BlockShape<Dim>::cells) * forest.block(c).cell_volume();
    EXPECT_NEAR(sum_of<Dim>(f.block(b), BlockShape<Dim>::cells) * parent.cell_volume(), children,
                1e-13);
    // And each cell is the mean of the cells in it.
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      double mean = 0;
      for (int s = 0; s < BlockShape<Dim>::children; ++s) {
        IVec<Dim> fine{};
        int child = 0;
        for (int a = 0; a < Dim; ++a) {
          fine[a] = 2 * i[a] + ((s >> a) & 1);
          child |= (fine[a] >= BlockShape<Dim>::n) << a;
          fine[a] %= BlockShape<Dim>::n;
        }
        mean += f.block(
            parent.child[static_cast<std::size_t>(child)])[offset<Dim>(fine, cell_strides<Dim>())];
      }
      EXPECT_NEAR(f.block(b)[offset<Dim>(i, cell_strides<Dim>())], mean / BlockShape<Dim>::children,
                  1e-15);
    });
  }
}
TEST(Restrict, ParentsHoldTheMeansOfTheirChildrenIn2D) { check_means<2>(); }
TEST(Restrict, ParentsHoldTheMeansOfTheirChildrenIn3D) { check_means<3>(); }

/// What leaves a coarse leaf through a face enters the fine leaves behind it.
template <int Dim>
void check_fluxes(bool periodic) {
  const auto forest = small_forest<Dim>(0.2, 1.2, 3, periodic);
  FaceField<double, Dim> f(forest);
  for (int axis = 0; axis < Dim; ++axis)
    fill_faces<Dim>(
        forest, [](const Vec<Dim>& x) { return noise<Dim>(x); }, axis, f);
  restrict_faces(forest, f);
  constexpr int n = BlockShape<Dim>::n;
  for (const mesh::CoarseFace& face : forest.coarse_faces()) {
    const auto strides = face_strides<Dim>(face.axis);
    IVec<Dim> lower = filled<Dim>(0), upper = cells_upper<Dim>();
    const auto along = static_cast<std::size_t>(face.axis);
    lower[along] = face.side * n;
    upper[along] = lower[along] + 1;
    for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
      double mean = 0;
      for (int s = 0; s < BlockShape<Dim>::children; ++s) {
        if ((s >> face.axis) & 1) continue;
        IVec<Dim> fine{};
        int child = 0;
        for (int a = 0; a < Dim; ++a) {
          if (a == face.axis) {  // the neighbour's side towards the leaf
            fine[a] = face.side == 1 ? 0 : n;
            child |= (face.side == 1 ? 0 : 1) << a;
          } else {
            fine[a] = 2 * i[a] + ((s >> a) & 1);
            child |= (fine[a] >= n) << a;
            fine[a] %= n;
          }
        }
        const int block = forest.block(face.parent).child[static_cast<std::size_t>(child)];
        ASSERT_TRUE(forest.block(block).leaf);
        mean += f.block(face.axis, block)[offset<Dim>(fine, strides)];
      }
      EXPECT_NEAR(f.block(face.axis, face.leaf)[offset<Dim>(i, strides)],
                  mean * 2 / BlockShape<Dim>::children, 1e-15);
    });
  }
}
TEST(Restrict, CoarseFacesHoldTheMeansOfTheFineOnesIn2D) { check_fluxes<2>(false); }
TEST(Restrict, CoarseFacesHoldTheMeansOfTheFineOnesIn3D) { check_fluxes<3>(false); }
TEST(Restrict, AlsoAcrossPeriodicSidesIn2D) { check_fluxes<2>(true); }
TEST(Restrict, AlsoAcrossPeriodicSidesIn3D) { check_fluxes<3>(true); }

TEST(Restrict, TwiceIsOnce) {
  const auto forest = small_forest<2>(0.2, 1.2, 3);
  FaceField<double, 2> f(forest);
  for (int axis = 0; axis < 2; ++axis)
    fill_faces<2>(
        forest, [](const Vec2& x) { return noise<2>(x); }, axis, f);
  restrict_faces(forest, f);
  const FaceField<double, 2> once = f;
  restrict_faces(forest, f);
  for (int axis = 0; axis < 2; ++axis) EXPECT_EQ(f.data(axis), once.data(axis));
}

/// A step of diffusion with everything that runs on threads.
template <int Dim>
void check_threads() {
  std::vector<double> first;
  for (const int threads : {1, 2, 4}) {
    const auto forest = small_forest<Dim>(0.2, 1.2, 3, false, threads);
    CellField<double, Dim> f(forest), g(forest);
    fill_cells<Dim>(
        forest, [](const Vec<Dim>& x) { return noise<Dim>(x); }, f);
    restrict_cells(forest, f);
    forest.for_each_leaf([&](int b) {
      Scratch<double, Dim> s;
      gather_cells(forest, f, b, 2, s);
      for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
        double sum = s(i);
        for (int a = 0; a < Dim; ++a)
          for (const int d : {-2, -1, 1, 2}) {
            IVec<Dim> j = i;
            j[a] += d;
            sum += 0.1 * (s(j) - s(i));
          }
        g.block(b)[offset<Dim>(i, cell_strides<Dim>())] = sum;
      });
    });
    const double total = forest.sum_over_leaves([&](int b) {
      return sum_of<Dim>(g.block(b), BlockShape<Dim>::cells) * forest.block(b).cell_volume();
    });
    std::vector<double> result = g.data();
    result.push_back(total);
    if (first.empty()) first = result;
    EXPECT_EQ(first, result);
  }
}
TEST(Field, ThreadsChangeNoBitIn2D) { check_threads<2>(); }
TEST(Field, ThreadsChangeNoBitIn3D) { check_threads<3>(); }

}  // namespace
}  // namespace seaway::field
