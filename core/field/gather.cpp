#include "core/field/gather.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::field {
namespace {

using mesh::coarser_neighbour;
using mesh::no_block;

template <int Dim>
IVec<Dim> neighbour_offset(int entry) {
  IVec<Dim> off{};
  for (int a = 0; a < Dim; ++a) {
    off[a] = entry % 3 - 1;
    entry /= 3;
  }
  return off;
}

template <class T>
T minmod(T a, T b) {
  const T smaller = std::abs(a) < std::abs(b) ? a : b;
  return a * b > 0 ? smaller : T(0);
}

/// Ranges [lower, upper) of the entries that neighbour `off` supplies. `face_axis` < 0: cells.
template <int Dim>
void region_of(const IVec<Dim>& off, int layers, int face_axis, IVec<Dim>& lower, IVec<Dim>& upper) {
  constexpr int n = BlockShape<Dim>::n;
  for (int a = 0; a < Dim; ++a) {
    const int extra = a == face_axis;  // faces 0..N belong to the block itself
    if (off[a] < 0) lower[a] = -layers, upper[a] = 0;
    else if (off[a] == 0) lower[a] = 0, upper[a] = n + extra;
    else lower[a] = n + extra, upper[a] = n + extra + layers;
  }
}

template <class T, int Dim>
void copy_region(const T* source, const IVec<Dim>& strides, const IVec<Dim>& shift, const IVec<Dim>& lower,
                 const IVec<Dim>& upper, T* out) {
  const int count = upper[0] - lower[0];
  for_rows<Dim>(lower, upper, [&](const IVec<Dim>& row) {
    IVec<Dim> from = row;
    for (int a = 0; a < Dim; ++a) from[a] -= shift[a];
    const T* s = source + offset<Dim>(from, strides);
    T* d = out + ScratchShape<Dim>::at(row);
    for (int i = 0; i < count; ++i) d[i] = s[i];
  });
}

int floor_half(int i) { return i >= 0 ? i / 2 : -((1 - i) / 2); }

/// The surroundings of a block as its parent's level has them, in coarse cells counted from the block's
/// lower corner: entries -2 .. N/2 + 2 along each axis.
template <class T, int Dim>
struct CoarsePatch {
  static constexpr int half = BlockShape<Dim>::n / 2;
  static constexpr int edge = half + 5;
  static constexpr std::array<int, 3> stride{1, edge, edge * edge};
  T data[Dim == 2 ? edge * edge : edge * edge * edge];
  static int at(const IVec<Dim>& i) {
    int o = 0;
    for (int a = 0; a < Dim; ++a) o += (i[a] + 2) * stride[static_cast<std::size_t>(a)];
    return o;
  }
};

/// Range of the coarse entries that the interpolation of all wanted coarser neighbours reads.
template <int Dim>
void patch_range(const Block<Dim>& block, int layers, int face_axis, Neighbourhood from, IVec<Dim>& lower,
                 IVec<Dim>& upper) {
  constexpr int half = BlockShape<Dim>::n / 2;
  lower = filled<Dim>(half + 3);
  upper = filled<Dim>(-2);
  for (int entry = 0; entry < BlockShape<Dim>::neighbours; ++entry) {
    if (block.neighbour[static_cast<std::size_t>(entry)] != coarser_neighbour || !(from >> entry & 1)) continue;
    IVec<Dim> low, high;
    region_of<Dim>(neighbour_offset<Dim>(entry), layers, face_axis, low, high);
    for (int a = 0; a < Dim; ++a) {
      const int faces = a == face_axis;  // a fine face may lie between two coarse ones; no slope along its axis
      lower[a] = std::min(lower[a], floor_half(low[a]) - 1 + faces);
      upper[a] = std::max(upper[a], floor_half(high[a] - 1) + 2);
    }
  }
  for (int a = 0; a < Dim; ++a) {
    lower[a] = std::max(lower[a], -2);
    upper[a] = std::min(upper[a], half + 2 + (a == face_axis));
  }
}

template <class T, int Dim, class Source>
void fill_patch(const Forest<Dim>& forest, int b, int face_axis, Source&& source, const IVec<Dim>& strides,
                const IVec<Dim>& lower, const IVec<Dim>& upper, CoarsePatch<T, Dim>& patch) {
  constexpr int n = BlockShape<Dim>::n;
  constexpr int half = n / 2;
  const Block<Dim>& fine = forest.block(b);
  const Block<Dim>& parent = forest.block(fine.parent);
  IVec<Dim> base{};  // lower corner of the block in the parent's cells
  for (int a = 0; a < Dim; ++a) base[a] = (fine.coord[a] & 1) * half;
  const auto last = [&](int a) { return a == face_axis ? n : n - 1; };
  const auto side_of = [&](int cell, int a) { return cell < 0 ? -1 : cell > last(a) ? 1 : 0; };
  for_rows<Dim>(lower, upper, [&](const IVec<Dim>& row) {
    IVec<Dim> cell{};
    int entry_of_row = 0, power = 3;
    for (int a = 1; a < Dim; ++a, power *= 3) {
      cell[a] = base[a] + row[a];
      entry_of_row += (side_of(cell[a], a) + 1) * power;
    }
    T* out = patch.data + CoarsePatch<T, Dim>::at(row) - row[0];
    // Along the row: what lies below the parent, in it, beyond it.
    for (int i = lower[0]; i < upper[0];) {
      const int side = side_of(base[0] + i, 0);
      const int end = side < 0 ? std::min(upper[0], -base[0]) : side == 0 ? std::min(upper[0], last(0) + 1 - base[0]) : upper[0];
      const int entry = entry_of_row + side + 1;
      const int nb = parent.neighbour[static_cast<std::size_t>(entry)];
      cell[0] = base[0] + i;
      if (nb < 0) {  // outside the tank, or two levels coarser: nearest value that is there
        IVec<Dim> inside{};
        for (int a = 0; a < Dim; ++a) inside[a] = std::clamp(cell[a], 0, last(a));
        const T* from = source(fine.parent) + offset<Dim>(inside, strides);
        for (int k = i; k < end; ++k) out[k] = from[side == 0 ? k - i : 0];
      } else {
        const IVec<Dim> off = neighbour_offset<Dim>(entry);
        IVec<Dim> there = cell;
        for (int a = 0; a < Dim; ++a) there[a] -= off[a] * n;
        const T* from = source(nb) + offset<Dim>(there, strides);
        for (int k = i; k < end; ++k) out[k] = from[k - i];
      }
      i = end;
    }
  });
}

/// Limited slope at an entry of a coarse patch, `s`: the stride of its axis.
template <class T>
inline T limited_slope(const T* c, int s) {
  return minmod(c[0] - c[-s], c[s] - c[0]);
}

/// Fine cells from the coarse patch: the coarse value plus limited slopes a quarter cell along each axis.
template <class T, int Dim>
void interpolate_cells(const CoarsePatch<T, Dim>& patch, const IVec<Dim>& lower, const IVec<Dim>& upper, T* out) {
  constexpr auto& stride = CoarsePatch<T, Dim>::stride;
  for_rows<Dim>(lower, upper, [&](const IVec<Dim>& row) {
    IVec<Dim> c{};
    T quarter[Dim];
    for (int a = 0; a < Dim; ++a) {
      c[a] = floor_half(row[a]);
      quarter[a] = row[a] - 2 * c[a] == 0 ? T(-0.25) : T(0.25);
    }
    c[0] = 0;
    const T* line = patch.data + CoarsePatch<T, Dim>::at(c);
    T* d = out + ScratchShape<Dim>::at(row) - row[0];
    for (int i = lower[0]; i < upper[0]; ++i) {
      const int half = floor_half(i);
      const T* p = line + half;
      T value = p[0] + (i - 2 * half == 0 ? T(-0.25) : T(0.25)) * limited_slope(p, 1);
      for (int a = 1; a < Dim; ++a) value += quarter[a] * limited_slope(p, stride[static_cast<std::size_t>(a)]);
      d[i] = value;
    }
  });
}

/// Fine faces: on a coarse face plane as interpolate_cells across the other axes, midway the mean of two.
template <class T, int Dim, int Axis>
void interpolate_faces(const CoarsePatch<T, Dim>& patch, const IVec<Dim>& lower, const IVec<Dim>& upper, T* out) {
  constexpr auto& stride = CoarsePatch<T, Dim>::stride;
  for_box<Dim>(lower, upper, [&](const IVec<Dim>& i) {
    IVec<Dim> c{};
    T quarter[Dim];
    for (int a = 0; a < Dim; ++a) {
      c[a] = floor_half(i[a]);
      quarter[a] = i[a] - 2 * c[a] == 0 ? T(-0.25) : T(0.25);
    }
    const auto on_plane = [&](const T* p) {
      T v = p[0];
      for (int a = 0; a < Dim; ++a)
        if (a != Axis) v += quarter[a] * limited_slope(p, stride[static_cast<std::size_t>(a)]);
      return v;
    };
    const T* p = patch.data + CoarsePatch<T, Dim>::at(c);
    const T below = T(0) + on_plane(p);
    out[ScratchShape<Dim>::at(i)] =
        i[Axis] - 2 * c[Axis] == 0 ? below : T(0.5) * (below + on_plane(p + stride[Axis]));
  });
}

/// Cells (face_axis < 0) or faces of an axis.
template <class T, int Dim>
void interpolate(const CoarsePatch<T, Dim>& patch, int face_axis, const IVec<Dim>& lower, const IVec<Dim>& upper, T* out) {
  switch (face_axis) {
    case 0: return interpolate_faces<T, Dim, 0>(patch, lower, upper, out);
    case 1: return interpolate_faces<T, Dim, 1>(patch, lower, upper, out);
    case 2:
      if constexpr (Dim == 3) interpolate_faces<T, Dim, 2>(patch, lower, upper, out);
      return;
    default: return interpolate_cells<T, Dim>(patch, lower, upper, out);
  }
}

/// Mirrors what lies outside the tank, axis after axis, so that corners come out as well.
template <class T, int Dim>
void mirror(const Block<Dim>& block, int layers, int face_axis, const Boundaries<Dim>* boundaries, T* out) {
  constexpr int n = BlockShape<Dim>::n;
  for (int a = 0; a < Dim; ++a) {
    for (int side = 0; side < 2; ++side) {
      if (block.across(a, side) != no_block) continue;
      IVec<Dim> lower = filled<Dim>(-layers), upper = filled<Dim>(n + layers);
      if (face_axis >= 0) ++upper[face_axis];
      lower[a] = 0;
      upper[a] = 1;
      const int stride = ScratchShape<Dim>::stride(a);
      for_rows<Dim>(lower, upper, [&](const IVec<Dim>& row) {
        const int count = a == 0 ? 1 : upper[0] - lower[0];
        IVec<Dim> at = row;
        for (int layer = 1; layer <= layers; ++layer) {
          if (a == face_axis) {
            const int face = side == 0 ? 0 : n;
            at[a] = face;
            const T* base = out + ScratchShape<Dim>::at(at);
            const int step = side == 0 ? stride : -stride;
            T* ghost = out + ScratchShape<Dim>::at(at) - layer * step;
            const bool open = boundaries->kind[static_cast<std::size_t>(a)][static_cast<std::size_t>(side)] == BoundaryKind::open;
            for (int i = 0; i < count; ++i)
              ghost[i] = open ? base[i] : 2 * base[i] - base[i + layer * step];
          } else {
            at[a] = side == 0 ? layer - 1 : n - layer;
            const T* inside = out + ScratchShape<Dim>::at(at);
            at[a] = side == 0 ? -layer : n - 1 + layer;
            T* ghost = out + ScratchShape<Dim>::at(at);
            const auto& wall = boundaries ? boundaries->wall[static_cast<std::size_t>(a)][static_cast<std::size_t>(side)]
                                          : SideWall<Dim>{};
            if (face_axis >= 0 && wall.no_slip) {
              const T twice = static_cast<T>(2 * wall.velocity[face_axis]);
              for (int i = 0; i < count; ++i) ghost[i] = twice - inside[i];
            } else {
              for (int i = 0; i < count; ++i) ghost[i] = inside[i];
            }
          }
        }
      });
    }
  }
}

template <class T, int Dim, class Source>
void gather(const Forest<Dim>& forest, int b, int layers, int face_axis, Source&& source,
            const IVec<Dim>& strides, const Boundaries<Dim>* boundaries, Neighbourhood from,
            Scratch<T, Dim>& out) {
  constexpr int n = BlockShape<Dim>::n;
  const Block<Dim>& block = forest.block(b);
  bool boundary = false;
  CoarsePatch<T, Dim> patch;
  bool patch_filled = false;
  for (int entry = 0; entry < BlockShape<Dim>::neighbours; ++entry) {
    const int nb = entry == BlockShape<Dim>::neighbours / 2 ? b : block.neighbour[static_cast<std::size_t>(entry)];
    if (nb == no_block) {
      boundary = true;
      continue;
    }
    if (nb != b && !(from >> entry & 1)) continue;
    const IVec<Dim> off = neighbour_offset<Dim>(entry);
    IVec<Dim> lower, upper;
    region_of<Dim>(off, layers, face_axis, lower, upper);
    if (nb >= 0) {
      IVec<Dim> shift = off;
      for (int a = 0; a < Dim; ++a) shift[a] *= n;
      copy_region<T, Dim>(source(nb), strides, shift, lower, upper, out.data);
      continue;
    }
    if (!patch_filled) {
      IVec<Dim> patch_lower, patch_upper;
      patch_range<Dim>(block, layers, face_axis, from, patch_lower, patch_upper);
      fill_patch<T, Dim>(forest, b, face_axis, source, strides, patch_lower, patch_upper, patch);
      patch_filled = true;
    }
    interpolate<T, Dim>(patch, face_axis, lower, upper, out.data);
    // The outer face planes may belong to a block of this level beside the coarse one: then its values count,
    // so that both blocks that share a face see the same surroundings.
    if (face_axis < 0 || off[face_axis] != 0) continue;
    for (int side = -1; side <= 1; side += 2) {
      constexpr std::array<int, 3> power{1, 3, 9};
      const int beside = block.neighbour[static_cast<std::size_t>(entry + side * power[static_cast<std::size_t>(face_axis)])];
      if (beside < 0) continue;
      IVec<Dim> plane_lower = lower, plane_upper = upper, shift = off;
      plane_lower[face_axis] = side < 0 ? 0 : n;
      plane_upper[face_axis] = plane_lower[face_axis] + 1;
      shift[face_axis] = side;
      for (int a = 0; a < Dim; ++a) shift[a] *= n;
      copy_region<T, Dim>(source(beside), strides, shift, plane_lower, plane_upper, out.data);
    }
  }
  if (boundary) mirror<T, Dim>(block, layers, face_axis, boundaries, out.data);
}

}  // namespace

