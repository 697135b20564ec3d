// A box of whole finest-level blocks around the hull, held as dense arrays: everything that happens at
// the hull (apertures, extension into it, volume book) works on plain indices here and never meets a block
// edge or a level jump. Blocks in the box that the hull cannot touch may be coarser: the window has no tile there,
// its entries keep what "far from the hull" means in each array (0 where fields are loaded). Cells and faces share
// one layout: entry (i, j[, k]), 0 <= i <= n, axis 0 fastest; face i of an axis lies on the lower side of cell i.
#pragma once

#include <functional>
#include <vector>

#include "core/field/field.hpp"
#include "core/flow/plic.hpp"

namespace seaway::flow {

using field::CellField;
using field::FaceField;
using mesh::BlockShape;
using mesh::Forest;

/// Space of a cell in an opening: joined to all others.
inline constexpr signed char passage = -1;

/// Whether a wall lies between two cells, by their spaces.
inline bool apart(signed char a, signed char b) { return a != b && a >= 0 && b >= 0; }

template <int Dim>
class HullWindow {
 public:
  /// `through_sides`: the hull may reach out of the tank, as a fixed obstacle does; otherwise cover() throws.
  explicit HullWindow(const Forest<Dim>& forest, bool through_sides = false)
      : forest_(forest), through_sides_(through_sides) {}

  /// Whether the hull may touch a box (earth axes, [m]).
  using Touches = std::function<bool(const Vec<Dim>& lower, const Vec<Dim>& upper)>;

  /// Covers [lower, upper] (earth axes) with whole blocks. Throws Error(failed_precondition) when a block
  /// there that the hull may touch is not of the finest level: the hull has left the region refined for it.
  /// Returns whether the blocks changed.
  bool cover(const Vec<Dim>& lower, const Vec<Dim>& upper, const Touches& touches);

  const IVec<Dim>& n() const { return n_; }       ///< cells along each axis
  IVec<Dim> n_faces(int axis) const {             ///< faces of an axis along each axis
    IVec<Dim> n = n_;
    ++n[axis];
    return n;
  }
  std::size_t size() const { return size_; }      ///< entries of an array
  int stride(int axis) const { return stride_[static_cast<std::size_t>(axis)]; }
  int at(const IVec<Dim>& i) const {
    int o = 0;
    for (int a = 0; a < Dim; ++a) o += i[a] * stride_[static_cast<std::size_t>(a)];
    return o;
  }
  const Vec<Dim>& h() const { return h_; }
  Vec<Dim> cell_centre(const IVec<Dim>& i) const {
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = origin_[a] + (i[a] + 0.5) * h_[a];
    return x;
  }
  Vec<Dim> face_centre(const IVec<Dim>& i, int axis) const {
    Vec<Dim> x = cell_centre(i);
    x[axis] -= 0.5 * h_[axis];
    return x;
  }
  double cell_volume() const { return h_.prod(); }
  double face_area(int axis) const { return h_.prod() / h_[axis]; }

  struct Tile {
    int block = 0;
    IVec<Dim> at{};  ///< window index of the block's first cell
  };
  const std::vector<Tile>& tiles() const { return tiles_; }
  /// Index into tiles() of the one that holds a cell (clamped to the window); -1 if there is none.
  int tile_of(const IVec<Dim>& cell) const;
  /// Whether the faces on a side (0: lower, 1: upper) of a tile lie on the tank's own side, and the hull may reach
  /// through it.
  bool at_tank_side(const Tile& tile, int axis, int side) const;
  /// Index block * cells + cell in a field of the forest; -1 where there is no tile.
  std::int64_t global_cell(const IVec<Dim>& i) const;

  void load_cells(const CellField<double, Dim>& f, std::vector<double>& out) const;
  void store_cells(const std::vector<double>& in, CellField<double, Dim>& f) const;
  template <class T>
  void load_faces(const FaceField<T, Dim>& f, int axis, std::vector<double>& out) const;
  template <class T>
  void store_faces(const std::vector<double>& in, int axis, FaceField<T, Dim>& f) const;

