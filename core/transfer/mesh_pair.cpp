#include "core/transfer/mesh_pair.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace seaway::transfer {
namespace {

template <int Dim>
bool same_tank(const mesh::TankGrid<Dim>& a, const mesh::TankGrid<Dim>& b) {
  return a.lower == b.lower && a.upper == b.upper && a.root_blocks == b.root_blocks &&
         a.periodic == b.periodic;
}

/// The old block at this place, or the leaf above it; `depth` counts the levels between.
template <int Dim>
int block_or_ancestor(const Forest<Dim>& forest, int level, IVec<Dim> coord, int& depth) {
  for (depth = 0; level >= 0; --level, ++depth) {
    const int found = forest.find(level, coord);
    if (found != mesh::no_block) return found;
    for (int& c : coord) c >>= 1;
  }
  fail(ErrorCode::internal, "a block of the new mesh lies outside the old mesh");
}

}  // namespace

template <int Dim>
MeshPair<Dim>::MeshPair(const Forest<Dim>& from, const Forest<Dim>& to) {
  SEAWAY_CHECK(same_tank(from.grid(), to.grid()),
               "fields can be mapped only between meshes of the same tank and base cell; "
               "give all stages the same tank and mesh.base_cell");
  source_.resize(static_cast<std::size_t>(to.n_blocks()));
  for (const int b : to.leaves()) {
    BlockSource& s = source_[static_cast<std::size_t>(b)];
    const Block<Dim>& block = to.block(b);
    s.block = block_or_ancestor<Dim>(from, block.level, block.coord, s.depth);
    if (s.depth > 0) s.origin = Origin::refined;
    else s.origin = from.block(s.block).leaf ? Origin::kept : Origin::coarsened;
    cells_[static_cast<std::size_t>(s.origin)] += BlockShape<Dim>::cells;
    max_depth_ = std::max(max_depth_, s.depth);
  }
}

template <int Dim>
std::vector<std::unique_ptr<Forest<Dim>>> forests_between(const Forest<Dim>& from,
                                                          const Forest<Dim>& to) {
  const MeshPair<Dim> pair(from, to);
  std::vector<std::unique_ptr<Forest<Dim>>> steps;
  if (pair.max_depth() == 0) return steps;
  const int first = pair.cells(Origin::coarsened) > 0 ? 0 : 1;
  for (int k = first; k < pair.max_depth(); ++k) {
    const mesh::RefineRule<Dim> rule = [&from, &to, k](const Vec<Dim>& lower, const Vec<Dim>&, int level) {
      const Vec<Dim> edge = to.cell_size(level) * BlockShape<Dim>::n;
      IVec<Dim> coord{};
      for (int a = 0; a < Dim; ++a)
        coord[a] = static_cast<int>(std::lround((lower[a] - to.grid().lower[a]) / edge[a]));
      const int b = to.find(level, coord);
      if (b == mesh::no_block || to.block(b).leaf) return false;
      int depth = 0;
      const int old = block_or_ancestor<Dim>(from, level, coord, depth);
      return !from.block(old).leaf || depth < k;
    };
    steps.push_back(std::make_unique<Forest<Dim>>(to.grid(), to.n_levels() - 1, rule, to.threads()));
  }
  return steps;
}

template class MeshPair<2>;
template class MeshPair<3>;
template std::vector<std::unique_ptr<Forest<2>>> forests_between<2>(const Forest<2>&, const Forest<2>&);
template std::vector<std::unique_ptr<Forest<3>>> forests_between<3>(const Forest<3>&, const Forest<3>&);

}  // namespace seaway::transfer