template <class T, int Dim>
void gather_cells(const Forest<Dim>& forest, const CellField<T, Dim>& f, int b, int layers,
                  Scratch<T, Dim>& out, Neighbourhood from) {
  gather<T, Dim>(forest, b, layers, -1, [&](int nb) { return f.block(nb); }, cell_strides<Dim>(), nullptr, from,
                 out);
}

template <class T, int Dim>
void gather_faces(const Forest<Dim>& forest, const FaceField<T, Dim>& f, int axis, int b, int layers,
                  const Boundaries<Dim>& boundaries, Scratch<T, Dim>& out, Neighbourhood from) {
  gather<T, Dim>(forest, b, layers, axis, [&](int nb) { return f.block(axis, nb); }, face_strides<Dim>(axis),
                 &boundaries, from, out);
}

#define SEAWAY_INSTANTIATE(T, D)                                                                          \
  template void gather_cells<T, D>(const Forest<D>&, const CellField<T, D>&, int, int, Scratch<T, D>&,    \
                                   Neighbourhood);                                                        \
  template void gather_faces<T, D>(const Forest<D>&, const FaceField<T, D>&, int, int, int,               \
                                   const Boundaries<D>&, Scratch<T, D>&, Neighbourhood);
SEAWAY_INSTANTIATE(double, 2)
SEAWAY_INSTANTIATE(double, 3)
SEAWAY_INSTANTIATE(float, 2)
SEAWAY_INSTANTIATE(float, 3)

}  // namespace seaway::field
