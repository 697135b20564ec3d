#include "core/flow/hull_window.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace seaway::flow {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_box;
using field::for_rows;
using field::offset;

template <int Dim>
void HullWindow<Dim>::check_missing(const Touches& touches) const {
  const Vec<Dim> half = 0.5 * BlockShape<Dim>::n * h_;
  for (const Vec<Dim>& x : missing_) {
    if (!touches(x - half, x + half)) continue;
    fail(ErrorCode::failed_precondition,
         "the hull has left the region refined for it near (y, z) = ({:.3f}, {:.3f}) m; raise hull_sweep, "
         "hull_heave or hull_margin of the stage's mesh, or check why it moves so far",
         x[Dim - 2], x[Dim - 1]);
  }
}

template <int Dim>
bool HullWindow<Dim>::cover(const Vec<Dim>& lower, const Vec<Dim>& upper, const Touches& touches) {
  constexpr int nb = BlockShape<Dim>::n;
  const int level = forest_.n_levels() - 1;
  h_ = forest_.cell_size(level);
  IVec<Dim> first{}, count{};
  for (int a = 0; a < Dim; ++a) {
    const double edge = nb * h_[a];
    first[a] = static_cast<int>(std::floor((lower[a] - forest_.grid().lower[a]) / edge));
    count[a] = static_cast<int>(std::floor((upper[a] - forest_.grid().lower[a]) / edge)) - first[a] + 1;
  }
  if (first == first_block_ && count == blocks_) {
    check_missing(touches);
    return false;
  }
  first_block_ = first;
  blocks_ = count;
  size_ = 1;
  int stride = 1;
  for (int a = 0; a < Dim; ++a) {
    n_[a] = count[a] * nb;
    origin_[a] = forest_.grid().lower[a] + first[a] * nb * h_[a];
    stride_[static_cast<std::size_t>(a)] = stride;
    stride *= n_[a] + 1;
    size_ *= static_cast<std::size_t>(n_[a] + 1);
  }
  tiles_.clear();
  tile_at_.clear();
  missing_.clear();
  has_gaps_ = false;
  for_box<Dim>(filled<Dim>(0), count, [&](const IVec<Dim>& i) {
    IVec<Dim> coord = i, at = i;
    for (int a = 0; a < Dim; ++a) {
      coord[a] += first[a];
      at[a] *= nb;
    }
    const int b = forest_.find(level, coord);
    if (b >= 0 && forest_.block(b).leaf) {
      tile_at_.push_back(static_cast<int>(tiles_.size()));
      tiles_.push_back({b, at});
      return;
    }
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = forest_.grid().lower[a] + (coord[a] + 0.5) * nb * h_[a];
    tile_at_.push_back(-1);
    const auto& grid = forest_.grid();
    const bool outside = (x.array() < grid.lower.array()).any() || (x.array() > grid.upper.array()).any();
    if (outside && through_sides_) has_gaps_ = true;
    else missing_.push_back(x);
  });
  has_gaps_ = has_gaps_ || !missing_.empty();
  check_missing(touches);
  return true;
}

template <int Dim>
int HullWindow<Dim>::tile_of(const IVec<Dim>& cell) const {
  constexpr int nb = BlockShape<Dim>::n;
  int t = 0, m = 1;
  for (int a = 0; a < Dim; ++a) {
    t += std::clamp(cell[a], 0, n_[a] - 1) / nb * m;
    m *= blocks_[a];
  }
  return tile_at_[static_cast<std::size_t>(t)];
}

template <int Dim>
bool HullWindow<Dim>::at_tank_side(const Tile& tile, int axis, int side) const {
  const auto& block = forest_.block(tile.block);
  return through_sides_ && block.across(axis, side) == mesh::no_block;
}

template <int Dim>
std::int64_t HullWindow<Dim>::global_cell(const IVec<Dim>& i) const {
  constexpr int nb = BlockShape<Dim>::n;
  IVec<Dim> cell{};
  for (int a = 0; a < Dim; ++a) cell[a] = i[a] % nb;
  const int t = tile_of(i);
  if (t < 0) return -1;
  const Tile& tile = tiles_[static_cast<std::size_t>(t)];
  return static_cast<std::int64_t>(tile.block) * BlockShape<Dim>::cells + offset<Dim>(cell, cell_strides<Dim>());
}

template <int Dim>
void HullWindow<Dim>::load_cells(const CellField<double, Dim>& f, std::vector<double>& out) const {
  if (!has_gaps_) out.resize(size_);
  else out.assign(size_, 0.0);
  for_tiles([&](const Tile& tile) {
    const double* source = f.block(tile.block);
    for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
      IVec<Dim> to = row;
      for (int a = 0; a < Dim; ++a) to[a] += tile.at[a];
      std::copy_n(source + offset<Dim>(row, cell_strides<Dim>()), BlockShape<Dim>::n, out.data() + at(to));
    });
  });
}

