#include "core/field/restrict.hpp"

namespace seaway::field {
namespace {

template <int Dim>
IVec<Dim> child_base(int child) {
  IVec<Dim> base{};
  for (int a = 0; a < Dim; ++a) base[a] = ((child >> a) & 1) * BlockShape<Dim>::n / 2;
  return base;
}

/// A coarse leaf's side takes the means that the parent of the finer blocks behind it holds.
template <class T, int Dim>
void copy_coarse_face(const mesh::CoarseFace& face, FaceField<T, Dim>& f) {
  constexpr int n = BlockShape<Dim>::n;
  const IVec<Dim> strides = face_strides<Dim>(face.axis);
  T* leaf = f.block(face.axis, face.leaf);
  const T* parent = f.block(face.axis, face.parent);
  IVec<Dim> lower = filled<Dim>(0), upper = cells_upper<Dim>();
  const int to = face.side == 0 ? 0 : n;
  const int shift = (n - 2 * to) * strides[face.axis];
  lower[face.axis] = to;
  upper[face.axis] = to + 1;
  for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
    const int o = offset<Dim>(i, strides);
    leaf[o] = parent[o + shift];
  });
}

/// f(parent) level by level from the finest, those of one level on threads; before_level(level) first.
template <int Dim, class Before, class F>
void for_parents(const Forest<Dim>& forest, const std::vector<int>& parents, Before&& before_level, F&& f) {
  for (std::size_t begin = 0; begin < parents.size();) {
    const int level = forest.block(parents[begin]).level;
    std::size_t end = begin;
    while (end < parents.size() && forest.block(parents[end]).level == level) ++end;
    before_level(level);
    mesh::parallel_for(static_cast<int>(end - begin), forest.threads(),
                       [&](int i) { f(parents[begin + static_cast<std::size_t>(i)]); });
    begin = end;
  }
}

template <class T, int Dim>
void restrict_cells_of(const Forest<Dim>& forest, const std::vector<int>& parents, CellField<T, Dim>& f) {
  constexpr int half = BlockShape<Dim>::n / 2;
  const IVec<Dim> strides = cell_strides<Dim>();
  for_parents(forest, parents, [](int) {}, [&](int b) {
    T* coarse = f.block(b);
    for (int c = 0; c < BlockShape<Dim>::children; ++c) {
      const T* fine = f.block(forest.block(b).child[static_cast<std::size_t>(c)]);
      const IVec<Dim> base = child_base<Dim>(c);
      for_box<Dim>(filled<Dim>(0), filled<Dim>(half), [&](const IVec<Dim>& i) {
        T sum = 0;
        for (int s = 0; s < BlockShape<Dim>::children; ++s) {
          IVec<Dim> at{};
          for (int a = 0; a < Dim; ++a) at[a] = 2 * i[a] + ((s >> a) & 1);
          sum += fine[offset<Dim>(at, strides)];
        }
        IVec<Dim> to{};
        for (int a = 0; a < Dim; ++a) to[a] = base[a] + i[a];
        coarse[offset<Dim>(to, strides)] = sum * (T(1) / BlockShape<Dim>::children);
      });
    }
  });
}

template <class T, int Dim>
void restrict_faces_of(const Forest<Dim>& forest, const std::vector<int>& parents,
                       const std::vector<mesh::CoarseFace>& coarse_faces, FaceField<T, Dim>& f, int axis) {
  constexpr int half = BlockShape<Dim>::n / 2;
  const IVec<Dim> strides = face_strides<Dim>(axis);
  // Level by level from the finest: a leaf takes its faces at jumps before its parent takes means of them.
  auto next = coarse_faces.rbegin();
  const auto copy_faces_finer_than = [&](int level) {
    for (; next != coarse_faces.rend() && forest.block(next->leaf).level > level; ++next)
      if (next->axis == axis) copy_coarse_face(*next, f);
  };
  for_parents(forest, parents, copy_faces_finer_than, [&](int b) {
    T* coarse = f.block(axis, b);
    for (int c = 0; c < BlockShape<Dim>::children; ++c) {
      const T* fine = f.block(axis, forest.block(b).child[static_cast<std::size_t>(c)]);
      const IVec<Dim> base = child_base<Dim>(c);
      IVec<Dim> upper = filled<Dim>(half);
      ++upper[axis];
      for_box<Dim>(filled<Dim>(0), upper, [&](const IVec<Dim>& i) {
        T sum = 0;
        for (int s = 0; s < BlockShape<Dim>::children; ++s) {
          if ((s >> axis) & 1) continue;
          IVec<Dim> at{};
          for (int a = 0; a < Dim; ++a) at[a] = 2 * i[a] + ((s >> a) & 1);
          sum += fine[offset<Dim>(at, strides)];
        }
        IVec<Dim> to{};
        for (int a = 0; a < Dim; ++a) to[a] = base[a] + i[a];
        coarse[offset<Dim>(to, strides)] = sum * (T(2) / BlockShape<Dim>::children);
      });
    }
  });
  copy_faces_finer_than(-1);
}

}  // namespace

template <class T, int Dim>
void restrict_cells(const Forest<Dim>& forest, CellField<T, Dim>& f) {
  restrict_cells_of(forest, forest.interface_parents(), f);
}

template <class T, int Dim>
void restrict_cells(const Forest<Dim>& forest, const mesh::ForestPart<Dim>& part, CellField<T, Dim>& f) {
  restrict_cells_of(forest, part.parents, f);
}

template <class T, int Dim>
void restrict_faces(const Forest<Dim>& forest, FaceField<T, Dim>& f, int axis) {
  restrict_faces_of(forest, forest.interface_parents(), forest.coarse_faces(), f, axis);
}

template <class T, int Dim>
void restrict_faces(const Forest<Dim>& forest, const mesh::ForestPart<Dim>& part, FaceField<T, Dim>& f, int axis) {
  restrict_faces_of(forest, part.parents, part.coarse_faces, f, axis);
}

#define SEAWAY_INSTANTIATE(T, D)                                                                              \
  template void restrict_cells<T, D>(const Forest<D>&, CellField<T, D>&);                                     \
  template void restrict_cells<T, D>(const Forest<D>&, const mesh::ForestPart<D>&, CellField<T, D>&);         \
  template void restrict_faces<T, D>(const Forest<D>&, FaceField<T, D>&, int);                                \
  template void restrict_faces<T, D>(const Forest<D>&, const mesh::ForestPart<D>&, FaceField<T, D>&, int);
SEAWAY_INSTANTIATE(double, 2)
SEAWAY_INSTANTIATE(double, 3)
SEAWAY_INSTANTIATE(float, 2)
SEAWAY_INSTANTIATE(float, 3)

}  // namespace seaway::field
