#include "core/flow/advection.hpp"

#include <algorithm>
#include <cmath>

#include "core/field/restrict.hpp"

namespace seaway::flow {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_box;
using field::for_rows;
using field::offset;
using field::Scratch;
using field::ScratchShape;

template <int Dim>
Advection<Dim>::Advection(const Forest<Dim>& forest, const FluidProperties& fluids,
                          const Boundaries<Dim>& boundaries)
    : forest_(forest), fluids_(fluids), boundaries_(boundaries), planes_(forest), swept_(forest),
      vof_new_(forest), vof_start_(forest), u_start_(forest), u_new_(forest) {}

template <int Dim>
std::vector<LeafCourant<Dim>> Advection<Dim>::courant_numbers(const FaceField<double, Dim>& w, double dt) const {
  constexpr int n = BlockShape<Dim>::n;
  std::vector<LeafCourant<Dim>> out(static_cast<std::size_t>(forest_.n_leaves()));
  mesh::parallel_for(forest_.n_leaves(), forest_.threads(), [&](int leaf) {
    const int b = forest_.leaves()[static_cast<std::size_t>(leaf)];
    const auto& block = forest_.block(b);
    LeafCourant<Dim>& courant = out[static_cast<std::size_t>(leaf)];
    double along[n] = {};  // largest by place in a row
    double bad = 0;
    for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
      double sum[n] = {};
      for (int a = 0; a < Dim; ++a) {
        const IVec<Dim> s = face_strides<Dim>(a);
        const double* lo = w.block(a, b) + offset<Dim>(row, s);
        const double factor = dt / block.h[a];
        for (int i = 0; i < n; ++i)
          sum[i] += factor * std::max(std::abs(lo[i]), std::abs(lo[i + s[a]]));
      }
      double largest = 0;
      for (int i = 0; i < n; ++i) {
        largest = std::max(largest, sum[i]);
        along[i] = std::max(along[i], sum[i]);
        bad += sum[i];
      }
      for (int a = 1; a < Dim; ++a) {
        if (row[a] < courant_margin) courant.at_side(a, 0) = std::max(courant.at_side(a, 0), largest);
        if (row[a] >= n - courant_margin) courant.at_side(a, 1) = std::max(courant.at_side(a, 1), largest);
      }
    });
    for (int i = 0; i < n; ++i) {
      courant.largest = std::max(courant.largest, along[i]);
      if (i < courant_margin) courant.at_side(0, 0) = std::max(courant.at_side(0, 0), along[i]);
      if (i >= n - courant_margin) courant.at_side(0, 1) = std::max(courant.at_side(0, 1), along[i]);
    }
    if (!std::isfinite(bad)) courant.largest = std::nan("");
  });
  return out;
}

template <int Dim>
double Advection<Dim>::courant_number(const FaceField<double, Dim>& w, double dt) const {
  return largest_courant<Dim>(courant_numbers(w, dt));
}

