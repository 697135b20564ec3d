#include "core/flow/viscosity.hpp"

#include "core/field/restrict.hpp"

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
void Viscosity<Dim>::apply(FlowState<Dim>& state, double dt) {
  constexpr int n = BlockShape<Dim>::n;
  forest_.for_each_leaf([&](int b) {
    const auto& block = forest_.block(b);
    Scratch<double, Dim> vof, u;
    field::gather_cells<double, Dim>(forest_, state.vof, b, 1, vof);
    for (int a = 0; a < Dim; ++a) {
      field::gather_faces<double, Dim>(forest_, state.u, a, b, 1, boundaries_, u);
      const double* old = state.u.block(a, b);
      double* out = u_new_.block(a, b);
      const int A = ScratchShape<Dim>::stride(a);
      const int count = n + (a == 0);
      std::array<double, Dim> factor{};
      for (int d = 0; d < Dim; ++d) factor[static_cast<std::size_t>(d)] = dt / (block.h[d] * block.h[d]);
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
          out[o + i] = v[i] + mu / rho * sum;
        }
      });
      for (int side = 0; side < 2; ++side) {  // fixed sides keep their value
        if (block.neighbour[static_cast<std::size_t>(mesh::face_neighbour<Dim>(a, side))] != mesh::no_block) continue;
        if (boundaries_.kind[static_cast<std::size_t>(a)][static_cast<std::size_t>(side)] != BoundaryKind::fixed) continue;
        IVec<Dim> lower = filled<Dim>(0), upper = cells_upper<Dim>();
        lower[a] = side == 0 ? 0 : n;
        upper[a] = lower[a] + 1;
        field::for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
          const int o = offset<Dim>(i, face_strides<Dim>(a));
          out[o] = old[o];
        });
      }
    }
  });
  std::swap(state.u, u_new_);
  field::restrict_faces<double, Dim>(forest_, state.u);
}

template class Viscosity<2>;
template class Viscosity<3>;

}  // namespace seaway::flow
