#include "core/transfer/coarsen.hpp"

#include <algorithm>

namespace seaway::transfer {
namespace {

using field::for_box;
using field::offset;

/// Means of the values below block `b`, on the cells (axis < 0) or the faces of `axis` of `b`.
/// `leaf_data(b)` gives the values of a leaf.
template <int Dim, class LeafData>
void means_below(const Forest<Dim>& forest, int b, int axis, const LeafData& leaf_data, double* out) {
  constexpr int half = BlockShape<Dim>::n / 2;
  const IVec<Dim> strides = axis < 0 ? field::cell_strides<Dim>() : field::face_strides<Dim>(axis);
  const int size = axis < 0 ? BlockShape<Dim>::cells : BlockShape<Dim>::faces;
  const double share = (axis < 0 ? 1.0 : 2.0) / BlockShape<Dim>::children;
  std::vector<double> below;
  for (int c = 0; c < BlockShape<Dim>::children; ++c) {
    const int child = forest.block(b).child[static_cast<std::size_t>(c)];
    const double* fine = nullptr;
    if (forest.block(child).leaf) {
      fine = leaf_data(child);
    } else {
      below.resize(static_cast<std::size_t>(size));
      means_below<Dim>(forest, child, axis, leaf_data, below.data());
      fine = below.data();
    }
    IVec<Dim> upper = field::filled<Dim>(half);
    if (axis >= 0) ++upper[axis];
    for_box<Dim>(field::filled<Dim>(0), upper, [&](const IVec<Dim>& i) {
      double sum = 0;
      for (int s = 0; s < BlockShape<Dim>::children; ++s) {
        if (axis >= 0 && ((s >> axis) & 1)) continue;
        IVec<Dim> at{};
        for (int a = 0; a < Dim; ++a) at[a] = 2 * i[a] + ((s >> a) & 1);
        sum += fine[offset<Dim>(at, strides)];
      }
      IVec<Dim> to{};
      for (int a = 0; a < Dim; ++a) to[a] = i[a] + ((c >> a) & 1) * half;
      out[offset<Dim>(to, strides)] = sum * share;
    });
  }
}

}  // namespace

template <int Dim>
void copy_or_coarsen(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
                     const CellField<double, Dim>& in, CellField<double, Dim>& out) {
  to.for_each_leaf([&](int b) {
    const BlockSource& s = pair.source(b);
    if (s.origin == Origin::kept) std::copy_n(in.block(s.block), BlockShape<Dim>::cells, out.block(b));
    if (s.origin == Origin::coarsened)
      means_below<Dim>(from, s.block, -1, [&](int leaf) { return in.block(leaf); }, out.block(b));
  });
}

template <int Dim>
void copy_or_coarsen(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
                     const FaceField<double, Dim>& in, FaceField<double, Dim>& out) {
  to.for_each_leaf([&](int b) {
    const BlockSource& s = pair.source(b);
    for (int axis = 0; axis < Dim; ++axis) {
      if (s.origin == Origin::kept)
        std::copy_n(in.block(axis, s.block), BlockShape<Dim>::faces, out.block(axis, b));
      if (s.origin == Origin::coarsened)
        means_below<Dim>(from, s.block, axis, [&](int leaf) { return in.block(axis, leaf); },
                         out.block(axis, b));
    }
  });
}

#define SEAWAY_INSTANTIATE(D)                                                                       \
  template void copy_or_coarsen<D>(const Forest<D>&, const Forest<D>&, const MeshPair<D>&,           \
                                   const CellField<double, D>&, CellField<double, D>&);              \
  template void copy_or_coarsen<D>(const Forest<D>&, const Forest<D>&, const MeshPair<D>&,           \
                                   const FaceField<double, D>&, FaceField<double, D>&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::transfer
