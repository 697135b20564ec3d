// Advection with more sub-steps in a region than elsewhere (SubStepPlan).
//
// First the whole mesh takes the long sub-step. In the region (the fast leaves, and their neighbours where they are fast at the
// common side) that is no more than an estimate, for what the leaves beside it see: velocities stay as they were, volume
// fractions are kept within [0, 1]. Then the region starts again and takes the short ones, with the rest as it was at the start
// around it and, through its sides, the water that the rest saw pass.
#include <algorithm>
#include <utility>

#include "core/field/restrict.hpp"
#include "core/flow/advection.hpp"

namespace seaway::flow {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_box;
using field::offset;

namespace {

template <int Dim>
void copy_cells(const CellField<double, Dim>& from, int b, CellField<double, Dim>& to) {
  std::copy_n(from.block(b), BlockShape<Dim>::cells, to.block(b));
}

/// What transport moves, of some leaves: from the state to fields of their own (`carried`: tke, epsilon).
template <int Dim>
void copy_leaves(const Forest<Dim>& forest, const std::vector<int>& leaves, const FlowState<Dim>& state,
                 CellField<double, Dim>& vof, FaceField<double, Dim>& u, std::array<CellField<double, Dim>, 2>& carried) {
  mesh::for_each(leaves, forest.threads(), [&](int b) {
    copy_cells(state.vof, b, vof);
    for (int a = 0; a < Dim; ++a) std::copy_n(state.u.block(a, b), BlockShape<Dim>::faces, u.block(a, b));
    if (!state.turbulent()) return;
    copy_cells(state.tke, b, carried[0]);
    copy_cells(state.epsilon, b, carried[1]);
  });
}

/// f(offset) for a leaf's faces of an axis that do not lie on a cut side of the part.
template <int Dim, class F>
void for_uncut_faces(const mesh::ForestPart<Dim>& part, int axis, int b, F&& f) {
  IVec<Dim> lower = filled<Dim>(0), upper = faces_upper<Dim>(axis);
  if (part.is_cut(b, axis, 0)) ++lower[axis];
  if (part.is_cut(b, axis, 1)) --upper[axis];
  for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) { f(offset<Dim>(i, face_strides<Dim>(axis))); });
}

}  // namespace

/// Volume fractions that a long sweep found in the region, brought back to what a fraction can be.
template <int Dim>
void Advection<Dim>::bound_region(const mesh::ForestPart<Dim>& region) {
  mesh::for_each(region.leaves, forest_.threads(), [&](int b) {
    double* vof = vof_new_.block(b);
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) vof[i] = std::clamp(vof[i], 0.0, 1.0);
  });
}

/// Velocities and what is carried in the region as before a long sweep, but for the velocities on its sides: what is near
/// these is slow.
template <int Dim>
void Advection<Dim>::stop_region(const FlowState<Dim>& state, const mesh::ForestPart<Dim>& region) {
  mesh::for_each(region.leaves, forest_.threads(), [&](int b) {
    for (int a = 0; a < Dim; ++a) {
      const double* from = state.u.block(a, b);
      double* to = u_new_.block(a, b);
      for_uncut_faces<Dim>(region, a, b, [&](int o) { to[o] = from[o]; });
    }
    if (!state.turbulent()) return;
    copy_cells(state.tke, b, carried_new_[0]);
    copy_cells(state.epsilon, b, carried_new_[1]);
  });
}

/// The long sub-step of all leaves, true of those outside the region.
template <int Dim>
void Advection<Dim>::advance_around(FlowState<Dim>& state, double dt, std::int64_t step, const mesh::ForestPart<Dim>& region) {
  start_from(state);
  for (int k = 0; k < Dim; ++k) {
    const int axis = static_cast<int>((k + step) % Dim);
    sweep(state, axis, dt, &region);
    take_new(state);
  }
}