  /// f(index) over all cells, or all faces of an axis, or a box of entries, one after another.
  template <class F>
  void for_cells(F&& f) const {
    field::for_box<Dim>(field::filled<Dim>(0), n_, f);
  }
  template <class F>
  void for_faces(int axis, F&& f) const {
    field::for_box<Dim>(field::filled<Dim>(0), n_faces(axis), f);
  }
  /// The same on threads, layers of the last axis at a time: f may write what belongs to its own index only.
  template <class F>
  void for_box_on_threads(const IVec<Dim>& lower, const IVec<Dim>& upper, F&& f) const {
    mesh::parallel_for(upper[Dim - 1] - lower[Dim - 1], forest_.threads(), [&](int layer) {
      const auto [low, high] = layer_of(lower, upper, layer);
      field::for_box<Dim>(low, high, f);
    });
  }
  template <class F>
  void for_cells_on_threads(F&& f) const {
    for_box_on_threads(field::filled<Dim>(0), n_, f);
  }
  /// What f(index, list) appends to a list of T, in the order of the entries whatever the number of threads.
  template <class T, class F>
  std::vector<T> collect(const IVec<Dim>& lower, const IVec<Dim>& upper, F&& f) const {
    const int layers = std::max(0, upper[Dim - 1] - lower[Dim - 1]);
    std::vector<std::vector<T>> lists(static_cast<std::size_t>(layers));
    mesh::parallel_for(layers, forest_.threads(), [&](int layer) {
      const auto [low, high] = layer_of(lower, upper, layer);
      auto& list = lists[static_cast<std::size_t>(layer)];
      field::for_box<Dim>(low, high, [&](const IVec<Dim>& i) { f(i, list); });
    });
    std::vector<T> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
  }
  template <class T, class F>
  std::vector<T> collect(F&& f) const {
    return collect<T>(field::filled<Dim>(0), n_, f);
  }
  const Forest<Dim>& forest() const { return forest_; }

 private:
  void check_missing(const Touches& touches) const;
  template <class F>
  void for_tiles(F&& f) const {
    mesh::parallel_for(static_cast<int>(tiles_.size()), forest_.threads(), [&](int t) { f(tiles_[static_cast<std::size_t>(t)]); });
  }
  static std::pair<IVec<Dim>, IVec<Dim>> layer_of(IVec<Dim> lower, IVec<Dim> upper, int layer) {
    lower[Dim - 1] += layer;
    upper[Dim - 1] = lower[Dim - 1] + 1;
    return {lower, upper};
  }

  const Forest<Dim>& forest_;
  bool through_sides_;
  IVec<Dim> first_block_{}, n_{};
  std::array<int, Dim> stride_{};
  std::size_t size_ = 0;
  Vec<Dim> origin_ = Vec<Dim>::Zero(), h_ = Vec<Dim>::Ones();
  std::vector<Tile> tiles_;
  std::vector<int> tile_at_;       ///< dense, by block position in the window; -1: no tile
  std::vector<Vec<Dim>> missing_;  ///< middles of the blocks without a tile that must stay clear of the hull
  bool has_gaps_ = false;          ///< some blocks have no tile
  IVec<Dim> blocks_{};
};

/// Plane of the interface in a mixed cell, from the volume fractions around it (window array). The cell
/// must not lie on the window's edge. With the spaces of cells (core/flow/hull_mask.hpp; may be empty) what lies
/// behind a wall counts as the mean of the cells of the own space at the same height.
template <int Dim>
Plane<Dim> interface_plane(const HullWindow<Dim>& window, const std::vector<double>& vof,
                           const std::vector<signed char>& spaces, int at);

extern template class HullWindow<2>;
extern template class HullWindow<3>;

}  // namespace seaway::flow
