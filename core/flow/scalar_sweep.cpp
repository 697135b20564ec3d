#include "core/flow/scalar_sweep.hpp"

namespace seaway::flow {

using field::cells_upper;
using field::filled;
using field::for_rows;
using field::Scratch;
using field::ScratchShape;

template <int Dim>
void sweep_scalar(const Forest<Dim>& forest, int b, const SweepFluxes<Dim>& fluxes,
                  const CellField<double, Dim>& scalar, const CellField<double, Dim>& start,
                  CellField<double, Dim>& out) {
  constexpr int n = BlockShape<Dim>::n;
  using Shape = ScratchShape<Dim>;
  const int axis = fluxes.axis, S = Shape::stride(axis);
  Scratch<double, Dim> value, carried;
  field::gather_cells<double, Dim>(forest, scalar, b, 2, value, field::beside<Dim>(axis));
  IVec<Dim> upper = cells_upper<Dim>();
  ++upper[axis];
  const int count = upper[0];
  for_rows<Dim>(filled<Dim>(0), upper, [&](const IVec<Dim>& row) {
    const int at = Shape::at(row);
    const double* v = value.data + at;
    double* c = carried.data + at;
    if (fluxes.pure) {
      const double* w = fluxes.w.data + at;
      for (int i = 0; i < count; ++i) {
        const double f = fluxes.courant_w * w[i];
        c[i] = f * upwind(v[i - 2 * S], v[i - S], v[i], v[i + S], f, std::abs(f));
      }
    } else {
      const double* f = fluxes.mass_flux.data + at;
      const double* rho = fluxes.old_rho.data + at;
      for (int i = 0; i < count; ++i) {
        const double courant = std::min(1.0, std::abs(f[i]) / (f[i] > 0 ? rho[i - S] : rho[i]));
        c[i] = f[i] * upwind(v[i - 2 * S], v[i - S], v[i], v[i + S], f[i], courant);
      }
    }
  });
  for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
    const int at = Shape::at(row);
    const int o = field::offset<Dim>(row, field::cell_strides<Dim>());
    const double* v = value.data + at;
    const double* c = carried.data + at;
    const double* s0 = start.block(b) + o;
    double* s = out.block(b) + o;
    const double* w = fluxes.w.data + at;
    const double* f = fluxes.mass_flux.data + at;
    const double* before = fluxes.old_rho.data + at;
    const double* after = fluxes.new_rho.data + at;
    if (fluxes.pure) {
      for (int i = 0; i < n; ++i) {
        const double left = v[i] - (c[i + S] - c[i]), dilation = fluxes.courant_w * (w[i + S] - w[i]);
        const double sum = left + dilation * s0[i];
        s[i] = sum > 0 ? sum : left / (1 - dilation);
      }
    } else {
      for (int i = 0; i < n; ++i) {
        const double left = before[i] * v[i] - (c[i + S] - c[i]), df = f[i + S] - f[i];
        const double sum = left + (after[i] - before[i] + df) * s0[i];
        s[i] = sum > 0 ? sum / after[i] : left / (before[i] - df);
        if (is_overdrawn(before[i], f[i], f[i + S], after[i])) s[i] = kept_in_range(s[i], v[i - S], v[i], v[i + S], s0[i]);
      }
    }
  });
}

template void sweep_scalar<2>(const Forest<2>&, int, const SweepFluxes<2>&, const CellField<double, 2>&,
                              const CellField<double, 2>&, CellField<double, 2>&);
template void sweep_scalar<3>(const Forest<3>&, int, const SweepFluxes<3>&, const CellField<double, 3>&,
                              const CellField<double, 3>&, CellField<double, 3>&);

}  // namespace seaway::flow