/// Puts the state away and brings back the one at the start of the sub-step.
template <int Dim>
void Advection<Dim>::hold(FlowState<Dim>& state) {
  std::swap(held_vof_, state.vof);
  std::swap(held_u_, state.u);
  state.vof = vof_start_;
  state.u = u_start_;
  if (!state.turbulent()) return;
  std::swap(held_carried_[0], state.tke);
  std::swap(held_carried_[1], state.epsilon);
  state.tke = carried_start_[0];
  state.epsilon = carried_start_[1];
}

/// Adds what the sweep let pass to what is recorded.
template <int Dim>
void Advection<Dim>::record(int axis, const mesh::ForestPart<Dim>& region) {
  mesh::for_each(region.leaves, forest_.threads(), [&](int b) {
    const double* swept = swept_.block(axis, b);
    double* sum = recorded_.block(axis, b);
    for_uncut_faces<Dim>(region, axis, b, [&](int o) { sum[o] += swept[o]; });
  });
}

template <int Dim>
void Advection<Dim>::sweep_region(FlowState<Dim>& state, int axis, double dt, const SubStepPlan<Dim>& plan) {
  const mesh::ForestPart<Dim>& region = plan.region;
  const Scope scope{region.leaves, &region, 1.0 / plan.inner};
  planes_.reconstruct(state.vof, region.leaves, region.leaves);
  water_fluxes(scope, state, axis, dt);
  record(axis, region);
  update_vof(scope, state, axis, dt);
  field::restrict_cells<double, Dim>(forest_, region, vof_new_);
  update_momentum(scope, state, axis, dt);
  mesh::for_each(region.leaves, forest_.threads(), [&](int b) {
    copy_cells(vof_new_, b, state.vof);
    for (int a = 0; a < Dim; ++a) {
      const double* from = u_new_.block(a, b);
      double* to = state.u.block(a, b);
      for_uncut_faces<Dim>(region, a, b, [&](int o) { to[o] = from[o]; });
    }
    if (!state.turbulent()) return;
    copy_cells(carried_new_[0], b, state.tke);
    copy_cells(carried_new_[1], b, state.epsilon);
  });
  field::restrict_cells<double, Dim>(forest_, region, state.vof);
  for (int a = 0; a < Dim; ++a) field::restrict_faces<double, Dim>(forest_, region, state.u, a);
  if (!state.turbulent()) return;
  field::restrict_cells<double, Dim>(forest_, region, state.tke);
  field::restrict_cells<double, Dim>(forest_, region, state.epsilon);
}

/// Velocities on the region's sides go in equal steps to those that the rest of the mesh has; both copies of a face do.
template <int Dim>
void Advection<Dim>::approach_sides(FlowState<Dim>& state, int steps_left, const mesh::ForestPart<Dim>& region) const {
  const auto approach = [&](int b, int axis, int side) {
    const double* to = held_u_.block(axis, b);
    double* u = state.u.block(axis, b);
    field::for_side_faces<Dim>(axis, side, [&](int o) { u[o] = steps_left == 1 ? to[o] : u[o] + (to[o] - u[o]) / steps_left; });
  };
  mesh::for_each(region.leaves, forest_.threads(), [&](int b) {
    for (int a = 0; a < Dim; ++a)
      for (int side = 0; side < 2; ++side)
        if (region.is_cut(b, a, side)) approach(b, a, side);
  });
  mesh::parallel_for(static_cast<int>(region.rim.size()), forest_.threads(), [&](int k) {
    const mesh::LeafSide& rim = region.rim[static_cast<std::size_t>(k)];
    approach(rim.leaf, rim.axis, rim.side);
  });
  for (int a = 0; a < Dim; ++a) field::restrict_faces<double, Dim>(forest_, region, state.u, a);
}

template <int Dim>
std::vector<typename Advection<Dim>::Clip> Advection<Dim>::clip(FlowState<Dim>& state, const std::vector<int>& leaves) const {
  std::vector<Clip> out;
  for (const int b : leaves) {
    const auto& block = forest_.block(b);
    double* vof = state.vof.block(b);
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      const int cell = offset<Dim>(i, cell_strides<Dim>());
      const double inside = std::clamp(vof[cell], 0.0, 1.0);
      if (inside == vof[cell]) return;
      out.push_back({static_cast<std::int64_t>(b) * BlockShape<Dim>::cells + cell, block.cell_centre(i),
                     (vof[cell] - inside) * block.cell_volume()});
      vof[cell] = inside;
    });
  }
  return out;
}

