// Small tanks with level jumps and exact fields on them, for the tests of core/flow.
#pragma once

#include <cmath>
#include <functional>

#include "core/base/constants.hpp"
#include "core/field/restrict.hpp"
#include "core/flow/flow_state.hpp"
#include "core/mesh/refinement.hpp"

namespace seaway::flow::testing {

/// A cube of `roots` unit blocks an edge; blocks that overlap (low, high) along every axis are
/// split up to `level`.
template <int Dim>
Forest<Dim> unit_tank(int roots, double low, double high, int level, bool periodic,
                      int threads = 1) {
  mesh::TankGrid<Dim> grid;
  grid.lower.setZero();
  grid.upper.setConstant(roots);
  grid.root_blocks.fill(roots);
  grid.periodic.fill(periodic);
  const mesh::RefineRule<Dim> rule = [=](const Vec<Dim>& lower, const Vec<Dim>& upper, int at) {
    return at < level && (lower.array() < high).all() && (upper.array() > low).all();
  };
  return Forest<Dim>(grid, level, rule, threads);
}

/// Calls f(block, index) for all cells of all leaves.
template <int Dim, class F>
void each_cell(const Forest<Dim>& forest, F&& f) {
  for (const int b : forest.leaves())
    field::for_box<Dim>(field::filled<Dim>(0), field::cells_upper<Dim>(),
                        [&](const IVec<Dim>& i) { f(b, i); });
}
/// The same for the faces of an axis; those between two blocks come twice.
template <int Dim, class F>
void each_face(const Forest<Dim>& forest, int axis, F&& f) {
  for (const int b : forest.leaves())
    field::for_box<Dim>(field::filled<Dim>(0), field::faces_upper<Dim>(axis),
                        [&](const IVec<Dim>& i) { f(b, i); });
}

template <class Field, std::size_t N>
auto& cell_of(Field& f, int b, const std::array<int, N>& i) {
  constexpr int dim = static_cast<int>(N);
  return f.block(b)[field::offset<dim>(i, field::cell_strides<dim>())];
}
template <class Field, std::size_t N>
auto& face_of(Field& f, int axis, int b, const std::array<int, N>& i) {
  constexpr int dim = static_cast<int>(N);
  return f.block(axis, b)[field::offset<dim>(i, field::face_strides<dim>(axis))];
}

/// Water below `surface`, by the midpoint rule across the other axes; exact for a flat surface.
template <int Dim>
void fill_water(const Forest<Dim>& forest, const std::function<double(const Vec<Dim>&)>& surface,
                FlowState<Dim>& state) {
  constexpr int up = Dim - 1;
  constexpr int samples = Dim == 2 ? 32 : 6;
  IVec<Dim> columns = field::filled<Dim>(samples);
  columns[up] = 1;
  each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) {
    const auto& block = forest.block(b);
    double sum = 0;
    int count = 0;
    field::for_box<Dim>(field::filled<Dim>(0), columns, [&](const IVec<Dim>& s) {
      Vec<Dim> x = block.cell_centre(i);
      for (int a = 0; a < up; ++a) x[a] += ((s[a] + 0.5) / samples - 0.5) * block.h[a];
      sum += std::clamp((surface(x) - x[up]) / block.h[up] + 0.5, 0.0, 1.0);
      ++count;
    });
    cell_of(state.vof, b, i) = sum / count;
  });
  field::restrict_cells<double, Dim>(forest, state.vof);
}

template <int Dim>
void fill_faces(const Forest<Dim>& forest, const std::function<double(const Vec<Dim>&, int)>& f,
                FaceField<double, Dim>& out) {
  for (int axis = 0; axis < Dim; ++axis)
    each_face<Dim>(forest, axis, [&](int b, const IVec<Dim>& i) {
      face_of(out, axis, b, i) = f(forest.block(b).face_centre(i, axis), axis);
    });
  field::restrict_faces<double, Dim>(forest, out);
}

/// Solenoidal to rounding on every level: differences of a stream function of the first and the
/// last coordinate at the cells' corners.
template <int Dim>
void fill_stream(const Forest<Dim>& forest, const std::function<double(double, double)>& psi,
                 FaceField<double, Dim>& out) {
  constexpr int up = Dim - 1;
  for (int axis = 0; axis < Dim; ++axis)
    each_face<Dim>(forest, axis, [&](int b, const IVec<Dim>& i) {
      const auto& block = forest.block(b);
      const Vec<Dim> x = block.face_centre(i, axis);
      double& w = face_of(out, axis, b, i);
      w = 0;
      if (axis == 0)
        w = (psi(x[0], x[up] + 0.5 * block.h[up]) - psi(x[0], x[up] - 0.5 * block.h[up])) /
            block.h[up];
      if (axis == up)
        w = (psi(x[0] - 0.5 * block.h[0], x[up]) - psi(x[0] + 0.5 * block.h[0], x[up])) /
            block.h[0];
    });
  field::restrict_faces<double, Dim>(forest, out);
}

/// Largest difference between the two copies of a face shared by two leaves of one level.
template <int Dim>
double duplicate_difference(const Forest<Dim>& forest, const FaceField<double, Dim>& f) {
  double largest = 0;
  for (int axis = 0; axis < Dim; ++axis)
    each_face<Dim>(forest, axis, [&](int b, const IVec<Dim>& i) {
      if (i[axis] != BlockShape<Dim>::n) return;
      const int nb =
          forest.block(b).neighbour[static_cast<std::size_t>(mesh::face_neighbour<Dim>(axis, 1))];
      if (nb < 0 || !forest.block(nb).leaf) return;
      IVec<Dim> j = i;
      j[axis] = 0;
      largest = std::max(largest, std::abs(face_of(f, axis, b, i) - face_of(f, axis, nb, j)));
    });
  return largest;
}

template <int Dim>
double water_volume(const Forest<Dim>& forest, const CellField<double, Dim>& vof) {
  double sum = 0;
  each_cell<Dim>(forest, [&](int b, const IVec<Dim>& i) {
    sum += cell_of(vof, b, i) * forest.block(b).cell_volume();
  });
  return sum;
}

/// The same value in [-1, 1] at the same place, whichever block asks.
template <int Dim>
double noise(const Vec<Dim>& x) {
  std::uint64_t h = 0;
  for (int a = 0; a < Dim; ++a) {
    h = (h + static_cast<std::uint64_t>(std::lround(x[a] * 4096) + 100000)) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 29;
  }
  return static_cast<double>(h >> 11) * 0x1p-52 - 1;
}

}  // namespace seaway::flow::testing
