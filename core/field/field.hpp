// Fields on a forest: one value a cell, or one a face and axis, stored for all tree blocks (leaves and
// parents) as core/mesh/block.hpp says. A field does not own its forest.
#pragma once

#include <vector>

#include "core/mesh/forest.hpp"

namespace seaway::field {

using mesh::Block;
using mesh::BlockShape;
using mesh::Forest;

template <class T, int Dim>
class CellField {
 public:
  CellField() = default;
  explicit CellField(const Forest<Dim>& forest, T value = T{})
      : data_(static_cast<std::size_t>(forest.n_blocks()) * BlockShape<Dim>::cells, value) {}
  T* block(int b) { return data_.data() + static_cast<std::size_t>(b) * BlockShape<Dim>::cells; }
  const T* block(int b) const { return data_.data() + static_cast<std::size_t>(b) * BlockShape<Dim>::cells; }
  std::vector<T>& data() { return data_; }
  const std::vector<T>& data() const { return data_; }

 private:
  std::vector<T> data_;
};

template <class T, int Dim>
class FaceField {
 public:
  FaceField() = default;
  explicit FaceField(const Forest<Dim>& forest, T value = T{}) {
    for (auto& axis : data_)
      axis.assign(static_cast<std::size_t>(forest.n_blocks()) * BlockShape<Dim>::faces, value);
  }
  T* block(int axis, int b) {
    return data_[static_cast<std::size_t>(axis)].data() + static_cast<std::size_t>(b) * BlockShape<Dim>::faces;
  }
  const T* block(int axis, int b) const {
    return data_[static_cast<std::size_t>(axis)].data() + static_cast<std::size_t>(b) * BlockShape<Dim>::faces;
  }
  std::vector<T>& data(int axis) { return data_[static_cast<std::size_t>(axis)]; }
  const std::vector<T>& data(int axis) const { return data_[static_cast<std::size_t>(axis)]; }

 private:
  std::array<std::vector<T>, Dim> data_;
};

/// Strides of a block's cells, or of its faces of `axis`.
template <int Dim>
constexpr IVec<Dim> cell_strides() {
  constexpr int n = BlockShape<Dim>::n;
  if constexpr (Dim == 2) return {1, n};
  else return {1, n, n * n};
}
template <int Dim>
constexpr IVec<Dim> face_strides(int axis) {
  constexpr int n = BlockShape<Dim>::n;
  const int n0 = n + (axis == 0);
  if constexpr (Dim == 2) return {1, n0};
  else return {1, n0, n0 * (n + (axis == 1))};
}
template <int Dim>
constexpr int offset(const IVec<Dim>& i, const IVec<Dim>& strides) {
  int o = 0;
  for (int a = 0; a < Dim; ++a) o += i[a] * strides[a];
  return o;
}

/// Calls f(index) for all index in the box [lower, upper), axis 0 innermost.
template <int Dim, class F>
inline void for_box(const IVec<Dim>& lower, const IVec<Dim>& upper, F&& f) {
  if constexpr (Dim == 2) {
    for (int j = lower[1]; j < upper[1]; ++j)
      for (int i = lower[0]; i < upper[0]; ++i) f(IVec<2>{i, j});
  } else {
    for (int k = lower[2]; k < upper[2]; ++k)
      for (int j = lower[1]; j < upper[1]; ++j)
        for (int i = lower[0]; i < upper[0]; ++i) f(IVec<3>{i, j, k});
  }
}

/// Calls f(index) once for every row along axis 0 of the box, with index[0] = lower[0].
template <int Dim, class F>
inline void for_rows(const IVec<Dim>& lower, const IVec<Dim>& upper, F&& f) {
  if constexpr (Dim == 2) {
    for (int j = lower[1]; j < upper[1]; ++j) f(IVec<2>{lower[0], j});
  } else {
    for (int k = lower[2]; k < upper[2]; ++k)
      for (int j = lower[1]; j < upper[1]; ++j) f(IVec<3>{lower[0], j, k});
  }
}

template <int Dim>
constexpr IVec<Dim> filled(int value) {
  IVec<Dim> v{};
  for (int a = 0; a < Dim; ++a) v[a] = value;
  return v;
}
template <int Dim>
constexpr IVec<Dim> cells_upper() {
  return filled<Dim>(BlockShape<Dim>::n);
}
/// Upper bounds of a block's faces of `axis` (N + 1 along it).
template <int Dim>
constexpr IVec<Dim> faces_upper(int axis) {
  IVec<Dim> v = filled<Dim>(BlockShape<Dim>::n);
  ++v[axis];
  return v;
}

/// Calls f(offset) for a block's faces of `axis` on its lower (side 0) or upper (1) side.
template <int Dim, class F>
inline void for_side_faces(int axis, int side, F&& f) {
  IVec<Dim> lower = filled<Dim>(0), upper = cells_upper<Dim>();
  lower[axis] = side == 0 ? 0 : BlockShape<Dim>::n;
  upper[axis] = lower[axis] + 1;
  for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) { f(offset<Dim>(i, face_strides<Dim>(axis))); });
}

}  // namespace seaway::field
