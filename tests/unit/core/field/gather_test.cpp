#include "core/field/gather.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/field/restrict.hpp"
#include "tests/unit/core/field/meshes.hpp"

namespace seaway::field {
namespace {

using namespace testing;
using mesh::no_block;

/// All entries of a scratch with `layers` around the block's cells (axis < 0) or faces.
template <int Dim, class F>
void for_scratch(int layers, int axis, F&& f) {
  IVec<Dim> lower = filled<Dim>(-layers), upper = filled<Dim>(BlockShape<Dim>::n + layers);
  if (axis >= 0) ++upper[axis];
  for_box<Dim>(lower, upper, f);
}

/// Where an entry lies: position, and whether it is off the tank.
template <int Dim>
Vec<Dim> position(const Forest<Dim>& forest, int b, const IVec<Dim>& i, int axis) {
  return axis < 0 ? forest.block(b).cell_centre(i) : forest.block(b).face_centre(i, axis);
}
template <int Dim>
bool inside(const Forest<Dim>& forest, const Vec<Dim>& x, double margin = 0) {
  return (x.array() > forest.grid().lower.array() + margin - 1e-9).all() &&
         (x.array() < forest.grid().upper.array() - margin + 1e-9).all();
}

/// Every entry inside the tank where the same level covers it is the exact value, bit by bit.
template <int Dim>
void check_copies() {
  const auto forest = small_forest<Dim>(0.2, 1.2, 2);
  CellField<double, Dim> cells(forest);
  fill_cells<Dim>(
      forest, [](const Vec<Dim>& x) { return noise<Dim>(x); }, cells);
  FaceField<double, Dim> faces(forest);
  for (int axis = 0; axis < Dim; ++axis)
    fill_faces<Dim>(
        forest, [](const Vec<Dim>& x) { return noise<Dim>(x); }, axis, faces);
  Scratch<double, Dim> s;
  for (const int b : forest.leaves()) {
    const Block<Dim>& block = forest.block(b);
    const auto covered = [&](const IVec<Dim>& i, int axis) {  // by a leaf of the same size
      int entry = 0, power = 1;
      for (int a = 0; a < Dim; ++a, power *= 3) {
        const int end = BlockShape<Dim>::n + (a == axis);
        entry += (i[a] < 0 ? 0 : i[a] < end ? 1 : 2) * power;
      }
      const int nb = block.neighbour[static_cast<std::size_t>(entry)];
      return nb >= 0 && forest.block(nb).leaf;
    };
    for (const int layers : {1, 2}) {
      gather_cells(forest, cells, b, layers, s);
      for_scratch<Dim>(layers, -1, [&](const IVec<Dim>& i) {
        if (covered(i, -1)) {
          EXPECT_EQ(s(i), noise<Dim>(position<Dim>(forest, b, i, -1)));
        }
      });
      for (int axis = 0; axis < Dim; ++axis) {
        gather_faces(forest, faces, axis, b, layers, Boundaries<Dim>{}, s);
        for_scratch<Dim>(layers, axis, [&](const IVec<Dim>& i) {
          if (covered(i, axis)) {
            EXPECT_EQ(s(i), noise<Dim>(position<Dim>(forest, b, i, axis)));
          }
        });
      }
    }
  }
}
TEST(Gather, CopiesFromBlocksOfTheSameSizeIn2D) { check_copies<2>(); }
TEST(Gather, CopiesFromBlocksOfTheSameSizeIn3D) { check_copies<3>(); }

/// Linear fields come out exactly across level jumps, finer and coarser. Away from the tank's
/// sides, where the coarse slopes are limited against mirrored values.
template <int Dim>
void check_linear() {
  const auto forest = small_forest<Dim>(0.9, 1.6, 3);
  const auto f = [](const Vec<Dim>& x) { return 2 + x[0] - 3 * x[1] + 0.5 * x[Dim - 1]; };
  CellField<double, Dim> cells(forest);
  fill_cells<Dim>(forest, f, cells);
  restrict_cells(forest, cells);
  FaceField<double, Dim> faces(forest);
  for (int axis = 0; axis < Dim; ++axis) fill_faces<Dim>(forest, f, axis, faces);
  restrict_faces(forest, faces);
  Scratch<double, Dim> s;
  int jumps = 0;
  for (const int b : forest.leaves()) {
    jumps += forest.touches_coarser(b);
    const double margin = 2.01 * 2 * forest.block(b).h.maxCoeff();  // the slope's coarse neighbours
    gather_cells(forest, cells, b, 2, s);
    for_scratch<Dim>(2, -1, [&](const IVec<Dim>& i) {
      const Vec<Dim> x = position<Dim>(forest, b, i, -1);
      if (inside(forest, x, margin)) {
        EXPECT_NEAR(s(i), f(x), 1e-13);
      }
    });
    for (int axis = 0; axis < Dim; ++axis) {
      gather_faces(forest, faces, axis, b, 2, Boundaries<Dim>{}, s);
      for_scratch<Dim>(2, axis, [&](const IVec<Dim>& i) {
        const Vec<Dim> x = position<Dim>(forest, b, i, axis);
        if (inside(forest, x, margin)) {
          EXPECT_NEAR(s(i), f(x), 1e-13);
        }
      });
    }
  }
  EXPECT_GT(jumps, 0);
}
TEST(Gather, LinearFieldsAreExactAcrossLevelJumpsIn2D) { check_linear<2>(); }
TEST(Gather, LinearFieldsAreExactAcrossLevelJumpsIn3D) { check_linear<3>(); }

/// Interpolated ghosts stay within the coarse values around them.
TEST(Gather, GhostsFromCoarserBlocksAddNoExtremes) {
  const auto forest = small_forest<2>(0.9, 1.6, 2);
  CellField<double, 2> cells(forest);
  fill_cells<2>(
      forest, [](const Vec2& x) { return x[0] + 0.3 * x[1] > 1.9 ? 1.0 : 0.0; }, cells);
  restrict_cells(forest, cells);
  Scratch<double, 2> s;
  for (const int b : forest.leaves()) {
    gather_cells(forest, cells, b, 2, s);
    for_scratch<2>(2, -1, [&](const IVec<2>& i) {
      EXPECT_GE(s(i), -0.5);  // each axis adds at most a quarter of a jump
      EXPECT_LE(s(i), 1.5);
    });
  }
}

/// The index that an entry off the tank mirrors, and the sign of a normal velocity there.
template <int Dim>
void check_walls(BoundaryKind kind) {
  const auto forest = small_forest<Dim>(0, 0, 0);
  constexpr int n = BlockShape<Dim>::n;
  CellField<double, Dim> cells(forest);
  fill_cells<Dim>(
      forest, [](const Vec<Dim>& x) { return noise<Dim>(x); }, cells);
  FaceField<double, Dim> faces(forest);
  for (int axis = 0; axis < Dim; ++axis)
    fill_faces<Dim>(
        forest, [](const Vec<Dim>& x) { return noise<Dim>(x); }, axis, faces);
  Boundaries<Dim> boundaries;
  for (auto& sides : boundaries.kind) sides.fill(kind);
  Scratch<double, Dim> s;
  for (const int b : forest.leaves()) {
    const auto outside = [&](int a, int side) {
      return forest.block(b)
                 .neighbour[static_cast<std::size_t>(mesh::face_neighbour<Dim>(a, side))] ==
             no_block;
    };
    gather_cells(forest, cells, b, 2, s);
    for_scratch<Dim>(2, -1, [&](const IVec<Dim>& i) {
      IVec<Dim> m = i;
      for (int a = 0; a < Dim; ++a) {
        if (i[a] < 0 && outside(a, 0)) m[a] = -1 - i[a];
        if (i[a] >= n && outside(a, 1)) m[a] = 2 * n - 1 - i[a];
      }
      EXPECT_EQ(s(i), noise<Dim>(position<Dim>(forest, b, m, -1)));
    });
    for (int axis = 0; axis < Dim; ++axis) {
      gather_faces(forest, faces, axis, b, 2, boundaries, s);
      for_scratch<Dim>(2, axis, [&](const IVec<Dim>& i) {
        IVec<Dim> m = i, wall = i;
        bool across = false;
        for (int a = 0; a < Dim; ++a) {
          const int below = a == axis ? -i[a] : -1 - i[a];
          const int above = a == axis ? 2 * n - i[a] : 2 * n - 1 - i[a];
          const int end = n + (a == axis);
          if (i[a] < 0 && outside(a, 0))
            m[a] = below;
          else if (i[a] >= end && outside(a, 1))
            m[a] = above;
          else
            continue;
          if (a == axis) {
            across = true;
            wall[a] = i[a] < 0 ? 0 : n;
          } else {
            wall[a] = m[a];
          }
        }
        const double mirrored = noise<Dim>(position<Dim>(forest, b, m, axis));
        if (!across) {
          EXPECT_EQ(s(i), mirrored);
        } else {
          const double at_wall = noise<Dim>(position<Dim>(forest, b, wall, axis));
          EXPECT_EQ(s(i), kind == BoundaryKind::open ? at_wall : 2 * at_wall - mirrored);
        }
      });
    }
  }
}
TEST(Gather, WallsMirrorAndTurnTheNormalVelocityIn2D) { check_walls<2>(BoundaryKind::fixed); }
TEST(Gather, WallsMirrorAndTurnTheNormalVelocityIn3D) { check_walls<3>(BoundaryKind::fixed); }
TEST(Gather, OpenSidesRepeatTheNormalVelocityIn2D) { check_walls<2>(BoundaryKind::open); }
TEST(Gather, OpenSidesRepeatTheNormalVelocityIn3D) { check_walls<3>(BoundaryKind::open); }

/// In a periodic tank every ghost of a uniform mesh is the value one tank length away.
template <int Dim>
void check_periodic() {
  const auto forest = small_forest<Dim>(0, 0, 0, true);
  const auto f = [](Vec<Dim> x) {
    for (int a = 0; a < Dim; ++a) x[a] = std::fmod(x[a] + 3, 3.0);
    return noise<Dim>(x);
  };
  CellField<double, Dim> cells(forest);
  fill_cells<Dim>(forest, f, cells);
  FaceField<double, Dim> faces(forest);
  Scratch<double, Dim> s;
  for (int axis = 0; axis < Dim; ++axis) fill_faces<Dim>(forest, f, axis, faces);
  for (const int b : forest.leaves()) {
    gather_cells(forest, cells, b, 2, s);
    for_scratch<Dim>(
        2, -1, [&](const IVec<Dim>& i) { EXPECT_EQ(s(i), f(position<Dim>(forest, b, i, -1))); });
    for (int axis = 0; axis < Dim; ++axis) {
      gather_faces(forest, faces, axis, b, 2, Boundaries<Dim>{}, s);
      for_scratch<Dim>(2, axis, [&](const IVec<Dim>& i) {
        EXPECT_EQ(s(i), f(position<Dim>(forest, b, i, axis)));
      });
    }
  }
}
TEST(Gather, PeriodicSidesAreNoSidesIn2D) { check_periodic<2>(); }
TEST(Gather, PeriodicSidesAreNoSidesIn3D) { check_periodic<3>(); }

/// A level jump at the tank's side: constants stay constant in every ghost.
template <int Dim>
void check_constants() {
  const auto forest = small_forest<Dim>(0, 0.8, 3);
  CellField<double, Dim> cells(forest, 7.0);
  FaceField<double, Dim> faces(forest, 7.0);
  Boundaries<Dim> boundaries;
  for (auto& sides : boundaries.kind) sides = {BoundaryKind::open, BoundaryKind::fixed};
  Scratch<double, Dim> s;
  for (const int b : forest.leaves()) {
    gather_cells(forest, cells, b, 2, s);
    for_scratch<Dim>(2, -1, [&](const IVec<Dim>& i) { EXPECT_EQ(s(i), 7.0); });
    for (int axis = 0; axis < Dim; ++axis) {
      gather_faces(forest, faces, axis, b, 2, boundaries, s);
      for_scratch<Dim>(2, axis, [&](const IVec<Dim>& i) { EXPECT_EQ(s(i), 7.0); });
    }
  }
}
TEST(Gather, ConstantsStayConstantIn2D) { check_constants<2>(); }
TEST(Gather, ConstantsStayConstantIn3D) { check_constants<3>(); }

/// Less than the whole surroundings: what was asked for is the same, bit by bit, with noise in every field.
template <int Dim>
void check_neighbourhoods() {
  const auto forest = small_forest<Dim>(0.2, 1.2, 2);
  const auto noisy = [](const Vec<Dim>& x) { return noise<Dim>(x); };
  CellField<double, Dim> cells(forest);
  fill_cells<Dim>(forest, noisy, cells);
  restrict_cells<double, Dim>(forest, cells);
  FaceField<double, Dim> faces(forest);
  for (int axis = 0; axis < Dim; ++axis) fill_faces<Dim>(forest, noisy, axis, faces);
  restrict_faces<double, Dim>(forest, faces);
  const auto wanted = [](const IVec<Dim>& i, int face_axis, Neighbourhood set) {
    int entry = 0, power = 1;
    for (int a = 0; a < Dim; ++a, power *= 3)
      entry += (i[a] < 0 ? 0 : i[a] < BlockShape<Dim>::n + (a == face_axis) ? 1 : 2) * power;
    return entry == BlockShape<Dim>::neighbours / 2 || (set >> entry & 1) != 0;
  };
  Scratch<double, Dim> all, part;
  for (const int b : forest.leaves()) {
    for (int axis = 0; axis < Dim; ++axis) {
      for (const Neighbourhood set : {beside<Dim>(axis), face_neighbours<Dim>(), around_axis<Dim>(axis)}) {
        gather_cells(forest, cells, b, 2, all);
        gather_cells(forest, cells, b, 2, part, set);
        for_scratch<Dim>(2, -1, [&](const IVec<Dim>& i) {
          if (wanted(i, -1, set)) {
            EXPECT_EQ(part(i), all(i));
          }
        });
        for (int face_axis = 0; face_axis < Dim; ++face_axis) {
          gather_faces(forest, faces, face_axis, b, 2, Boundaries<Dim>{}, all);
          gather_faces(forest, faces, face_axis, b, 2, Boundaries<Dim>{}, part, set);
          for_scratch<Dim>(2, face_axis, [&](const IVec<Dim>& i) {
            if (wanted(i, face_axis, set)) {
              EXPECT_EQ(part(i), all(i));
            }
          });
        }
      }
    }
  }
}
TEST(Gather, FillsWhatANeighbourhoodNamesIn2D) { check_neighbourhoods<2>(); }
TEST(Gather, FillsWhatANeighbourhoodNamesIn3D) { check_neighbourhoods<3>(); }

}  // namespace
}  // namespace seaway::field
