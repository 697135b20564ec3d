#include "core/flow/viscosity.hpp"

#include "core/field/restrict.hpp"
#include "core/flow/plic.hpp"
#include "core/flow/super_steps.hpp"

namespace seaway::flow {

using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_rows;
using field::offset;
using field::Scratch;
using field::ScratchShape;

namespace {

/// Rate of the fastest decay that a viscosity causes in cells of h [1/s]: the transposed gradient doubles it along one axis.
template <int Dim>
double fastest_rate(double nu, const Vec<Dim>& h) {
  double sum = 1 / (h.minCoeff() * h.minCoeff());
  for (int a = 0; a < Dim; ++a) sum += 1 / (h[a] * h[a]);
  return 2 * nu * sum;
}

/// Harmonic means beside a light cell reach so many times its own viscosity.
constexpr double beside_light_cells = 2;

/// Whether a block and the layer of cells around it hold one fluid.
template <int Dim>
bool one_fluid(const Scratch<double, Dim>& vof) {
  int water = 0, air = 0, all = 0;
  for_rows<Dim>(filled<Dim>(-1), filled<Dim>(BlockShape<Dim>::n + 1), [&](const IVec<Dim>& row) {
    const double* c = &vof(row);
    for (int i = 0; i < BlockShape<Dim>::n + 2; ++i) {
      water += c[i] >= 1 - mixed_limit;
      air += c[i] <= mixed_limit;
    }
    all += BlockShape<Dim>::n + 2;
  });
  return water == all || air == all;
}

}  // namespace

template <int Dim>
double Viscosity<Dim>::step_limit() const {
  const double nu = beside_light_cells * std::max(fluids_.nu_air, fluids_.nu_water);
  return 1 / fastest_rate<Dim>(nu, forest_.cell_size(forest_.n_levels() - 1));
}

template <int Dim>
double Viscosity<Dim>::explicit_limit(const FlowState<Dim>& state, const CellField<double, Dim>& nu_t) const {
  const double nu = std::max(fluids_.nu_air, fluids_.nu_water);
  const double rate = forest_.max_over_leaves(0.0, [&](int b) {
    double largest = 0;
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      const double factor = is_mixed(state.vof.block(b)[i]) ? beside_light_cells : 1;
      largest = std::max(largest, factor * (nu + nu_t.block(b)[i]));
    }
    return fastest_rate<Dim>(largest, forest_.block(b).h);
  });
  return rate > 0 ? 1 / rate : 1e300;
}

/// Faces on the tank's fixed sides keep their value.
template <int Dim>
void Viscosity<Dim>::keep_fixed_sides(const FlowState<Dim>& state, int a, int b) {
  const auto& block = forest_.block(b);
  for (int side = 0; side < 2; ++side) {
    if (block.across(a, side) != mesh::no_block) continue;
    if (boundaries_.kind[static_cast<std::size_t>(a)][static_cast<std::size_t>(side)] != BoundaryKind::fixed) continue;
    field::for_side_faces<Dim>(a, side, [&](int o) { u_new_.block(a, b)[o] = state.u.block(a, b)[o]; });
  }
}

/// As stress_in for a constant viscosity `nu` and density.
template <int Dim>
void Viscosity<Dim>::uniform_stress_in(int b, const Stage& stage, const std::array<Scratch<double, Dim>, Dim>& u, double nu) {
  const Vec<Dim> inverse_h = forest_.block(b).h.cwiseInverse();
  for (int a = 0; a < Dim; ++a) {
    const int A = ScratchShape<Dim>::stride(a), count = BlockShape<Dim>::n + (a == 0);
    double* out = u_new_.block(a, b);
    for_rows<Dim>(filled<Dim>(0), faces_upper<Dim>(a), [&](const IVec<Dim>& row) {
      const int at = ScratchShape<Dim>::at(row);
      const double* v = u[static_cast<std::size_t>(a)].data + at;
      double sum[BlockShape<Dim>::n + 1];
      for (int i = 0; i < count; ++i) sum[i] = 2 * inverse_h[a] * inverse_h[a] * ((v[i + A] - v[i]) - (v[i] - v[i - A]));
      for (int d = 0; d < Dim; ++d) {
        if (d == a) continue;
        const int B = ScratchShape<Dim>::stride(d);
        const double* w = u[static_cast<std::size_t>(d)].data + at;
        for (int i = 0; i < count; ++i) {
          const double low = inverse_h[d] * (v[i] - v[i - B]) + inverse_h[a] * (w[i] - w[i - A]);
          const double high = inverse_h[d] * (v[i + B] - v[i]) + inverse_h[a] * (w[i + B] - w[i + B - A]);
          sum[i] += inverse_h[d] * (high - low);
        }
      }
      const int o = offset<Dim>(row, face_strides<Dim>(a));
      for (int i = 0; i < count; ++i) {
        const double old = stage.first ? v[i] : stage.previous * v[i] + stage.before * out[o + i];
        out[o + i] = old + stage.dt * nu * sum[i];
      }
    });
  }
}

