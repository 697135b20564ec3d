#include "core/flow/viscosity.hpp"

#include "core/field/restrict.hpp"
#include "core/flow/plic.hpp"
#include "core/flow/super_steps.hpp"

namespace seaway::flow {

using field::cells_upper;
using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_rows;
using field::offset;
using field::Scratch;
using field::ScratchShape;

template <int Dim>
double Viscosity<Dim>::step_limit() const {
  const double h = forest_.cell_size(forest_.n_levels() - 1).minCoeff();
  return h * h / (2 * Dim * std::max(fluids_.nu_air, fluids_.nu_water));
}

template <int Dim>
double Viscosity<Dim>::explicit_limit(const FlowState<Dim>& state, const CellField<double, Dim>& nu_t) const {
  const double nu = std::max(fluids_.nu_air, fluids_.nu_water);
  const double rate = forest_.max_over_leaves(0.0, [&](int b) {
    const auto& block = forest_.block(b);
    double largest = 0;
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      // Harmonic means beside a light cell reach twice its own viscosity.
      const double factor = is_mixed(state.vof.block(b)[i]) ? 2 : 1;
      largest = std::max(largest, factor * (nu + nu_t.block(b)[i]));
    }
    // The transposed gradient doubles the rate along one axis.
    double sum = 1 / (block.h.minCoeff() * block.h.minCoeff());
    for (int a = 0; a < Dim; ++a) sum += 1 / (block.h[a] * block.h[a]);
    return 2 * largest * sum;
  });
  return rate > 0 ? 1 / rate : 1e300;
}

/// Faces on the tank's fixed sides keep their value.
template <int Dim>
void Viscosity<Dim>::keep_fixed_sides(const FlowState<Dim>& state, int a, int b) {
  const auto& block = forest_.block(b);
  for (int side = 0; side < 2; ++side) {
    if (block.neighbour[static_cast<std::size_t>(mesh::face_neighbour<Dim>(a, side))] != mesh::no_block) continue;
    if (boundaries_.kind[static_cast<std::size_t>(a)][static_cast<std::size_t>(side)] != BoundaryKind::fixed) continue;
    IVec<Dim> lower = filled<Dim>(0), upper = cells_upper<Dim>();
    lower[a] = side == 0 ? 0 : BlockShape<Dim>::n;
    upper[a] = lower[a] + 1;
    field::for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
      const int o = offset<Dim>(i, face_strides<Dim>(a));
      u_new_.block(a, b)[o] = state.u.block(a, b)[o];
    });
  }
}

template <int Dim>
void Viscosity<Dim>::laminar_stage(const FlowState<Dim>& state, const Stage& stage) {
  constexpr int n = BlockShape<Dim>::n;
  forest_.for_each_leaf([&](int b) {
    const auto& block = forest_.block(b);
    Scratch<double, Dim> vof, u;
    field::gather_cells<double, Dim>(forest_, state.vof, b, 1, vof);
    for (int a = 0; a < Dim; ++a) {
      field::gather_faces<double, Dim>(forest_, state.u, a, b, 1, boundaries_, u);
      double* out = u_new_.block(a, b);
      const int A = ScratchShape<Dim>::stride(a);
      const int count = n + (a == 0);
      std::array<double, Dim> factor{};
      for (int d = 0; d < Dim; ++d) factor[static_cast<std::size_t>(d)] = stage.dt / (block.h[d] * block.h[d]);
      for_rows<Dim>(filled<Dim>(0), faces_upper<Dim>(a), [&](const IVec<Dim>& row) {
        const double* v = &u(row);
        const double* c = &vof(row);
        const int o = offset<Dim>(row, face_strides<Dim>(a));
        for (int i = 0; i < count; ++i) {
          const double water = 0.5 * (c[i] + c[i - A]);
          const double rho = fluids_.rho(water);
          const double mu = water * fluids_.rho_water * fluids_.nu_water +
                            (1 - water) * fluids_.rho_air * fluids_.nu_air;
          double sum = 0;
          for (int d = 0; d < Dim; ++d) {
            const int s = ScratchShape<Dim>::stride(d);
            sum += factor[static_cast<std::size_t>(d)] * (v[i + s] - 2 * v[i] + v[i - s]);
          }
          const double old = stage.first ? v[i] : stage.previous * v[i] + stage.before * out[o + i];
          out[o + i] = old + mu / rho * sum;
        }
      });
      keep_fixed_sides(state, a, b);
    }
  });
}

