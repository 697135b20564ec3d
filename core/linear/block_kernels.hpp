// What the kernels of the pressure solve share: a block of cells with one ghost layer across its faces.
#pragma once

#include "core/field/scratch.hpp"

namespace seaway::linear {

using field::BlockShape;
using field::CellField;
using field::FaceField;
using field::Forest;
using field::Scratch;
using field::ScratchShape;

/// What stands behind a face where the neighbour is coarser.
enum class CoarseGhost { zero, value };

/// The side of the coarser leaf that a fine block's face touches: cell (i..) of the fine face lies in coarse
/// cell base + i / 2.
template <int Dim>
struct CoarseSide {
  int block = 0;
  IVec<Dim> base{};
};

template <int Dim>
CoarseSide<Dim> coarse_side(const Forest<Dim>& forest, const mesh::Block<Dim>& fine, int axis, int side) {
  const mesh::Block<Dim>& parent = forest.block(fine.parent);
  CoarseSide<Dim> out;
  out.block = parent.across(axis, side);
  for (int a = 0; a < Dim; ++a) out.base[a] = (fine.coord[a] & 1) * BlockShape<Dim>::n / 2;
  out.base[axis] = side == 0 ? BlockShape<Dim>::n - 1 : 0;
  return out;
}

/// Box of a block's cells that lie on a side.
template <int Dim>
inline void side_box(int axis, int side, IVec<Dim>& lower, IVec<Dim>& upper) {
  lower = field::filled<Dim>(0);
  upper = field::cells_upper<Dim>();
  if (side == 0) upper[axis] = 1;
  else lower[axis] = BlockShape<Dim>::n - 1;
}

/// Copies the block's cells into the scratch.
template <class T, int Dim>
inline void load_cells(const T* block, Scratch<T, Dim>& out) {
  constexpr int n = BlockShape<Dim>::n;
  constexpr IVec<Dim> strides = field::cell_strides<Dim>();
  field::for_rows<Dim>(field::filled<Dim>(0), field::cells_upper<Dim>(), [&](const IVec<Dim>& row) {
    const T* s = block + field::offset<Dim>(row, strides);
    T* d = &out(row);
    for (int i = 0; i < n; ++i) d[i] = s[i];
  });
}

/// Fills the ghost layer across each face: same level copied, outside the tank 0, coarser as asked.
/// `values(b)` returns the cells of block b.
template <class T, int Dim, class Values>
inline void load_ghosts(const Forest<Dim>& forest, int b, CoarseGhost coarse, Values&& values,
                        Scratch<T, Dim>& out) {
  constexpr int n = BlockShape<Dim>::n;
  constexpr IVec<Dim> strides = field::cell_strides<Dim>();
  const mesh::Block<Dim>& block = forest.block(b);
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const int nb = block.across(axis, side);
      IVec<Dim> lower, upper;
      side_box<Dim>(axis, side, lower, upper);
      const int step = ScratchShape<Dim>::stride(axis) * (side == 0 ? -1 : 1);
      const int count = upper[0] - lower[0];
      if (nb >= 0) {
        const T* source = values(nb);
        const int wrap = (side == 0 ? n - 1 : 1 - n) * strides[axis];
        field::for_rows<Dim>(lower, upper, [&](const IVec<Dim>& row) {
          const T* s = source + field::offset<Dim>(row, strides) + wrap;
          T* d = &out(row) + step;
          for (int i = 0; i < count; ++i) d[i] = s[i];
        });
      } else if (nb == mesh::coarser_neighbour && coarse == CoarseGhost::value) {
        const CoarseSide<Dim> from = coarse_side<Dim>(forest, block, axis, side);
        const T* source = values(from.block);
        field::for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
          IVec<Dim> c = from.base;
          for (int a = 0; a < Dim; ++a)
            if (a != axis) c[a] += i[a] / 2;
          (&out(i))[step] = source[field::offset<Dim>(c, strides)];
        });
      } else {
        field::for_rows<Dim>(lower, upper, [&](const IVec<Dim>& row) {
          T* d = &out(row) + step;
          for (int i = 0; i < count; ++i) d[i] = 0;
        });
      }
    }
  }
}

/// Pointers to a block's face coefficients, one per axis.
template <int Dim>
struct Coefficients {
  std::array<const float*, Dim> c;
  template <class Field>
  static Coefficients of(const Field& f, int b) {
    Coefficients out;
    for (int a = 0; a < Dim; ++a) out.c[static_cast<std::size_t>(a)] = f.block(a, b);
    return out;
  }
};

/// sum_f c_f z_nb over the faces of a row of cells, and the diagonal sum_f c_f when asked.
template <class T, int Dim>
inline void neighbour_sums(const Coefficients<Dim>& k, const IVec<Dim>& row, const T* z, T* sum, T* diagonal) {
  constexpr int n = BlockShape<Dim>::n;
  {
    const float* c = k.c[0] + field::offset<Dim>(row, field::face_strides<Dim>(0));
    for (int i = 0; i < n; ++i) sum[i] = T(c[i]) * z[i - 1] + T(c[i + 1]) * z[i + 1];
    if (diagonal)
      for (int i = 0; i < n; ++i) diagonal[i] = T(c[i]) + T(c[i + 1]);
  }
  for (int a = 1; a < Dim; ++a) {
    const IVec<Dim> fs = field::face_strides<Dim>(a);
    const float* lo = k.c[static_cast<std::size_t>(a)] + field::offset<Dim>(row, fs);
    const float* hi = lo + fs[a];
    const int stride = ScratchShape<Dim>::stride(a);
    for (int i = 0; i < n; ++i) sum[i] += T(lo[i]) * z[i - stride] + T(hi[i]) * z[i + stride];
    if (diagonal)
      for (int i = 0; i < n; ++i) diagonal[i] += T(lo[i]) + T(hi[i]);
  }
}

}  // namespace seaway::linear