/// A stage in one block: `rho` holds the volume fractions, `nu` the eddy viscosity; both are used up.
template <int Dim>
void Viscosity<Dim>::stress_in(int b, const Stage& stage, const std::array<Scratch<double, Dim>, Dim>& u, Scratch<double, Dim>& rho,
                               Scratch<double, Dim>& nu) {
  constexpr int n = BlockShape<Dim>::n;
  const auto& block = forest_.block(b);
  Scratch<double, Dim> specific;  // volume, 1 / rho
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
    const int A = ScratchShape<Dim>::stride(a);
    const Vec<Dim> inverse_h = block.h.cwiseInverse();
    const int count = n + (a == 0);
    double* out = u_new_.block(a, b);
    for_rows<Dim>(filled<Dim>(0), faces_upper<Dim>(a), [&](const IVec<Dim>& row) {
      const int at = ScratchShape<Dim>::at(row);
      const double* v = u[static_cast<std::size_t>(a)].data + at;
      const double* m = nu.data + at;
      const double* s = specific.data + at;
      const double* r = rho.data + at;
      double sum[BlockShape<Dim>::n + 1];
      for (int i = 0; i < count; ++i)
        sum[i] = 2 * inverse_h[a] * inverse_h[a] * (r[i] * m[i] * (v[i + A] - v[i]) - r[i - A] * m[i - A] * (v[i] - v[i - A]));
      for (int d = 0; d < Dim; ++d) {
        if (d == a) continue;
        const int B = ScratchShape<Dim>::stride(d);
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
  }
}

template <int Dim>
void Viscosity<Dim>::take_stage(const FlowState<Dim>& state, const Stage& stage, const CellField<double, Dim>* nu_t) {
  forest_.for_each_leaf([&](int b) {
    Scratch<double, Dim> vof;
    std::array<Scratch<double, Dim>, Dim> u;
    field::gather_cells<double, Dim>(forest_, state.vof, b, 1, vof);
    for (int a = 0; a < Dim; ++a)
      field::gather_faces<double, Dim>(forest_, state.u, a, b, 1, boundaries_, u[static_cast<std::size_t>(a)]);
    if (!nu_t && one_fluid<Dim>(vof)) {
      uniform_stress_in(b, stage, u, vof(filled<Dim>(0)) > 0.5 ? fluids_.nu_water : fluids_.nu_air);
    } else {
      Scratch<double, Dim> nu{};
      if (nu_t) field::gather_cells<double, Dim>(forest_, *nu_t, b, 1, nu);
      stress_in(b, stage, u, vof, nu);
    }
    for (int a = 0; a < Dim; ++a) keep_fixed_sides(state, a, b);
  });
}

template <int Dim>
int Viscosity<Dim>::apply(FlowState<Dim>& state, double dt, const CellField<double, Dim>* nu_t) {
  const int stages = super_stages(dt / (0.9 * (nu_t ? explicit_limit(state, *nu_t) : step_limit())));
  for (int j = 1; j <= stages; ++j) {
    const SuperStep weight = super_step(j, stages);
    take_stage(state, {weight.rate * dt, weight.previous, weight.before, j == 1}, nu_t);
    std::swap(state.u, u_new_);
    field::restrict_faces<double, Dim>(forest_, state.u);
  }
  return stages;
}

template class Viscosity<2>;
template class Viscosity<3>;

}  // namespace seaway::flow
