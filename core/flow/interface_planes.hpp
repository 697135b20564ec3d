// The reconstructed interface of a whole forest: one plane in every mixed cell. Planes are kept only for
// blocks that have mixed cells.
#pragma once

#include <vector>

#include "core/flow/flow_state.hpp"
#include "core/flow/plic.hpp"

namespace seaway::flow {

/// What a block is filled with.
enum class BlockPhase : signed char { air, water, mixed };

template <int Dim>
class InterfacePlanes {
 public:
  explicit InterfacePlanes(const Forest<Dim>& forest);
  /// Planes for the volume fractions (parents restricted before).
  void reconstruct(const CellField<double, Dim>& vof) { reconstruct(vof, forest_.leaves(), forest_.leaves()); }
  /// Planes of some leaves alone; those of the others are lost. `changed`: leaves whose values may not be those of the
  /// last call.
  void reconstruct(const CellField<double, Dim>& vof, const std::vector<int>& changed, const std::vector<int>& wanted);
  BlockPhase phase(int b) const { return phase_[static_cast<std::size_t>(b)]; }
  /// The phase that the block and all blocks around it share, or mixed.
  BlockPhase surroundings(int b) const { return around_[static_cast<std::size_t>(b)]; }
  /// Plane of a mixed cell of a leaf; only valid where is_mixed(vof).
  const Plane<Dim>& plane(int b, int cell) const {
    return planes_[static_cast<std::size_t>(slot_[static_cast<std::size_t>(b)]) * BlockShape<Dim>::cells +
                   static_cast<std::size_t>(cell)];
  }

 private:
  const Forest<Dim>& forest_;
  std::vector<BlockPhase> phase_, around_;
  std::vector<int> slot_;
  std::vector<int> mixed_leaves_;
  std::vector<Plane<Dim>> planes_;
};

extern template class InterfacePlanes<2>;
extern template class InterfacePlanes<3>;

}  // namespace seaway::flow