template <int Dim>
std::vector<typename Advection<Dim>::Clip> Advection<Dim>::advance(FlowState<Dim>& state, double dt, std::int64_t step,
                                                                   const SubStepPlan<Dim>& plan) {
  if (plan.inner == 1) {
    advance(state, dt, step);
    return {};
  }
  const mesh::ForestPart<Dim>& region = plan.region;
  const FluxVisitor visitor = std::exchange(visitor_, nullptr);
  if (recorded_.data(0).empty()) recorded_ = FaceField<double, Dim>(forest_);
  advance_around(state, dt, step, region);
  std::swap(recorded_, swept_);
  hold(state);
  // What the region's ghosts see of the rest.
  vof_new_ = state.vof;
  mesh::parallel_for(forest_.n_blocks(), forest_.threads(), [&](int b) {
    for (int a = 0; a < Dim; ++a)
      std::transform(recorded_.block(a, b), recorded_.block(a, b) + BlockShape<Dim>::faces, swept_.block(a, b),
                     [&](double whole) { return whole / plan.inner; });
  });
  mesh::for_each(region.leaves, forest_.threads(), [&](int b) {
    for (int a = 0; a < Dim; ++a) {
      double* sum = recorded_.block(a, b);
      for_uncut_faces<Dim>(region, a, b, [&](int o) { sum[o] = 0; });
    }
  });
  planes_.reconstruct(state.vof, forest_.leaves(), region.leaves);
  for (int left = plan.inner; left > 0; --left) {
    copy_leaves(forest_, region.leaves, state, vof_start_, u_start_, carried_start_);
    for (int k = 0; k < Dim; ++k) sweep_region(state, static_cast<int>((k + step) % Dim), dt / plan.inner, plan);
    approach_sides(state, left, region);
  }
  // The region joins the rest.
  std::vector<Clip> clips = clip(state, region.leaves);
  copy_leaves(forest_, region.leaves, state, held_vof_, held_u_, held_carried_);
  std::swap(state.vof, held_vof_);
  std::swap(state.u, held_u_);
  if (state.turbulent()) {
    std::swap(state.tke, held_carried_[0]);
    std::swap(state.epsilon, held_carried_[1]);
    field::restrict_cells<double, Dim>(forest_, state.tke);
    field::restrict_cells<double, Dim>(forest_, state.epsilon);
  }
  field::restrict_cells<double, Dim>(forest_, state.vof);
  field::restrict_faces<double, Dim>(forest_, state.u);
  visitor_ = visitor;
  if (visitor_)
    for (int axis = 0; axis < Dim; ++axis) visitor_(axis, recorded_);
  return clips;
}

#define SEAWAY_INSTANTIATE(D)                                                                                               \
  template void Advection<D>::bound_region(const mesh::ForestPart<D>&);                                                     \
  template void Advection<D>::stop_region(const FlowState<D>&, const mesh::ForestPart<D>&);                                 \
  template void Advection<D>::advance_around(FlowState<D>&, double, std::int64_t, const mesh::ForestPart<D>&);              \
  template void Advection<D>::hold(FlowState<D>&);                                                                          \
  template void Advection<D>::record(int, const mesh::ForestPart<D>&);                                                      \
  template void Advection<D>::sweep_region(FlowState<D>&, int, double, const SubStepPlan<D>&);                              \
  template void Advection<D>::approach_sides(FlowState<D>&, int, const mesh::ForestPart<D>&) const;                         \
  template std::vector<Advection<D>::Clip> Advection<D>::clip(FlowState<D>&, const std::vector<int>&) const;                \
  template std::vector<Advection<D>::Clip> Advection<D>::advance(FlowState<D>&, double, std::int64_t, const SubStepPlan<D>&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::flow
