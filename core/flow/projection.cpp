#include "core/flow/projection.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/field/restrict.hpp"
#include "core/flow/plic.hpp"

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

namespace {

/// The coarse cell behind fine face `i` (index on the side's plane).
template <int Dim>
int coarse_cell(const linear::CoarseSide<Dim>& from, const IVec<Dim>& i, int axis) {
  IVec<Dim> c = from.base;
  for (int a = 0; a < Dim; ++a)
    if (a != axis) c[a] += i[a] / 2;
  return offset<Dim>(c, cell_strides<Dim>());
}

/// Calls f(cell index on the side, face index) for all cells of a block's side.
template <int Dim, class F>
void for_side(int axis, int side, F&& f) {
  IVec<Dim> lower, upper;
  linear::side_box<Dim>(axis, side, lower, upper);
  for_box<Dim>(lower, upper, [&](const IVec<Dim>& cell) {
    IVec<Dim> face = cell;
    if (side == 1) ++face[axis];
    f(cell, face);
  });
}

}  // namespace

template <int Dim>
Projection<Dim>::Projection(const Forest<Dim>& forest, const FluidProperties& fluids,
                            const Boundaries<Dim>& boundaries)
    : forest_(forest), fluids_(fluids), boundaries_(boundaries), operator_(forest), multigrid_(operator_),
      cg_(forest), rhs_(forest), aperture_(forest, 1.0f) {
  for (const auto& sides : boundaries.kind)
    for (const BoundaryKind kind : sides) closed_ = closed_ && kind != BoundaryKind::open;
}

template <int Dim>
void Projection<Dim>::apply_gravity(FlowState<Dim>& state, double dt) const {
  constexpr int up = Dim - 1;
  const double g = fluids_.gravity;
  // Hydrostatic pressure of a cell over that of the surface at height z_surface; in a mixed cell as the
  // column of the discrete equations has it (docs/numerics.md, coarse-fine faces).
  const auto column = [&](double vof, double z, double h, double z_surface) {
    if (!is_mixed(vof)) return -g * fluids_.rho(vof) * (z - z_surface);
    const double jump = fluids_.rho_water - fluids_.rho_air;
    return g * h * (-0.5 * fluids_.rho_air + vof * fluids_.rho_air + 0.5 * vof * jump);
  };
  forest_.for_each_leaf([&](int b) {
    const auto& block = forest_.block(b);
    double* u = state.u.block(up, b);
    IVec<Dim> lower = filled<Dim>(0), upper = faces_upper<Dim>(up);
    for (int side = 0; side < 2; ++side) {
      const int nb = block.across(up, side);
      const bool fixed = nb == mesh::no_block &&
                         boundaries_.kind[up][static_cast<std::size_t>(side)] == BoundaryKind::fixed;
      if (fixed || nb == mesh::coarser_neighbour) side == 0 ? ++lower[up] : --upper[up];
    }
    const int count = upper[0] - lower[0];
    for_rows<Dim>(lower, upper, [&](const IVec<Dim>& row) {
      double* v = u + offset<Dim>(row, face_strides<Dim>(up));
      for (int i = 0; i < count; ++i) v[i] -= g * dt;
    });
    if (!forest_.touches_coarser(b)) return;
    const double* vof = state.vof.block(b);
    for (int axis = 0; axis < Dim; ++axis) {
      for (int side = 0; side < 2; ++side) {
        if (block.across(axis, side) != mesh::coarser_neighbour) continue;
        const auto from = linear::coarse_side<Dim>(forest_, block, axis, side);
        const auto& coarse = forest_.block(from.block);
        double* v = state.u.block(axis, b);
        for_side<Dim>(axis, side, [&](const IVec<Dim>& cell, const IVec<Dim>& face) {
          const double fine_vof = vof[offset<Dim>(cell, cell_strides<Dim>())];
          const double coarse_vof = state.vof.block(from.block)[coarse_cell<Dim>(from, cell, axis)];
          const double fine_h = block.h[up], coarse_h = coarse.h[up];
          const double fine_z = block.origin[up] + (cell[up] + 0.5) * fine_h;
          const int coarse_up = axis == up ? from.base[up] : from.base[up] + cell[up] / 2;
          const double coarse_z = coarse.origin[up] + (coarse_up + 0.5) * coarse_h;
          double z_surface = 0.5 * (fine_z + coarse_z);
          if (is_mixed(coarse_vof)) z_surface = coarse_z + (coarse_vof - 0.5) * coarse_h;
          if (is_mixed(fine_vof)) z_surface = fine_z + (fine_vof - 0.5) * fine_h;
          const double fine_p = column(fine_vof, fine_z, fine_h, z_surface);
          const double coarse_p = column(coarse_vof, coarse_z, coarse_h, z_surface);
          const double rise = side == 0 ? fine_p - coarse_p : coarse_p - fine_p;
          const double rho = (fluids_.rho(fine_vof) + 2 * fluids_.rho(coarse_vof)) / 3;
          v[offset<Dim>(face, face_strides<Dim>(axis))] += dt * rise / (rho * 1.5 * block.h[axis]);
        });
      }
    }
  });
  field::restrict_faces<double, Dim>(forest_, state.u);
}