template <int Dim>
void Advection<Dim>::water_fluxes(const Scope& scope, const FlowState<Dim>& state, int axis, double dt) {
  constexpr int n = BlockShape<Dim>::n;
  const IVec<Dim> fs = face_strides<Dim>(axis), cs = cell_strides<Dim>();
  mesh::for_each(scope.leaves, forest_.threads(), [&](int b) {
    const auto& block = forest_.block(b);
    const double* w = state.w.block(axis, b);
    double* g = swept_.block(axis, b);
    if (is_pure(scope, b)) {
      const double factor = planes_.surroundings(b) == BlockPhase::water ? dt : 0.0;
      for (int i = 0; i < BlockShape<Dim>::faces; ++i) g[i] = factor * w[i];
      return;
    }
    const double h = block.h[axis];
    IVec<Dim> lower = filled<Dim>(0), upper = faces_upper<Dim>(axis);
    for (int side = 0; side < 2; ++side) {
      if (!scope.is_closed(b, axis, side)) continue;
      (side == 0 ? lower[axis] : upper[axis]) = side == 0 ? 1 : n;
      const double* whole = recorded_.block(axis, b);
      field::for_side_faces<Dim>(axis, side, [&](int o) { g[o] = scope.share * whole[o]; });
    }
    for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
      const int o = offset<Dim>(i, fs);
      const double c = std::clamp(w[o] * dt / h, -1.0, 1.0);  // beyond only in leaves that are advanced again
      IVec<Dim> donor = i;
      if (c > 0) --donor[axis];
      if (donor[axis] >= 0 && donor[axis] < n) {
        const int cell = offset<Dim>(donor, cs);
        const double vof = state.vof.block(b)[cell];
        g[o] = h * (is_mixed(vof) ? swept_water<Dim>(planes_.plane(b, cell), vof, axis, c) : vof * c);
        return;
      }
      const int side = donor[axis] < 0 ? 0 : 1;
      const int nb = block.across(axis, side);
      if (nb == mesh::no_block) {  // inflow through the tank's side: as the cell inside
        IVec<Dim> inside = donor;
        inside[axis] += side == 0 ? 1 : -1;
        g[o] = h * c * state.vof.block(b)[offset<Dim>(inside, cs)];
      } else if (nb >= 0) {
        donor[axis] += side == 0 ? n : -n;
        const int cell = offset<Dim>(donor, cs);
        const double vof = state.vof.block(nb)[cell];
        const bool mixed = is_mixed(vof) && forest_.block(nb).leaf;  // behind a parent the fine fluxes count
        g[o] = h * (mixed ? swept_water<Dim>(planes_.plane(nb, cell), vof, axis, c) : vof * c);
      } else {  // coarser: the child cell that is not there, cut by the coarse plane
        const auto& parent = forest_.block(block.parent);
        const int coarse = parent.across(axis, side);
        IVec<Dim> at{};
        int child = 0;
        for (int a = 0; a < Dim; ++a) {
          if (a == axis) {
            at[a] = side == 0 ? n - 1 : 0;
            child |= (side == 0 ? 1 : 0) << a;
          } else {
            at[a] = (block.coord[a] & 1) * n / 2 + i[a] / 2;
            child |= (i[a] & 1) << a;
          }
        }
        const int cell = offset<Dim>(at, cs);
        double vof = state.vof.block(coarse)[cell];
        if (is_mixed(vof)) {
          const Plane<Dim> plane = child_plane<Dim>(planes_.plane(coarse, cell), child);
          vof = plane_fraction<Dim>(plane.normal, plane.d);
          g[o] = h * swept_water<Dim>(plane, vof, axis, c);
        } else {
          g[o] = h * vof * c;
        }
      }
    });
  });
  if (scope.part) field::restrict_faces<double, Dim>(forest_, *scope.part, swept_, axis);
  else field::restrict_faces<double, Dim>(forest_, swept_, axis);
}

template <int Dim>
void Advection<Dim>::update_vof(const Scope& scope, const FlowState<Dim>& state, int axis, double dt) {
  constexpr int n = BlockShape<Dim>::n;
  const IVec<Dim> fs = face_strides<Dim>(axis), cs = cell_strides<Dim>();
  mesh::for_each(scope.leaves, forest_.threads(), [&](int b) {
    const double* old = state.vof.block(b);
    double* out = vof_new_.block(b);
    if (is_pure(scope, b)) {
      std::copy(old, old + BlockShape<Dim>::cells, out);
      return;
    }
    const double inverse_h = 1.0 / forest_.block(b).h[axis];
    const double* w = state.w.block(axis, b);
    const double* g = swept_.block(axis, b);
    const double* start = vof_start_.block(b);
    for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
      const int f = offset<Dim>(row, fs), c = offset<Dim>(row, cs);
      for (int i = 0; i < n; ++i) {
        const double dilation = start[c + i] > 0.5 ? dt * (w[f + i + fs[axis]] - w[f + i]) : 0.0;
        double v = old[c + i] + inverse_h * (g[f + i] - g[f + i + fs[axis]] + dilation);
        if (v < 1e-13 && v > -1e-13) v = 0;
        if (v > 1 - 1e-13 && v < 1 + 1e-13) v = 1;
        out[c + i] = v;
      }
    });
  });
}

