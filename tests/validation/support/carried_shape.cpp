#include "tests/validation/support/carried_shape.hpp"

#include <algorithm>
#include <cmath>

#include "core/field/restrict.hpp"

namespace seaway::validation {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_box;
using field::offset;

template <int Dim>
std::unique_ptr<mesh::Forest<Dim>> unit_box(int cells, int threads) {
  mesh::TankGrid<Dim> grid;
  grid.lower.setZero();
  grid.upper.setOnes();
  grid.root_blocks.fill(cells / mesh::BlockShape<Dim>::n);
  return std::make_unique<mesh::Forest<Dim>>(grid, 0, [](const Vec<Dim>&, const Vec<Dim>&, int) { return false; }, threads);
}

template <int Dim>
void fill_shape(const mesh::Forest<Dim>& forest, const std::function<bool(const Vec<Dim>&)>& inside, int samples,
                flow::FlowState<Dim>& state) {
  IVec<Dim> upper;
  upper.fill(samples);
  forest.for_each_leaf([&](int b) {
    const auto& block = forest.block(b);
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      int count = 0, all = 0;
      for_box<Dim>(filled<Dim>(0), upper, [&](const IVec<Dim>& s) {
        Vec<Dim> x = block.cell_centre(i);
        for (int a = 0; a < Dim; ++a) x[a] += block.h[a] * ((s[a] + 0.5) / samples - 0.5);
        count += inside(x) ? 1 : 0;
        ++all;
      });
      state.vof.block(b)[offset<Dim>(i, cell_strides<Dim>())] = static_cast<double>(count) / all;
    });
  });
  field::restrict_cells<double, Dim>(forest, state.vof);
}

namespace {

template <int Dim>
void set_w(const mesh::Forest<Dim>& forest, const FaceVelocity<Dim>& velocity, double t, flow::FlowState<Dim>& state) {
  forest.for_each_leaf([&](int b) {
    const auto& block = forest.block(b);
    for (int axis = 0; axis < Dim; ++axis)
      for_box<Dim>(filled<Dim>(0), faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        state.w.block(axis, b)[offset<Dim>(i, face_strides<Dim>(axis))] = velocity(block.face_centre(i, axis), block.h, axis, t);
      });
  });
  field::restrict_faces<double, Dim>(forest, state.w);
}

}  // namespace

template <int Dim>
CarriedShape carry(const mesh::Forest<Dim>& forest, flow::FlowState<Dim>& state, const FaceVelocity<Dim>& velocity,
                   double duration) {
  flow::Advection<Dim> advection(forest, {}, {});
  const flow::CellField<double, Dim> start = state.vof;
  set_w<Dim>(forest, velocity, 0, state);
  CarriedShape out;
  out.steps = static_cast<int>(std::ceil(duration * advection.courant_number(state.w, 1.0) / 0.4));
  const double dt = duration / out.steps;
  for (int s = 0; s < out.steps; ++s) {
    set_w<Dim>(forest, velocity, (s + 0.5) * dt, state);
    advection.advance(state, dt, s);
  }
  const auto sum = [&](auto&& f) {
    return forest.sum_over_leaves([&](int b) {
      double part = 0;
      for (int i = 0; i < mesh::BlockShape<Dim>::cells; ++i) part += f(state.vof.block(b)[i], start.block(b)[i]);
      return part;
    });
  };
  const double volume = sum([](double, double before) { return before; });
  out.error = sum([](double now, double before) { return std::abs(now - before); }) / volume;
  out.volume = sum([](double now, double before) { return now - before; }) / volume;
  out.overshoot = forest.max_over_leaves(0, [&](int b) {
    double most = 0;
    for (int i = 0; i < mesh::BlockShape<Dim>::cells; ++i)
      most = std::max({most, state.vof.block(b)[i] - 1, -state.vof.block(b)[i]});
    return most;
  });
  return out;
}

#define SEAWAY_INSTANTIATE(D)                                                                                             \
  template std::unique_ptr<mesh::Forest<D>> unit_box<D>(int, int);                                                        \
  template void fill_shape<D>(const mesh::Forest<D>&, const std::function<bool(const Vec<D>&)>&, int, flow::FlowState<D>&); \
  template CarriedShape carry<D>(const mesh::Forest<D>&, flow::FlowState<D>&, const FaceVelocity<D>&, double);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::validation
