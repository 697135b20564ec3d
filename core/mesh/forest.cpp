#include "core/mesh/forest.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace seaway::mesh {

template <int Dim>
TankGrid<Dim> make_tank_grid(const Vec<Dim>& lower, const Vec<Dim>& upper, double base_cell,
                             const std::array<bool, Dim>& periodic, double stretch_x) {
  TankGrid<Dim> grid{lower, upper, {}, periodic};
  SEAWAY_CHECK(base_cell > 0, "mesh base cell is {} m; it must be positive", base_cell);
  for (int a = 0; a < Dim; ++a) {
    const double length = upper[a] - lower[a];
    SEAWAY_CHECK(length > 0, "the tank's extent along axis {} is {} m; it must be positive", a, length);
    const double cell = Dim == 3 && a == 0 ? stretch_x * base_cell : base_cell;
    const double blocks = length / (cell * BlockShape<Dim>::n);
    int count = std::max(1, static_cast<int>(std::lround(blocks)));
    if (blocks / count > 1.12) ++count;
    grid.root_blocks[a] = count;
  }
  return grid;
}

template <int Dim>
Forest<Dim>::Forest(const TankGrid<Dim>& grid, int max_level, const RefineRule<Dim>& refine, int threads,
                    std::int64_t max_cells)
    : grid_(grid), threads_(threads) {
  for (int a = 0; a < Dim; ++a) {
    SEAWAY_CHECK(grid.root_blocks[a] > 0 && grid.upper[a] > grid.lower[a],
                 "the tank is empty along axis {}", a);
  }
  build_tree(balanced_leaves<Dim>(grid, max_level, refine, max_cells));
  link_neighbours();
  list_interfaces();
}

template <int Dim>
std::uint64_t Forest<Dim>::key(int level, const IVec<Dim>& coord) {
  std::uint64_t k = static_cast<std::uint64_t>(level);
  for (int a = 0; a < Dim; ++a) k = (k << 19) | static_cast<std::uint64_t>(coord[a] & 0x7ffff);
  return k;
}

template <int Dim>
int Forest<Dim>::find(int level, const IVec<Dim>& coord) const {
  const auto it = index_.find(key(level, coord));
  return it == index_.end() ? no_block : it->second;
}

template <int Dim>
Vec<Dim> Forest<Dim>::cell_size(int level) const {
  Vec<Dim> h;
  for (int a = 0; a < Dim; ++a) {
    h[a] = (grid_.upper[a] - grid_.lower[a]) / (grid_.root_blocks[a] * Shape::n) / (1 << level);
  }
  return h;
}

template <int Dim>
int Forest<Dim>::find_leaf(const Vec<Dim>& x) const {
  for (int level = n_levels() - 1; level >= 0; --level) {
    const Vec<Dim> edge = cell_size(level) * Shape::n;
    IVec<Dim> coord;
    for (int a = 0; a < Dim; ++a) {
      const int count = grid_.root_blocks[a] << level;
      coord[a] = std::clamp(static_cast<int>(std::floor((x[a] - grid_.lower[a]) / edge[a])), 0, count - 1);
    }
    const int b = find(level, coord);
    if (b != no_block && block(b).leaf) return b;
  }
  fail(ErrorCode::internal, "no leaf covers a point of the tank");
}

namespace {

template <int Dim>
std::uint64_t morton(const IVec<Dim>& coord) {
  std::uint64_t m = 0;
  for (int bit = 0; bit < 20; ++bit)
    for (int a = 0; a < Dim; ++a)
      m |= static_cast<std::uint64_t>((coord[a] >> bit) & 1) << (bit * Dim + a);
  return m;
}

}  // namespace

