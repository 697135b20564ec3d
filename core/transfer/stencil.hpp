// Interpolation stencils in index space. Around a coarse cell or face the neighbours lie on a lattice with
// unit spacing along every axis, whatever the aspect ratio of the cells; so weights depend only on the kind
// of target and on which layers of the stencil lie outside the tank, and are computed once for each of those
// few combinations.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "core/field/scratch.hpp"

namespace seaway::transfer {

/// What a rule makes of points and targets.
struct PointWeights {
  Eigen::MatrixXd weight;  ///< [target, point]
  double lebesgue = 1;     ///< largest sum of |weight| over the targets
  bool fell_back = false;  ///< a simpler rule than the one asked for
};

/// Weights with which values at `points` give values at `targets`; the origin is the coarse cell or face.
template <int Dim>
using WeightRule = std::function<PointWeights(const std::vector<Vec<Dim>>& points,
                                              const std::vector<Vec<Dim>>& targets)>;

/// Weights ready for a kernel: value(t) = sum_j weight[t * points + j] scratch[centre + offset[j]].
struct Stencil {
  int points = 0, targets = 0;
  std::vector<int> offset;
  std::vector<double> weight;
  double lebesgue = 1;
  bool fell_back = false;
  bool one_sided = false;  ///< some layers are missing
};

/// All stencils of one kind of target. `lower` <= offset <= `upper` (at most 2 below, 3 above) is the full
/// box of lattice points. Safe to use from several threads.
template <int Dim>
class StencilTable {
 public:
  StencilTable(const IVec<Dim>& lower, const IVec<Dim>& upper, std::vector<Vec<Dim>> targets,
               WeightRule<Dim> rule);

  /// Stencil for lattice position `i` when, along axis a, only positions first[a] .. last[a] carry values.
  const Stencil& at(const IVec<Dim>& i, const IVec<Dim>& first, const IVec<Dim>& last);

 private:
  static constexpr int max_states = 8;
  const Stencil& build(std::size_t state, const IVec<Dim>& lower, const IVec<Dim>& upper);

  const IVec<Dim> lower_, upper_;
  const std::vector<Vec<Dim>> targets_;
  const WeightRule<Dim> rule_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Stencil>> stencil_;  // guarded by mutex_ but for the complete one, entry 0
};

/// The three kinds of target that a refinement needs. Children are counted as in Block::child; of a face's
/// axis only bit 0 occurs. `radius` 1: 3 points along an axis (4 for faces_between), 2: 5 (6).
template <int Dim>
std::unique_ptr<StencilTable<Dim>> child_cells(int radius, WeightRule<Dim> rule);
/// Parts of a coarse face, which lie on it.
template <int Dim>
std::unique_ptr<StencilTable<Dim>> faces_on(int axis, int radius, WeightRule<Dim> rule);
/// Faces halfway between a coarse face and the next one along `axis`.
template <int Dim>
std::unique_ptr<StencilTable<Dim>> faces_between(int axis, int radius, WeightRule<Dim> rule);

}  // namespace seaway::transfer
