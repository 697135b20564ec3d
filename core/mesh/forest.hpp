// The adaptive mesh: a brick of root blocks, each the root of a quadtree (Dim 2) or octree (Dim 3), balanced
// 2:1 over faces, edges and corners. p4est decides the refinement and the balance [burstedde2011]; this class
// keeps what the kernels need: all tree blocks, their neighbours, and the lists of coarse-fine faces.
//
// Immutable after construction and safe to read from any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "core/mesh/block.hpp"
#include "core/mesh/parallel.hpp"

namespace seaway::mesh {

template <int Dim>
struct TankGrid {
  Vec<Dim> lower, upper;            ///< tank corners [m]
  IVec<Dim> root_blocks{};          ///< root blocks along each axis
  std::array<bool, Dim> periodic{};
};

/// Root blocks so that the root cells come as close to `base_cell` as whole blocks allow, and not beyond
/// it by more than 12 %. The cells may differ between axes by what the tank's proportions leave: choose
/// tanks of whole multiples of 16 (3-D: 8) base cells for cells of exactly the wanted size. 3-D: cells are
/// `stretch_x` times as long along x, the ship's length, as across it.
template <int Dim>
TankGrid<Dim> make_tank_grid(const Vec<Dim>& lower, const Vec<Dim>& upper, double base_cell,
                             const std::array<bool, Dim>& periodic, double stretch_x = 1);

/// Whether the block [lower, upper] of `level` is to be split.
template <int Dim>
using RefineRule = std::function<bool(const Vec<Dim>& lower, const Vec<Dim>& upper, int level)>;

/// A face of a coarse leaf behind which the blocks are finer.
struct CoarseFace {
  int leaf = 0;    ///< the coarse leaf
  int axis = 0;
  int side = 0;    ///< 0: lower, 1: upper face of the leaf
  int parent = 0;  ///< the neighbour of the same level, whose children touch the face
};

template <int Dim>
class Forest {
 public:
  using Shape = BlockShape<Dim>;

  /// Throws Error(invalid_argument) for an empty tank, Error(resource_exhausted) beyond max_cells leaf cells.
  Forest(const TankGrid<Dim>& grid, int max_level, const RefineRule<Dim>& refine, int threads = 1,
         std::int64_t max_cells = 200'000'000);

  const TankGrid<Dim>& grid() const { return grid_; }
  int n_blocks() const { return static_cast<int>(blocks_.size()); }
  const Block<Dim>& block(int b) const { return blocks_[static_cast<std::size_t>(b)]; }
  const std::vector<int>& leaves() const { return leaves_; }
  int n_leaves() const { return static_cast<int>(leaves_.size()); }
  std::int64_t n_cells() const { return static_cast<std::int64_t>(leaves_.size()) * Shape::cells; }
  int n_levels() const { return static_cast<int>(level_begin_.size()) - 1; }
  /// Blocks of a level are [level_begin(l), level_begin(l + 1)), in Morton order; root blocks come first.
  int level_begin(int level) const { return level_begin_[static_cast<std::size_t>(level)]; }
  /// Coarsest leaves first.
  const std::vector<CoarseFace>& coarse_faces() const { return coarse_faces_; }
  /// Parents whose values are read by a leaf next to them (or by its ghosts), finest level first.
  const std::vector<int>& interface_parents() const { return interface_parents_; }
  /// Whether a leaf has a coarser neighbour (over a face, edge or corner).
  bool touches_coarser(int b) const { return touches_coarser_[static_cast<std::size_t>(b)] != 0; }
  /// Block of this level and position, or no_block.
  int find(int level, const IVec<Dim>& coord) const;
  /// Leaf that contains the point (clamped into the tank).
  int find_leaf(const Vec<Dim>& x) const;
  /// Cell edges of a level.
  Vec<Dim> cell_size(int level) const;
  /// Edge across the ship (y, z) of the finest cells [m].
  double finest_cell() const {
    const Vec<Dim> h = cell_size(n_levels() - 1);
    return h[Dim - 1] > h[Dim - 2] ? h[Dim - 1] : h[Dim - 2];
  }
  int threads() const { return threads_; }

  template <class F>
  void for_each_leaf(F&& f) const {
    parallel_for(n_leaves(), threads_, [&](int i) { f(leaves_[static_cast<std::size_t>(i)]); });
  }
  template <class F>
  double sum_over_leaves(F&& f) const {
    return parallel_sum(n_leaves(), threads_, [&](int i) { return f(leaves_[static_cast<std::size_t>(i)]); });
  }
  template <class F>
  double max_over_leaves(double floor, F&& f) const {
    return parallel_max(n_leaves(), threads_, floor,
                        [&](int i) { return f(leaves_[static_cast<std::size_t>(i)]); });
  }

 private:
  void build_tree(const std::vector<std::pair<int, IVec<Dim>>>& leaves);
  void link_neighbours();
  void list_interfaces();
  static std::uint64_t key(int level, const IVec<Dim>& coord);

  TankGrid<Dim> grid_;
  int threads_;
  std::vector<Block<Dim>> blocks_;
  std::vector<int> leaves_;
  std::vector<int> level_begin_;
  std::vector<CoarseFace> coarse_faces_;
  std::vector<int> interface_parents_;
  std::vector<char> touches_coarser_;
  std::unordered_map<std::uint64_t, int> index_;
};

/// Leaves (level, position) of a balanced p4est (p8est) forest; internal to Forest.
template <int Dim>
std::vector<std::pair<int, IVec<Dim>>> balanced_leaves(const TankGrid<Dim>& grid, int max_level,
                                                       const RefineRule<Dim>& refine,
                                                       std::int64_t max_cells);

extern template class Forest<2>;
extern template class Forest<3>;

}  // namespace seaway::mesh