template <int Dim>
void Projection<Dim>::prepare(const FlowState<Dim>& state, const HullMask<Dim>* mask,
                              const std::vector<char>* free_cells) {
  constexpr int n = BlockShape<Dim>::n;
  for (const int b : masked_blocks_)
    for (int axis = 0; axis < Dim; ++axis)
      std::fill_n(aperture_.block(axis, b), BlockShape<Dim>::faces, 1.0f);
  masked_blocks_.clear();
  if (mask) {
    for (int axis = 0; axis < Dim; ++axis)
      mask->window().store_faces(mask->half().aperture[static_cast<std::size_t>(axis)], axis, aperture_);
    for (const auto& tile : mask->window().tiles()) masked_blocks_.push_back(tile.block);
  }
  forest_.for_each_leaf([&](int b) {
    const auto& block = forest_.block(b);
    Scratch<double, Dim> rho;
    field::gather_cells<double, Dim>(forest_, state.vof, b, 1, rho);
    for (double& c : rho.data) c = fluids_.rho(c);
    for (int axis = 0; axis < Dim; ++axis) {
      const int S = ScratchShape<Dim>::stride(axis);
      const IVec<Dim> fs = face_strides<Dim>(axis);
      float* c = operator_.coefficients().block(axis, b);
      const float* a = aperture_.block(axis, b);
      const double factor = 2 * block.cell_volume() / (block.h[axis] * block.h[axis]);
      const int count = n + (axis == 0);
      for_rows<Dim>(filled<Dim>(0), faces_upper<Dim>(axis), [&](const IVec<Dim>& row) {
        const double* r = &rho(row);
        const int o = offset<Dim>(row, fs);
        for (int i = 0; i < count; ++i)
          c[o + i] = static_cast<float>(static_cast<double>(a[o + i]) * factor / (r[i - S] + r[i]));
      });
      for (int side = 0; side < 2; ++side) {
        const int nb = block.across(axis, side);
        if (nb == mesh::no_block) {
          const bool open = boundaries_.kind[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)] ==
                            BoundaryKind::open;
          for_side<Dim>(axis, side, [&](const IVec<Dim>&, const IVec<Dim>& face) {
            c[offset<Dim>(face, fs)] *= open ? 2.0f : 0.0f;  // pressure 0 half a cell away, or a wall
          });
        } else if (nb == mesh::coarser_neighbour) {
          const auto from = linear::coarse_side<Dim>(forest_, block, axis, side);
          const double area = block.cell_volume() / block.h[axis];
          for_side<Dim>(axis, side, [&](const IVec<Dim>& cell, const IVec<Dim>& face) {
            const double coarse = fluids_.rho(state.vof.block(from.block)[coarse_cell<Dim>(from, cell, axis)]);
            const double mean = (rho(cell) + 2 * coarse) / 3;
            c[offset<Dim>(face, fs)] = static_cast<float>(area / (mean * 1.5 * block.h[axis]));
          });
        }
      }
    }
  });
  if (free_cells) close_kept_faces(*free_cells);
  operator_.finish();
  multigrid_.update();
  operator_.rigid() = {};
  if (mask) operator_.rigid() = mask->rigid_rows(mask->half());
}

template <int Dim>
void Projection<Dim>::right_side(const FlowState<Dim>& state, double dt, CellField<double, Dim>& b) const {
  forest_.for_each_leaf([&](int blk) {
    const auto& block = forest_.block(blk);
    double* out = b.block(blk);
    for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
      constexpr int n = BlockShape<Dim>::n;
      double* r = out + offset<Dim>(row, cell_strides<Dim>());
      for (int i = 0; i < n; ++i) r[i] = 0;
      for (int axis = 0; axis < Dim; ++axis) {
        const IVec<Dim> fs = face_strides<Dim>(axis);
        const double factor = block.cell_volume() / (block.h[axis] * dt);
        const double* w = state.w.block(axis, blk) + offset<Dim>(row, fs);
        for (int i = 0; i < n; ++i) r[i] -= factor * (w[i + fs[axis]] - w[i]);
      }
    });
  });
}

