// The pressure operator on the leaves of a forest,
//
//   (A p)_c = sum_f c_f (p_c - p_nb),     c_f = a_f A_f / (rho_f d_f)          [docs/numerics.md, projection]
//
// with rows for a moving rigid body added: A + J M^-1 J^T. Coefficients are float and *are* the operator: the
// velocity correction uses the same values. On walls c = 0; on an open top the distance is half a cell and the
// pressure behind it 0; on a coarse-fine face d = 3/4 of the coarse cell and the fine side's coefficients count.
#pragma once

#include <vector>

#include "core/linear/block_kernels.hpp"

namespace seaway::linear {

template <int Dim>
inline constexpr int n_dof = Dim == 2 ? 3 : 6;

/// Rows of the rigid body: cell index (block * cells + cell) and J_c, and the effective inverse mass.
template <int Dim>
struct RigidRows {
  std::vector<std::int64_t> cell;
  std::vector<Eigen::Matrix<double, n_dof<Dim>, 1>> j;
  Eigen::Matrix<double, n_dof<Dim>, n_dof<Dim>> inverse_mass =
      Eigen::Matrix<double, n_dof<Dim>, n_dof<Dim>>::Zero();

  /// sum_c J_c p_c, in list order.
  Eigen::Matrix<double, n_dof<Dim>, 1> gather(const std::vector<double>& p) const {
    Eigen::Matrix<double, n_dof<Dim>, 1> sum = Eigen::Matrix<double, n_dof<Dim>, 1>::Zero();
    for (std::size_t i = 0; i < cell.size(); ++i) sum += j[i] * p[static_cast<std::size_t>(cell[i])];
    return sum;
  }
};

template <int Dim>
class PoissonOperator {
 public:
  explicit PoissonOperator(const Forest<Dim>& forest);

  const Forest<Dim>& forest() const { return forest_; }
  /// Face coefficients: the caller fills those of all leaves, then calls finish().
  FaceField<float, Dim>& coefficients() { return c_; }
  const FaceField<float, Dim>& coefficients() const { return c_; }
  /// Coefficients of coarse leaves at level jumps and of all parents (sum of the fine ones / 2), inverse diagonals.
  void finish();

  RigidRows<Dim>& rigid() { return rigid_; }
  const RigidRows<Dim>& rigid() const { return rigid_; }

  /// out = (A + J M^-1 J^T) p on the leaves; returns p . out.
  double apply(const CellField<double, Dim>& p, CellField<double, Dim>& out) const;

  const CellField<float, Dim>& inverse_diagonal() const { return inverse_diagonal_; }

  /// Whether some cells of a block (not of the root level) are left out of their coarse cell; then `kept` says
  /// which are not: 1, else 0. A coarse cell stands for one connected piece of what it covers, the largest:
  /// a wall inside a coarse cell would otherwise let the pressure through.
  bool has_gaps(int b) const { return has_gaps_[static_cast<std::size_t>(b)] != 0; }
  const float* kept(int b) const { return kept_.block(b); }

 private:
  void find_pieces(int b);
  bool is_kept(int b, IVec<Dim> cell) const;
  void restrict_coefficients(int parent);
  /// Ghosts of a coarse leaf towards finer blocks that give exactly the sum of the fine fluxes.
  void conservative_ghosts(const mesh::CoarseFace& face, const CellField<double, Dim>& p,
                           Scratch<double, Dim>& z) const;

  const Forest<Dim>& forest_;
  FaceField<float, Dim> c_;
  CellField<float, Dim> inverse_diagonal_;
  CellField<float, Dim> kept_, size_;  ///< size: part of the cell that it stands for, seen from below
  std::vector<char> has_gaps_;
  RigidRows<Dim> rigid_;
  std::vector<int> first_coarse_face_;  ///< by block: index into forest.coarse_faces(), or -1
};

extern template class PoissonOperator<2>;
extern template class PoissonOperator<3>;

}  // namespace seaway::linear