template <int Dim>
void Forest<Dim>::build_tree(const std::vector<std::pair<int, IVec<Dim>>>& leaves) {
  struct Node {
    int level;
    IVec<Dim> coord;
    bool leaf;
    std::uint64_t order;
  };
  std::unordered_map<std::uint64_t, Node> nodes;
  for (const auto& [level, coord] : leaves) {
    nodes.emplace(key(level, coord), Node{level, coord, true, morton<Dim>(coord)});
    IVec<Dim> up = coord;
    for (int l = level - 1; l >= 0; --l) {
      for (int& c : up) c >>= 1;
      if (!nodes.emplace(key(l, up), Node{l, up, false, morton<Dim>(up)}).second) break;
    }
  }
  std::vector<Node> sorted;
  sorted.reserve(nodes.size());
  for (const auto& [k, node] : nodes) sorted.push_back(node);
  std::sort(sorted.begin(), sorted.end(), [](const Node& a, const Node& b) {
    return a.level != b.level ? a.level < b.level : a.order < b.order;
  });
  blocks_.resize(sorted.size());
  for (std::size_t b = 0; b < sorted.size(); ++b) {
    const Node& node = sorted[b];
    Block<Dim>& block = blocks_[b];
    block.level = node.level;
    block.coord = node.coord;
    block.leaf = node.leaf;
    block.child.fill(no_block);
    block.h = cell_size(node.level);
    for (int a = 0; a < Dim; ++a) block.origin[a] = grid_.lower[a] + block.coord[a] * Shape::n * block.h[a];
    if (static_cast<int>(level_begin_.size()) <= node.level) level_begin_.push_back(static_cast<int>(b));
    index_[key(node.level, node.coord)] = static_cast<int>(b);
    if (node.leaf) leaves_.push_back(static_cast<int>(b));
    if (node.level > 0) {
      IVec<Dim> up = node.coord;
      int child = 0;
      for (int a = 0; a < Dim; ++a) {
        child |= (up[a] & 1) << a;
        up[a] >>= 1;
      }
      block.parent = index_.at(key(node.level - 1, up));
      blocks_[static_cast<std::size_t>(block.parent)].child[static_cast<std::size_t>(child)] = static_cast<int>(b);
    }
  }
  level_begin_.push_back(n_blocks());
}

template <int Dim>
void Forest<Dim>::link_neighbours() {
  for (Block<Dim>& block : blocks_) {
    for (int entry = 0; entry < Shape::neighbours; ++entry) {
      IVec<Dim> at = block.coord;
      bool outside = false;
      int rest = entry;
      for (int a = 0; a < Dim; ++a) {
        at[a] += rest % 3 - 1;
        rest /= 3;
        const int count = grid_.root_blocks[a] << block.level;
        if (at[a] < 0 || at[a] >= count) {
          if (grid_.periodic[a]) at[a] = (at[a] + count) % count;
          else outside = true;
        }
      }
      const int found = outside ? no_block : find(block.level, at);
      block.neighbour[static_cast<std::size_t>(entry)] =
          outside ? no_block : (found == no_block ? coarser_neighbour : found);
    }
  }
}

template <int Dim>
void Forest<Dim>::list_interfaces() {
  touches_coarser_.assign(blocks_.size(), 0);
  for (const int b : leaves_) {
    const Block<Dim>& leaf = block(b);
    for (int axis = 0; axis < Dim; ++axis) {
      for (int side = 0; side < 2; ++side) {
        const int nb = leaf.across(axis, side);
        if (nb >= 0 && !block(nb).leaf) coarse_faces_.push_back({b, axis, side, nb});
      }
    }
    for (const int nb : leaf.neighbour) {
      if (nb == coarser_neighbour) touches_coarser_[static_cast<std::size_t>(b)] = 1;
    }
  }
  // A parent is read when a leaf touches it, or when one of its children needs coarse values around it;
  // its children must then be filled as well.
  std::vector<char> wanted(blocks_.size(), 0);
  for (int b = 0; b < n_blocks(); ++b) {
    const Block<Dim>& parent = block(b);
    if (parent.leaf) continue;
    bool need = parent.parent != no_block && wanted[static_cast<std::size_t>(parent.parent)];
    for (const int nb : parent.neighbour) need = need || (nb >= 0 && block(nb).leaf);
    for (const int c : parent.child) {
      for (const int nb : block(c).neighbour) need = need || nb == coarser_neighbour;
    }
    wanted[static_cast<std::size_t>(b)] = need;
  }
  for (int b = n_blocks() - 1; b >= 0; --b) {
    if (wanted[static_cast<std::size_t>(b)]) interface_parents_.push_back(b);
  }
}

template class Forest<2>;
template class Forest<3>;
template TankGrid<2> make_tank_grid<2>(const Vec<2>&, const Vec<2>&, double, const std::array<bool, 2>&,
                                             double);
template TankGrid<3> make_tank_grid<3>(const Vec<3>&, const Vec<3>&, double, const std::array<bool, 3>&,
                                             double);

}  // namespace seaway::mesh