template <int Dim>
void HullWindow<Dim>::store_cells(const std::vector<double>& in, CellField<double, Dim>& f) const {
  for_tiles([&](const Tile& tile) {
    double* target = f.block(tile.block);
    for_rows<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& row) {
      IVec<Dim> from = row;
      for (int a = 0; a < Dim; ++a) from[a] += tile.at[a];
      std::copy_n(in.data() + at(from), BlockShape<Dim>::n, target + offset<Dim>(row, cell_strides<Dim>()));
    });
  });
}

template <int Dim>
template <class T>
void HullWindow<Dim>::load_faces(const FaceField<T, Dim>& f, int axis, std::vector<double>& out) const {
  if (!has_gaps_) out.resize(size_);
  else out.assign(size_, 0.0);
  for_tiles([&](const Tile& tile) {
    const T* source = f.block(axis, tile.block);
    // Of faces that two tiles hold, those of the upper one count.
    IVec<Dim> beyond = tile.at, upper = faces_upper<Dim>(axis);
    beyond[axis] += BlockShape<Dim>::n;
    if (beyond[axis] < n_[axis] && tile_of(beyond) >= 0) --upper[axis];
    const int count = upper[0];
    for_rows<Dim>(filled<Dim>(0), upper, [&](const IVec<Dim>& row) {
      IVec<Dim> to = row;
      for (int a = 0; a < Dim; ++a) to[a] += tile.at[a];
      const T* s = source + offset<Dim>(row, face_strides<Dim>(axis));
      double* d = out.data() + at(to);
      for (int i = 0; i < count; ++i) d[i] = static_cast<double>(s[i]);
    });
  });
}

template <int Dim>
template <class T>
void HullWindow<Dim>::store_faces(const std::vector<double>& in, int axis, FaceField<T, Dim>& f) const {
  const int count = BlockShape<Dim>::n + (axis == 0);
  for_tiles([&](const Tile& tile) {
    T* target = f.block(axis, tile.block);
    for_rows<Dim>(filled<Dim>(0), faces_upper<Dim>(axis), [&](const IVec<Dim>& row) {
      IVec<Dim> from = row;
      for (int a = 0; a < Dim; ++a) from[a] += tile.at[a];
      const double* s = in.data() + at(from);
      T* d = target + offset<Dim>(row, face_strides<Dim>(axis));
      for (int i = 0; i < count; ++i) d[i] = static_cast<T>(s[i]);
    });
  });
}

template <int Dim>
Plane<Dim> interface_plane(const HullWindow<Dim>& window, const std::vector<double>& vof,
                           const std::vector<signed char>& spaces, int at) {
  constexpr int entries = Dim == 2 ? 9 : 27, row = entries / 3;  // a row: the entries at one height
  double stencil[entries];
  bool behind[entries] = {};
  bool any = false;
  int e = 0;
  for_box<Dim>(filled<Dim>(-1), filled<Dim>(2), [&](const IVec<Dim>& o) {
    int index = at;
    for (int a = 0; a < Dim; ++a) index += o[a] * window.stride(a);
    stencil[e] = vof[static_cast<std::size_t>(index)];
    if (!spaces.empty()) {
      behind[e] = apart(spaces[static_cast<std::size_t>(at)], spaces[static_cast<std::size_t>(index)]);
      any = any || behind[e];
    }
    ++e;
  });
  if (any) {
    for (int height = 0; height < 3; ++height) {
      double sum = 0;
      int count = 0;
      for (int k = height * row; k < (height + 1) * row; ++k)
        if (!behind[k]) sum += stencil[k], ++count;
      // Nothing of the own space at this height (a floor or a roof): as at the cell's own height.
      const double mean = count > 0 ? sum / count : stencil[entries / 2];
      for (int k = height * row; k < (height + 1) * row; ++k)
        if (behind[k]) stencil[k] = mean;
    }
  }
  Plane<Dim> plane;
  plane.normal = interface_normal<Dim>(stencil);
  plane.d = plane_constant<Dim>(plane.normal, vof[static_cast<std::size_t>(at)]);
  return plane;
}

template class HullWindow<2>;
template class HullWindow<3>;
template Plane<2> interface_plane<2>(const HullWindow<2>&, const std::vector<double>&,
                                     const std::vector<signed char>&, int);
template Plane<3> interface_plane<3>(const HullWindow<3>&, const std::vector<double>&,
                                     const std::vector<signed char>&, int);
#define SEAWAY_INSTANTIATE(T, D)                                                                     \
  template void HullWindow<D>::load_faces<T>(const FaceField<T, D>&, int, std::vector<double>&) const; \
  template void HullWindow<D>::store_faces<T>(const std::vector<double>&, int, FaceField<T, D>&) const;
SEAWAY_INSTANTIATE(double, 2)
SEAWAY_INSTANTIATE(double, 3)
SEAWAY_INSTANTIATE(float, 2)
SEAWAY_INSTANTIATE(float, 3)

}  // namespace seaway::flow
