// Values of newly refined blocks by stencils (core/transfer/stencil.hpp) around the coarse cell or face they
// lie in. All blocks must lie at most one level below their source (core/transfer/mesh_pair.hpp makes steps
// of that kind). Parents of `in` must hold restricted values. Loops run over leaves on the new forest's
// threads; the number of threads changes no bit.
#pragma once

#include "core/field/field.hpp"
#include "core/transfer/mesh_pair.hpp"
#include "core/transfer/stencil.hpp"

namespace seaway::transfer {

using field::CellField;
using field::FaceField;

/// What is done to the children of a coarse cell after interpolation.
enum class Limit {
  none,     ///< nothing: most accurate for smooth fields; neither bounded nor conservative
  mean,     ///< shifted to the coarse value as their mean: conservative
  stencil,  ///< child = coarse value + theta (child - mean of children), the largest theta in [0, 1] that
            ///< keeps all children between the least and the largest value of the stencil (one-sided
            ///< stencils at the tank's sides: widened by half that range)
  bounds,   ///< the same between given bounds
};

struct CellRule {
  Limit limit = Limit::stencil;
  double lower = 0, upper = 1;  ///< for Limit::bounds
};

struct RefineCount {
  std::int64_t fall_backs = 0;  ///< coarse cells or faces whose stencil dropped to a simpler rule
  double lebesgue = 1;          ///< largest sum of |weights|
  void add(const RefineCount& other) {
    fall_backs += other.fall_backs;
    lebesgue = lebesgue > other.lebesgue ? lebesgue : other.lebesgue;
  }
};

/// Fills the refined leaves of `out`. With `vof` (over `from`) Limit::none holds only where the nearest
/// neighbours are all water or all air; at the interface the stencil limit takes its place: for the
/// pressure, which has a kink there.
template <int Dim>
RefineCount refine_cells(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
                         StencilTable<Dim>& table, const CellRule& rule, const CellField<double, Dim>& in,
                         CellField<double, Dim>& out, const CellField<double, Dim>* vof = nullptr);

/// Stencils of one axis' faces.
template <int Dim>
struct FaceTables {
  std::unique_ptr<StencilTable<Dim>> on, between;
};

/// Fills the refined leaves of `out`, all axes. Parts of a coarse face keep that face's value as their mean
/// (what flows through it is conserved), faces inside coarse cells are interpolated. With `limited` both stay
/// within the values of their stencil. Faces shared with a kept block take the kept block's values, and two
/// new blocks that share a face hold the same bits. Coarse leaves' faces at level jumps are not yet
/// restricted.
template <int Dim>
RefineCount refine_faces(const Forest<Dim>& from, const Forest<Dim>& to, const MeshPair<Dim>& pair,
                         std::array<FaceTables<Dim>, Dim>& tables, bool limited,
                         const FaceField<double, Dim>& in, FaceField<double, Dim>& out);

/// Makes the two copies of every face between leaves of one size equal: a kept block's value wins over a new
/// one's, else the lower block's. Without `pair` all blocks count as new.
template <int Dim>
void unite_faces(const Forest<Dim>& to, const MeshPair<Dim>* pair, int axis, FaceField<double, Dim>& out);

}  // namespace seaway::transfer
