// The preconditioner of the pressure solve: one multigrid V-cycle over all levels of the forest in float,
// a fast adaptive composite cycle. On level l all blocks of that level, leaves and parents, are smoothed by
// rounds of red-black Gauss-Seidel inside each block with the neighbours' old values (additive over blocks,
// so that neither threads nor block order change a bit); coarse leaves next to them stay frozen.
// Transfers are piecewise constant; a coarse cell stands for one connected piece of what it covers, so that
// thin walls keep the pressures of their two sides apart on all levels. Blocks with pieces that no coarse cell stands for
// are smoothed more often, their neighbours with them. The cycle is symmetric.
#pragma once

#include "core/linear/dense_multigrid.hpp"
#include "core/linear/poisson_operator.hpp"

namespace seaway::linear {

template <int Dim>
class Multigrid {
 public:
  explicit Multigrid(const PoissonOperator<Dim>& op);
  /// After op.finish(): copies the coefficients of the root level.
  void update();
  /// One cycle for the right-hand side r on the leaves; the result is read with `solution`.
  void apply(const CellField<double, Dim>& r);
  /// z of a leaf, to be multiplied by scale().
  const float* solution(int b) const { return z_[current_[static_cast<std::size_t>(b)]].block(b); }
  double scale() const { return scale_; }

 private:
  float* z(int b) { return z_[current_[static_cast<std::size_t>(b)]].block(b); }
  void find_blocks_at_gaps();
  void find_blocks_at_jumps();
  bool has_jump(int b) const;
  void smooth_from_zero(int b);
  void restrict_residual(int parent);
  void flux_to_coarse(int level);
  void correct(int b);
  void smooth_again(int b, bool down);
  /// One round in `count` blocks, all from the values before it.
  template <class BlockAt>
  void smooth_round(int count, const BlockAt& block_at, bool down);
  void smooth_level(int level, bool down);
  void smooth_blocks(const std::vector<int>& blocks, int rounds, bool down);
  void solve_root();

  const PoissonOperator<Dim>& op_;
  const Forest<Dim>& forest_;
  CellField<float, Dim> b_;
  std::array<CellField<float, Dim>, 2> z_;
  std::vector<unsigned char> current_;  ///< by block: which of z_ holds the values
  std::vector<std::vector<int>> at_gaps_;  ///< by level: blocks with gaps (PoissonOperator::has_gaps) and their neighbours
  std::vector<std::vector<int>> at_jumps_;  ///< by level but the finest: blocks in which water meets air
  std::vector<std::vector<int>> coarse_leaves_;  ///< by level: leaves with a finer neighbour
  std::vector<int> first_coarse_face_;
  DenseMultigrid<Dim> root_;
  double scale_ = 1;
};

extern template class Multigrid<2>;
extern template class Multigrid<3>;

}  // namespace seaway::linear