template <int Dim>
void Viscosity<Dim>::turbulent_stage(const FlowState<Dim>& state, const Stage& stage,
                                     const CellField<double, Dim>& nu_t) {
  constexpr int n = BlockShape<Dim>::n;
  using Shape = ScratchShape<Dim>;
  forest_.for_each_leaf([&](int b) {
    const auto& block = forest_.block(b);
    Scratch<double, Dim> rho, specific, nu;  // specific volume 1 / rho, nu + nu_t
    std::array<Scratch<double, Dim>, Dim> u;
    field::gather_cells<double, Dim>(forest_, state.vof, b, 1, rho);
    field::gather_cells<double, Dim>(forest_, nu_t, b, 1, nu);
    for (int a = 0; a < Dim; ++a)
      field::gather_faces<double, Dim>(forest_, state.u, a, b, 1, boundaries_, u[static_cast<std::size_t>(a)]);
    for_rows<Dim>(filled<Dim>(-1), filled<Dim>(n + 1), [&](const IVec<Dim>& row) {
      double* r = &rho(row);
      double* s = &specific(row);
      double* m = &nu(row);
      for (int i = 0; i < n + 2; ++i) {
        const double molecular = r[i] * fluids_.rho_water * fluids_.nu_water +
                                 (1 - r[i]) * fluids_.rho_air * fluids_.nu_air;
        r[i] = fluids_.rho(r[i]);
        s[i] = 1 / r[i];
        m[i] += molecular * s[i];
      }
    });
    for (int a = 0; a < Dim; ++a) {
      const int A = Shape::stride(a);
      const Vec<Dim> inverse_h = block.h.cwiseInverse();
      const int count = n + (a == 0);
      double* out = u_new_.block(a, b);
      for_rows<Dim>(filled<Dim>(0), faces_upper<Dim>(a), [&](const IVec<Dim>& row) {
        const int at = Shape::at(row);
        const double* v = u[static_cast<std::size_t>(a)].data + at;
        const double* m = nu.data + at;
        const double* s = specific.data + at;
        const double* r = rho.data + at;
        double sum[n + 1];
        for (int i = 0; i < count; ++i)
          sum[i] = 2 * inverse_h[a] * inverse_h[a] * (r[i] * m[i] * (v[i + A] - v[i]) - r[i - A] * m[i - A] * (v[i] - v[i - A]));
        for (int d = 0; d < Dim; ++d) {
          if (d == a) continue;
          const int B = Shape::stride(d);
          const double* w = u[static_cast<std::size_t>(d)].data + at;
          for (int i = 0; i < count; ++i) {
            const double here = m[i] + m[i - A], volume = s[i] + s[i - A];
            const double low = (here + m[i - B] + m[i - A - B]) / (volume + s[i - B] + s[i - A - B]) *
                               (inverse_h[d] * (v[i] - v[i - B]) + inverse_h[a] * (w[i] - w[i - A]));
            const double high = (here + m[i + B] + m[i - A + B]) / (volume + s[i + B] + s[i - A + B]) *
                                (inverse_h[d] * (v[i + B] - v[i]) + inverse_h[a] * (w[i + B] - w[i + B - A]));
            sum[i] += inverse_h[d] * (high - low);
          }
        }
        const int o = offset<Dim>(row, face_strides<Dim>(a));
        for (int i = 0; i < count; ++i) {
          const double old = stage.first ? v[i] : stage.previous * v[i] + stage.before * out[o + i];
          out[o + i] = old + 2 * stage.dt / (r[i] + r[i - A]) * sum[i];
        }
      });
      keep_fixed_sides(state, a, b);
    }
  });
}

template <int Dim>
int Viscosity<Dim>::apply(FlowState<Dim>& state, double dt, const CellField<double, Dim>* nu_t) {
  const int stages = super_stages(dt / (0.9 * (nu_t ? explicit_limit(state, *nu_t) : step_limit())));
  for (int j = 1; j <= stages; ++j) {
    const SuperStep weight = super_step(j, stages);
    const Stage stage{weight.rate * dt, weight.previous, weight.before, j == 1};
    if (nu_t) turbulent_stage(state, stage, *nu_t);
    else laminar_stage(state, stage);
    std::swap(state.u, u_new_);
    field::restrict_faces<double, Dim>(forest_, state.u);
  }
  return stages;
}

template class Viscosity<2>;
template class Viscosity<3>;

}  // namespace seaway::flow