template <int Dim>
void Projection<Dim>::correct(FlowState<Dim>& state, const CellField<double, Dim>& pressure, double dt,
                              bool mixture_too) const {
  forest_.for_each_leaf([&](int b) {
    constexpr int n = BlockShape<Dim>::n;
    const auto& block = forest_.block(b);
    Scratch<double, Dim> p;
    linear::load_cells<double, Dim>(pressure.block(b), p);
    linear::load_ghosts<double, Dim>(forest_, b, linear::CoarseGhost::value,
                                     [&](int nb) { return pressure.block(nb); }, p);
    for (int axis = 0; axis < Dim; ++axis) {
      const int S = ScratchShape<Dim>::stride(axis);
      const float* c = operator_.coefficients().block(axis, b);
      const float* a = aperture_.block(axis, b);
      double* u = state.u.block(axis, b);
      double* w = state.w.block(axis, b);
      const double factor = dt * block.h[axis] / block.cell_volume();
      const int count = n + (axis == 0);
      for_rows<Dim>(filled<Dim>(0), faces_upper<Dim>(axis), [&](const IVec<Dim>& row) {
        const double* pr = &p(row);
        const int o = offset<Dim>(row, face_strides<Dim>(axis));
        for (int i = 0; i < count; ++i) {
          const double aperture = static_cast<double>(a[o + i]);
          const double inverse = aperture > 0 ? 1 / aperture : 0.0;
          const double flux = factor * static_cast<double>(c[o + i]) * (pr[i] - pr[i - S]);
          u[o + i] -= inverse * flux;
          if (mixture_too) w[o + i] -= flux;
        }
      });
    }
  });
  field::restrict_faces<double, Dim>(forest_, state.u);
}

template <int Dim>
void Projection<Dim>::mixture_velocity(FlowState<Dim>& state, const HullMask<Dim>* mask,
                                       const motion::Twist<Dim>& twist, const SlipFlux<Dim>* slip) const {
  for (int axis = 0; axis < Dim; ++axis) {
    state.w.data(axis) = state.u.data(axis);
    if (!mask) continue;
    std::vector<double> u, w;
    mask->window().load_faces(state.u, axis, u);
    mask->mixture_velocity(axis, twist, u, w);
    if (slip && !slip->through(axis).empty())
      std::transform(w.begin(), w.end(), slip->through(axis).begin(), w.begin(), std::plus<>());
    mask->window().store_faces(w, axis, state.w);
  }
  field::restrict_faces<double, Dim>(forest_, state.w);
}

template <int Dim>
double Projection<Dim>::divergence(const FlowState<Dim>& state, double dt) const {
  return dt * forest_.max_over_leaves(0.0, [&](int b) {
    const auto& block = forest_.block(b);
    double largest = 0;
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      double div = 0;
      for (int axis = 0; axis < Dim; ++axis) {
        const IVec<Dim> fs = face_strides<Dim>(axis);
        const double* w = state.w.block(axis, b) + offset<Dim>(i, fs);
        div += (w[fs[axis]] - w[0]) / block.h[axis];
      }
      if (!(std::abs(div) <= largest)) largest = std::abs(div);
    });
    return largest;
  });
}

template <int Dim>
linear::SolveReport Projection<Dim>::project(FlowState<Dim>& state, const HullMask<Dim>* mask,
                                             motion::Twist<Dim>& twist,
                                             const motion::DofMatrix<Dim>& inverse_mass, double dt,
                                             const ProjectionOptions& options, const SlipFlux<Dim>* slip) {
  mixture_velocity(state, mask, twist, slip);
  right_side(state, dt, rhs_);
  if (closed_) {  // consistent up to rounding: keep the mean out
    double volume = 0;
    const double sum = forest_.sum_over_leaves([&](int b) {
      double s = 0;
      for (int i = 0; i < BlockShape<Dim>::cells; ++i) s += rhs_.block(b)[i];
      return s;
    });
    for (const int b : forest_.leaves()) volume += forest_.block(b).cell_volume() * BlockShape<Dim>::cells;
    if (std::abs(sum) * dt * dt / volume < 1e-6 && !mask) {
      forest_.for_each_leaf([&](int b) {
        const double part = sum / volume * forest_.block(b).cell_volume();
        for (int i = 0; i < BlockShape<Dim>::cells; ++i) rhs_.block(b)[i] -= part;
      });
    }
  }
  auto& rigid = operator_.rigid();
  rigid.inverse_mass = inverse_mass;
  const bool moves = inverse_mass.cwiseAbs().maxCoeff() > 0;
  linear::RigidRows<Dim> held;
  if (!moves) std::swap(held, rigid);
  const auto report = cg_.solve(operator_, multigrid_, rhs_, state.p, options.tolerance / (dt * dt),
                                options.max_iterations);
  if (!moves) std::swap(held, rigid);
  correct(state, state.p, dt, false);
  if (moves) twist += dt * (inverse_mass * rigid.gather(state.p.data()));
  field::restrict_cells<double, Dim>(forest_, state.p);
  mixture_velocity(state, mask, twist, slip);
  return report;
}

template class Projection<2>;
template class Projection<3>;

}  // namespace seaway::flow
