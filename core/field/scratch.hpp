// A block with its surroundings, gathered for a kernel: up to two layers of cells, or of faces, on each side.
// Cells and faces of all axes share one layout, so that a kernel works with one set of strides and is written
// once for every axis: entry (i, j[, k]), -2 <= i <= N + 2, is at  centre(i) = sum_a (i_a + 2) stride_a.
#pragma once

#include "core/field/field.hpp"

namespace seaway::field {

template <int Dim>
struct ScratchShape {
  static constexpr int layers = 2;
  static constexpr int n = BlockShape<Dim>::n;
  static constexpr int edge = n + 1 + 2 * layers;
  static constexpr int pitch = (edge + 7) / 8 * 8;  ///< rows start on cache lines
  static constexpr int size = Dim == 2 ? pitch * edge : pitch * edge * edge;
  static constexpr IVec<3> stride3{1, pitch, pitch * edge};
  static constexpr int stride(int axis) { return stride3[static_cast<std::size_t>(axis)]; }
  static constexpr int at(const IVec<Dim>& i) {
    int o = 0;
    for (int a = 0; a < Dim; ++a) o += (i[a] + layers) * stride(a);
    return o;
  }
};

template <class T, int Dim>
struct alignas(64) Scratch {
  T data[ScratchShape<Dim>::size];
  T& operator()(const IVec<Dim>& i) { return data[ScratchShape<Dim>::at(i)]; }
  const T& operator()(const IVec<Dim>& i) const { return data[ScratchShape<Dim>::at(i)]; }
};

}  // namespace seaway::field
