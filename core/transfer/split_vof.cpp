#include "core/transfer/split_vof.hpp"

#include <algorithm>

#include "core/field/gather.hpp"
#include "core/flow/plic.hpp"

namespace seaway::transfer {

template <int Dim>
void split_cell(double vof, const double* stencil, double* children) {
  constexpr int count = BlockShape<Dim>::children;
  if (!flow::is_mixed(vof)) {
    std::fill_n(children, count, vof);
    return;
  }
  flow::Plane<Dim> plane;
  plane.normal = flow::interface_normal<Dim>(stencil);
  plane.d = flow::plane_constant<Dim>(plane.normal, vof);
  double sum = 0;
  for (int c = 0; c < count; ++c) {
    const auto part = flow::child_plane<Dim>(plane, c);
    children[c] = std::clamp(flow::plane_fraction<Dim>(part.normal, part.d), 0.0, 1.0);
    sum += children[c];
  }
  // What rounding left over goes to the children in proportion to their room.
  const double rest = count * vof - sum;
  const double room = rest > 0 ? count - sum : sum;
  for (int c = 0; c < count; ++c) {
    const double share = rest > 0 ? 1 - children[c] : children[c];
    children[c] = std::clamp(children[c] + rest * share / room, 0.0, 1.0);
  }
}

template <int Dim>
void split_vof(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
               const CellField<double, Dim>& in, CellField<double, Dim>& out) {
  constexpr int half = BlockShape<Dim>::n / 2;
  const IVec<Dim> strides = field::cell_strides<Dim>();
  to.for_each_leaf([&](int b) {
    const BlockSource& source = pair.source(b);
    if (source.origin != Origin::refined) return;
    field::Scratch<double, Dim> scratch;
    field::gather_cells(from, in, source.block, 1, scratch);
    double* block = out.block(b);
    double stencil[Dim == 2 ? 9 : 27];
    double children[BlockShape<Dim>::children];
    field::for_box<Dim>(field::filled<Dim>(0), field::filled<Dim>(half), [&](const IVec<Dim>& i) {
      IVec<Dim> coarse = i;
      for (int a = 0; a < Dim; ++a) coarse[a] += (to.block(b).coord[a] & 1) * half;
      const double vof = scratch(coarse);
      if (flow::is_mixed(vof)) {
        IVec<Dim> lower = coarse, upper = coarse;
        for (int a = 0; a < Dim; ++a) --lower[a], upper[a] += 2;
        int e = 0;
        field::for_box<Dim>(lower, upper, [&](const IVec<Dim>& at) { stencil[e++] = scratch(at); });
      }
      split_cell<Dim>(vof, stencil, children);
      for (int c = 0; c < BlockShape<Dim>::children; ++c) {
        IVec<Dim> fine{};
        for (int a = 0; a < Dim; ++a) fine[a] = 2 * i[a] + ((c >> a) & 1);
        block[field::offset<Dim>(fine, strides)] = children[c];
      }
    });
  });
}

#define SEAWAY_INSTANTIATE(D)                                                                 \
  template void split_cell<D>(double, const double*, double*);                                \
  template void split_vof<D>(const Forest<D>&, const Forest<D>&, const MeshPair<D>&,          \
                             const CellField<double, D>&, CellField<double, D>&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::transfer