template <int Dim>
void Advection<Dim>::update_momentum(const Scope& scope, const FlowState<Dim>& state, int axis, double dt) {
  using Shape = ScratchShape<Dim>;
  const int S = Shape::stride(axis);
  const double jump = fluids_.rho_water - fluids_.rho_air;
  mesh::for_each(scope.leaves, forest_.threads(), [&](int b) {
    const auto& block = forest_.block(b);
    const double inverse_h = 1.0 / block.h[axis];
    const double cw = dt * inverse_h;
    const bool pure = is_pure(scope, b);
    Scratch<double, Dim> w, old_rho, new_rho, mass_flux;
    Scratch<double, Dim> flux, momentum, velocity;
    const bool turbulent = state.turbulent();
    field::gather_faces<double, Dim>(forest_, state.w, axis, b, 1, boundaries_, w, field::face_neighbours<Dim>());
    if (!pure) {
      field::gather_cells<double, Dim>(forest_, state.vof, b, 2, old_rho, field::around_axis<Dim>(axis));
      field::gather_cells<double, Dim>(forest_, vof_new_, b, 1, new_rho, field::face_neighbours<Dim>());
      field::gather_faces<double, Dim>(forest_, swept_, axis, b, 1, boundaries_, mass_flux, field::face_neighbours<Dim>());
      for (int i = 0; i < Shape::size; ++i) {  // the parts that are never filled are never used
        mass_flux.data[i] = fluids_.rho_air * cw * w.data[i] + jump * inverse_h * mass_flux.data[i];
        old_rho.data[i] = fluids_.rho_air + jump * std::clamp(old_rho.data[i], 0.0, 1.0);
        new_rho.data[i] = fluids_.rho_air + jump * std::clamp(new_rho.data[i], 0.0, 1.0);
      }
    }
    if (turbulent) {
      const SweepFluxes<Dim> fluxes{axis, pure, cw, w, mass_flux, old_rho, new_rho};
      sweep_scalar<Dim>(forest_, b, fluxes, state.tke, carried_start_[0], carried_new_[0]);
      sweep_scalar<Dim>(forest_, b, fluxes, state.epsilon, carried_start_[1], carried_new_[1]);
    }
    for (int a = 0; a < Dim; ++a) {
      const int A = Shape::stride(a);
      field::gather_faces<double, Dim>(forest_, state.u, a, b, 2, boundaries_, velocity, field::beside<Dim>(axis));
      const IVec<Dim> upper = faces_upper<Dim>(a);
      IVec<Dim> boundary_upper = upper;  // lower boundaries of the control volumes along the sweep
      ++boundary_upper[axis];
      const IVec<Dim> fs = face_strides<Dim>(a);
      const double* start = u_start_.block(a, b);
      double* out = u_new_.block(a, b);
      // The flux through the lower boundary of volume i: along the axis at the centre of cell i - 1, across
      // it the mean of the two cells that share the face.
      const int shift = a == axis ? -S : -A;
      const int rows = boundary_upper[0];
      for_rows<Dim>(filled<Dim>(0), boundary_upper, [&](const IVec<Dim>& row) {
        const int at = Shape::at(row);
        const double* u = velocity.data + at;
        double* f = flux.data + at;
        double* m = momentum.data + at;
        if (pure) {
          const double* ww = w.data + at;
          for (int i = 0; i < rows; ++i) {
            f[i] = 0.5 * cw * (ww[i + shift] + ww[i]);
            m[i] = f[i] * upwind(u[i - 2 * S], u[i - S], u[i], u[i + S], f[i], std::abs(f[i]));
          }
        } else {
          const double* mf = mass_flux.data + at;
          const double* rho = old_rho.data + at;
          for (int i = 0; i < rows; ++i) {
            f[i] = 0.5 * (mf[i + shift] + mf[i]);
            const double donor = f[i] > 0 ? rho[i - S - A] + rho[i - S] : rho[i - A] + rho[i];
            const double courant = std::min(1.0, 2 * std::abs(f[i]) / donor);
            m[i] = f[i] * upwind(u[i - 2 * S], u[i - S], u[i], u[i + S], f[i], courant);
          }
        }
      });
      const int count = upper[0];
      for_rows<Dim>(filled<Dim>(0), upper, [&](const IVec<Dim>& row) {
        const int at = Shape::at(row);
        const int o = offset<Dim>(row, fs);
        const double* u = velocity.data + at;
        const double* f = flux.data + at;
        const double* m = momentum.data + at;
        if (pure) {
          for (int i = 0; i < count; ++i)
            out[o + i] = u[i] - (m[i + S] - m[i]) + (f[i + S] - f[i]) * start[o + i];
        } else {
          const double* ro = old_rho.data + at;
          const double* rn = new_rho.data + at;
          for (int i = 0; i < count; ++i) {
            const double before = 0.5 * (ro[i - A] + ro[i]), after = 0.5 * (rn[i - A] + rn[i]);
            const double df = f[i + S] - f[i];
            const double now = (before * u[i] - (m[i + S] - m[i]) + (after - before + df) * start[o + i]) / after;
            out[o + i] = is_overdrawn(before, f[i], f[i + S], after) ? kept_in_range(now, u[i - S], u[i], u[i + S], start[o + i]) : now;
          }
        }
      });
      // Faces on the tank's fixed sides keep their value.
      for (int side = 0; side < 2; ++side) {
        if (block.across(a, side) != mesh::no_block ||
            boundaries_.kind[static_cast<std::size_t>(a)][static_cast<std::size_t>(side)] != BoundaryKind::fixed)
          continue;
        const double* u = state.u.block(a, b);
        field::for_side_faces<Dim>(a, side, [&](int o) { out[o] = u[o]; });
      }
    }
  });
}

