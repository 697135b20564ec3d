#include "tests/validation/support/carried_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/field/restrict.hpp"
#include "core/flow/advection.hpp"

namespace seaway::validation {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_box;
using field::offset;

namespace {

template <int Dim>
std::unique_ptr<mesh::Forest<Dim>> unit_box(int cells, int threads) {
  mesh::TankGrid<Dim> grid;
  grid.lower.setZero();
  grid.upper.setOnes();
  grid.root_blocks.fill(cells / mesh::BlockShape<Dim>::n);
  return std::make_unique<mesh::Forest<Dim>>(grid, 0, [](const Vec<Dim>&, const Vec<Dim>&, int) { return false; }, threads);
}

template <int Dim>
void fill(const mesh::Forest<Dim>& forest, const CarriedShape<Dim>& shape, flow::FlowState<Dim>& state) {
  IVec<Dim> upper;
  upper.fill(shape.samples);
  forest.for_each_leaf([&](int b) {
    const auto& block = forest.block(b);
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      int count = 0, all = 0;
      for_box<Dim>(filled<Dim>(0), upper, [&](const IVec<Dim>& s) {
        Vec<Dim> x = block.cell_centre(i);
        for (int a = 0; a < Dim; ++a) x[a] += block.h[a] * ((s[a] + 0.5) / shape.samples - 0.5);
        count += shape.inside(x) ? 1 : 0;
        ++all;
      });
      state.vof.block(b)[offset<Dim>(i, cell_strides<Dim>())] = static_cast<double>(count) / all;
    });
  });
  field::restrict_cells<double, Dim>(forest, state.vof);
}

template <int Dim>
void set_w(const mesh::Forest<Dim>& forest, const CarriedShape<Dim>& shape, double t, flow::FlowState<Dim>& state) {
  forest.for_each_leaf([&](int b) {
    const auto& block = forest.block(b);
    for (int axis = 0; axis < Dim; ++axis)
      for_box<Dim>(filled<Dim>(0), faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        state.w.block(axis, b)[offset<Dim>(i, face_strides<Dim>(axis))] = shape.velocity(block.face_centre(i, axis), block.h, axis, t);
      });
  });
  field::restrict_faces<double, Dim>(forest, state.w);
}

struct Outcome {
  double error = 0, volume = 0, overshoot = 0;
};

template <int Dim>
Outcome carry(const mesh::Forest<Dim>& forest, const CarriedShape<Dim>& shape, flow::FlowState<Dim>& state) {
  flow::Advection<Dim> advection(forest, {}, {});
  const flow::CellField<double, Dim> start = state.vof;
  set_w<Dim>(forest, shape, 0, state);
  const int steps = static_cast<int>(std::ceil(shape.duration * advection.courant_number(state.w, 1.0) / 0.4));
  const double dt = shape.duration / steps;
  for (int s = 0; s < steps; ++s) {
    set_w<Dim>(forest, shape, (s + 0.5) * dt, state);
    advection.advance(state, dt, s);
  }
  const auto sum = [&](auto&& f) {
    return forest.sum_over_leaves([&](int b) {
      double part = 0;
      for (int i = 0; i < mesh::BlockShape<Dim>::cells; ++i) part += f(state.vof.block(b)[i], start.block(b)[i]);
      return part;
    });
  };
  Outcome out;
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

}  // namespace

template <int Dim>
std::vector<double> carry_on_meshes(const CarriedShape<Dim>& shape, const std::vector<int>& meshes, int threads, Results& results) {
  Refinement errors{"shape_error", "1", {}, {}, shape.formal_order, 0.0};
  double volume = 0, overshoot = 0;
  for (const int cells : meshes) {
    const auto forest = unit_box<Dim>(cells, threads);
    flow::FlowState<Dim> state(*forest);
    fill<Dim>(*forest, shape, state);
    const Outcome outcome = carry<Dim>(*forest, shape, state);
    results.report(fmt::format("shape_error_{}", cells), outcome.error, "1");
    errors.h.push_back(1.0 / cells);
    errors.value.push_back(outcome.error);
    volume = std::max(volume, std::abs(outcome.volume));
    overshoot = std::max(overshoot, outcome.overshoot);
  }
  results.expect_below("volume_change", volume, "1", 1e-11);
  results.expect_below("overshoot", overshoot, "1", 1e-11);
  results.refinement(errors);
  return errors.value;
}

template std::vector<double> carry_on_meshes<2>(const CarriedShape<2>&, const std::vector<int>&, int, Results&);
template std::vector<double> carry_on_meshes<3>(const CarriedShape<3>&, const std::vector<int>&, int, Results&);

}  // namespace seaway::validation
