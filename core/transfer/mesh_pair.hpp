// How the leaves of one forest lie in another forest of the same tank: which blocks stay as they are, which
// are parts of a coarser leaf, which gather finer leaves. Blocks are the unit: all cells of a block share
// their origin.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/mesh/forest.hpp"

namespace seaway::transfer {

using mesh::Block;
using mesh::BlockShape;
using mesh::Forest;

/// Where the values of a new block come from.
enum class Origin : char {
  kept = 0,       ///< the same leaf in the old forest: copied, bit by bit
  refined = 1,    ///< an old leaf that is larger: interpolated
  coarsened = 2,  ///< old leaves that are smaller: their means
};

struct BlockSource {
  Origin origin = Origin::kept;
  int block = 0;  ///< old block: the leaf itself, the ancestor leaf, or the parent at the same place
  int depth = 0;  ///< levels that the new leaf lies below `block`; 0 unless refined
};

/// Sources of all leaves of `to`. Immutable. Throws Error(invalid_argument) unless both forests have the
/// same tank and root blocks.
template <int Dim>
class MeshPair {
 public:
  MeshPair(const Forest<Dim>& from, const Forest<Dim>& to);

  /// Source of leaf `b` of the new forest.
  const BlockSource& source(int b) const { return source_[static_cast<std::size_t>(b)]; }
  std::int64_t cells(Origin origin) const { return cells_[static_cast<std::size_t>(origin)]; }
  int max_depth() const { return max_depth_; }

 private:
  std::vector<BlockSource> source_;  // by block of the new forest; only leaves are set
  std::array<std::int64_t, 3> cells_{};
  int max_depth_ = 0;
};

/// Forests between `from` and `to`, so that each step either only coarsens (the first) or refines every
/// leaf by one level at most. Empty when `from` -> `to` is such a step itself.
///
/// Step k has at every point the coarser of `to` and of `from` with k further levels. The coarser of two
/// balanced trees is balanced, so p4est adds nothing.
template <int Dim>
std::vector<std::unique_ptr<Forest<Dim>>> forests_between(const Forest<Dim>& from, const Forest<Dim>& to);

}  // namespace seaway::transfer
