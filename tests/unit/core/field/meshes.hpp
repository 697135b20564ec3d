// A small forest with level jumps over faces and corners, and functions on it.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>

#include "core/field/field.hpp"

namespace seaway::field::testing {

/// 3 root blocks along each axis, edges of 1; `box` is refined to `level`.
template <int Dim>
Forest<Dim> small_forest(double low, double high, int level, bool periodic = false,
                         int threads = 1) {
  mesh::TankGrid<Dim> grid;
  grid.lower.setZero();
  grid.upper.setConstant(3);
  grid.root_blocks.fill(3);
  grid.periodic.fill(periodic);
  const mesh::RefineRule<Dim> rule = [=](const Vec<Dim>& lower, const Vec<Dim>& upper, int at) {
    return at < level && (lower.array() < high).all() && (upper.array() > low).all();
  };
  return Forest<Dim>(grid, level, rule, threads);
}

template <int Dim>
void fill_cells(const Forest<Dim>& forest, const std::function<double(const Vec<Dim>&)>& f,
                CellField<double, Dim>& out) {
  for (const int b : forest.leaves())
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      out.block(b)[offset<Dim>(i, cell_strides<Dim>())] = f(forest.block(b).cell_centre(i));
    });
}

template <int Dim>
void fill_faces(const Forest<Dim>& forest, const std::function<double(const Vec<Dim>&)>& f,
                int axis, FaceField<double, Dim>& out) {
  for (const int b : forest.leaves())
    for_box<Dim>(filled<Dim>(0), faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
      out.block(axis, b)[offset<Dim>(i, face_strides<Dim>(axis))] =
          f(forest.block(b).face_centre(i, axis));
    });
}

/// The same value in [-1, 1] at the same place, whichever block asks: a hash of the position.
template <int Dim>
double noise(const Vec<Dim>& x) {
  std::uint64_t h = 0;
  for (int a = 0; a < Dim; ++a) {
    h = (h + static_cast<std::uint64_t>(std::lround(x[a] * 4096) + 100000)) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 29;
  }
  return static_cast<double>(h >> 11) * 0x1p-52 - 1;
}

}  // namespace seaway::field::testing
