// Pairs of meshes for the tests of core/transfer, and exact fields on them.
#pragma once

#include <functional>

#include "core/field/field.hpp"
#include "core/mesh/refinement.hpp"

namespace seaway::transfer::testing {

using field::CellField;
using field::FaceField;
using mesh::BlockShape;
using mesh::Forest;

template <int Dim>
using Function = std::function<double(const Vec<Dim>&)>;

/// A tank of unit blocks: `blocks` along every axis, cells of 1 / n.
template <int Dim>
mesh::TankGrid<Dim> unit_tank(int blocks, bool periodic = false) {
  mesh::TankGrid<Dim> grid;
  grid.lower.setZero();
  grid.upper.setConstant(blocks);
  grid.root_blocks = field::filled<Dim>(blocks);
  grid.periodic.fill(periodic);
  return grid;
}

/// Refined to `level` inside the box [low, high]^Dim (scaled by the tank's size).
template <int Dim>
Forest<Dim> boxed(const mesh::TankGrid<Dim>& grid, double low, double high, int level, int threads = 1) {
  const Vec<Dim> size = grid.upper - grid.lower;
  const mesh::RefineRule<Dim> rule = [=](const Vec<Dim>& lower, const Vec<Dim>& upper, int at) {
    return at < level && ((lower - grid.lower).array() < high * size.array()).all() &&
           ((upper - grid.lower).array() > low * size.array()).all();
  };
  return Forest<Dim>(grid, level, rule, threads);
}

template <int Dim>
void fill_cells(const Forest<Dim>& forest, const Function<Dim>& f, CellField<double, Dim>& out) {
  out = CellField<double, Dim>(forest);
  for (const int b : forest.leaves())
    field::for_box<Dim>(field::filled<Dim>(0), field::cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      out.block(b)[field::offset<Dim>(i, field::cell_strides<Dim>())] =
          f(forest.block(b).cell_centre(i));
    });
}

/// Component `axis` at the faces of `axis`; f(x, axis).
template <int Dim>
void fill_faces(const Forest<Dim>& forest, const std::function<double(const Vec<Dim>&, int)>& f,
                FaceField<double, Dim>& out) {
  out = FaceField<double, Dim>(forest);
  for (const int b : forest.leaves())
    for (int axis = 0; axis < Dim; ++axis)
      field::for_box<Dim>(field::filled<Dim>(0), field::faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        out.block(axis, b)[field::offset<Dim>(i, field::face_strides<Dim>(axis))] =
            f(forest.block(b).face_centre(i, axis), axis);
      });
}

/// Fraction of each cell below z = surface(x), by a fine midpoint rule across the other axes.
template <int Dim>
void fill_water(const Forest<Dim>& forest, const Function<Dim>& surface, CellField<double, Dim>& out,
                int samples = Dim == 2 ? 64 : 8) {
  out = CellField<double, Dim>(forest);
  constexpr int up = Dim - 1;
  IVec<Dim> columns = field::filled<Dim>(samples);
  columns[up] = 1;
  for (const int b : forest.leaves()) {
    const auto& block = forest.block(b);
    field::for_box<Dim>(field::filled<Dim>(0), field::cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      const Vec<Dim> centre = block.cell_centre(i);
      double sum = 0;
      int count = 0;
      field::for_box<Dim>(field::filled<Dim>(0), columns, [&](const IVec<Dim>& s) {
        Vec<Dim> x = centre;
        for (int a = 0; a < up; ++a) x[a] += ((s[a] + 0.5) / samples - 0.5) * block.h[a];
        sum += std::clamp((surface(x) - centre[up]) / block.h[up] + 0.5, 0.0, 1.0);
        ++count;
      });
      out.block(b)[field::offset<Dim>(i, field::cell_strides<Dim>())] = sum / count;
    });
  }
}

}  // namespace seaway::transfer::testing