template <int Dim>
void Advection<Dim>::start_from(const FlowState<Dim>& state) {
  vof_start_ = state.vof;
  u_start_ = state.u;
  if (state.turbulent()) {
    carried_start_ = {state.tke, state.epsilon};
    carried_new_[0].data().resize(state.tke.data().size());
    carried_new_[1].data().resize(state.tke.data().size());
  }
}

template <int Dim>
void Advection<Dim>::sweep(const FlowState<Dim>& state, int axis, double dt, const mesh::ForestPart<Dim>* region) {
  const Scope scope{forest_.leaves()};
  planes_.reconstruct(state.vof);
  water_fluxes(scope, state, axis, dt);
  update_vof(scope, state, axis, dt);
  if (region) bound_region(*region);
  field::restrict_cells<double, Dim>(forest_, vof_new_);
  update_momentum(scope, state, axis, dt);
  if (region) stop_region(state, *region);
  field::restrict_faces<double, Dim>(forest_, u_new_);
  for (auto& f : carried_new_)
    if (state.turbulent()) field::restrict_cells<double, Dim>(forest_, f);
}

/// What the last sweep made becomes the state.
template <int Dim>
void Advection<Dim>::take_new(FlowState<Dim>& state) {
  std::swap(state.vof, vof_new_);
  std::swap(state.u, u_new_);
  if (!state.turbulent()) return;
  std::swap(state.tke, carried_new_[0]);
  std::swap(state.epsilon, carried_new_[1]);
}

template <int Dim>
void Advection<Dim>::advance(FlowState<Dim>& state, double dt, std::int64_t step) {
  start_from(state);
  for (int k = 0; k < Dim; ++k) {
    const int axis = static_cast<int>((k + step) % Dim);
    sweep(state, axis, dt);
    if (visitor_) visitor_(axis, swept_);
    take_new(state);
  }
}

template class Advection<2>;
template class Advection<3>;

}  // namespace seaway::flow
