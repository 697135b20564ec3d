// V-cycle on one rectangular grid: the root blocks of a forest put together. Aggregation of 2^Dim cells,
// piecewise constant transfer, coarse coefficients = sum of the fine ones / 2, red-black Gauss-Seidel
// (2 sweeps down, 2 reversed sweeps up, 40 on the last grid). Symmetric, so usable inside CG. Float.
#pragma once

#include <vector>

#include "core/linear/block_kernels.hpp"

namespace seaway::linear {

template <int Dim>
class DenseMultigrid {
 public:
  DenseMultigrid(const IVec<Dim>& cells, const std::array<bool, Dim>& periodic);

  /// Face coefficients of the finest grid: entry (i, j[, k]) with cells[axis] + 1 along `axis`, axis 0 fastest.
  std::vector<float>& coefficients(int axis) { return grids_[0].c[static_cast<std::size_t>(axis)]; }
  void finish();  ///< after the finest coefficients have changed

  std::vector<float>& right_side() { return grids_[0].b; }        ///< cells, axis 0 fastest
  const std::vector<float>& solution() const { return grids_[0].z; }  ///< padded, see `at`
  int at(const IVec<Dim>& cell) const { return grids_[0].padded(cell); }
  /// solution = one V-cycle from zero for right_side.
  void cycle();

 private:
  struct Grid {
    IVec<Dim> n{};
    std::array<std::vector<float>, Dim> c;
    std::vector<float> b, z, inverse_diagonal;  // z has one ghost cell around
    int padded(const IVec<Dim>& i) const;
    int plain(const IVec<Dim>& i) const;
    int face(const IVec<Dim>& i, int axis) const;
    int padded_stride(int axis) const;
  };
  void smooth(Grid& g, int colour) const;
  void wrap(Grid& g) const;
  void descend(std::size_t level);

  std::array<bool, Dim> periodic_;
  std::vector<Grid> grids_;
};

extern template class DenseMultigrid<2>;
extern template class DenseMultigrid<3>;

}  // namespace seaway::linear
