// Projection::repair: a mapped velocity made solenoidal by changing only what the mapping did not copy.
#include "core/field/restrict.hpp"
#include "core/flow/projection.hpp"

namespace seaway::flow {

using field::cell_strides;
using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_box;
using field::offset;

namespace {

/// The leaf that holds cell `i` of block b, or the one beyond its side along `axis`; `i` becomes the cell there.
/// Negative outside the tank and where finer leaves are.
template <int Dim>
int leaf_cell(const Forest<Dim>& forest, int b, int axis, IVec<Dim>& i) {
  constexpr int n = BlockShape<Dim>::n;
  if (i[axis] >= 0 && i[axis] < n) return b;
  const auto& block = forest.block(b);
  const int side = i[axis] < 0 ? 0 : 1;
  const int at = block.across(axis, side);
  if (at == mesh::coarser_neighbour) {
    const auto from = linear::coarse_side<Dim>(forest, block, axis, side);
    for (int a = 0; a < Dim; ++a) i[a] = a == axis ? from.base[a] : from.base[a] + i[a] / 2;
    return from.block;
  }
  if (at < 0 || !forest.block(at).leaf) return mesh::no_block;
  i[axis] += side == 0 ? n : -n;
  return at;
}

/// Cells joined by faces with a coefficient, as a forest of representatives.
class Regions {
 public:
  explicit Regions(std::size_t n) : of_(n) {
    for (std::size_t i = 0; i < n; ++i) of_[i] = i;
  }
  std::size_t find(std::size_t i) {
    while (of_[i] != i) i = of_[i] = of_[of_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a != b) of_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> of_;
};

}  // namespace

/// A face may change only between two free cells.
template <int Dim>
void Projection<Dim>::close_kept_faces(const std::vector<char>& free_cells) {
  const auto is_free = [&](int b, const IVec<Dim>& i) {
    return free_cells[static_cast<std::size_t>(b) * BlockShape<Dim>::cells +
                         static_cast<std::size_t>(offset<Dim>(i, cell_strides<Dim>()))] != 0;
  };
  forest_.for_each_leaf([&](int b) {
    for (int axis = 0; axis < Dim; ++axis) {
      float* c = operator_.coefficients().block(axis, b);
      for_box<Dim>(filled<Dim>(0), faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        bool open = true;
        for (int side = 0; side < 2 && open; ++side) {
          IVec<Dim> cell = i;
          cell[axis] -= 1 - side;
          const int at = leaf_cell<Dim>(forest_, b, axis, cell);
          open = at >= 0 && is_free(at, cell);
        }
        if (!open) c[offset<Dim>(i, face_strides<Dim>(axis))] = 0;
      });
    }
  });
}

/// All sides of a region of free cells are given: what flows in there at large, of the order of the tolerance of
/// the projections before, cannot be repaired, and would let conjugate gradients run away. It stays, spread
/// evenly; cells that nothing can change drop out.
template <int Dim>
void Projection<Dim>::remove_region_means() {
  constexpr int cells = BlockShape<Dim>::cells;
  const auto index = [](int b, const IVec<Dim>& i) {
    return static_cast<std::size_t>(b) * cells + static_cast<std::size_t>(offset<Dim>(i, cell_strides<Dim>()));
  };
  Regions regions(rhs_.data().size());
  for (const int b : forest_.leaves()) {
    for (int axis = 0; axis < Dim; ++axis) {
      const float* c = operator_.coefficients().block(axis, b);
      for_box<Dim>(filled<Dim>(0), faces_upper<Dim>(axis), [&](const IVec<Dim>& i) {
        if (!(c[offset<Dim>(i, face_strides<Dim>(axis))] > 0)) return;
        IVec<Dim> lower = i, upper = i;
        --lower[axis];
        const int below = leaf_cell<Dim>(forest_, b, axis, lower), above = leaf_cell<Dim>(forest_, b, axis, upper);
        if (below >= 0 && above >= 0) regions.join(index(below, lower), index(above, upper));
      });
    }
  }
  std::vector<double> sum(rhs_.data().size(), 0.0), volume(rhs_.data().size(), 0.0);
  for (int pass = 0; pass < 2; ++pass) {
    for (const int b : forest_.leaves()) {
      const double v = forest_.block(b).cell_volume();
      for (int i = 0; i < cells; ++i) {
        const std::size_t at = static_cast<std::size_t>(b) * cells + static_cast<std::size_t>(i);
        const std::size_t region = regions.find(at);
        if (pass == 0) {
          sum[region] += rhs_.data()[at];
          volume[region] += v;
        } else {
          rhs_.data()[at] -= sum[region] / volume[region] * v;
        }
      }
    }
  }
}

template <int Dim>
linear::SolveReport Projection<Dim>::repair(FlowState<Dim>& state, const HullMask<Dim>* mask,
                                            const motion::Twist<Dim>& twist, const std::vector<char>* free_cells,
                                            double dt, const ProjectionOptions& options) {
  if (mask && free_cells) {
    const auto& window = mask->window();
    std::vector<double> w;
    for (int axis = 0; axis < Dim; ++axis) {
      window.load_faces(state.w, axis, w);
      const auto& aperture = mask->half().aperture[static_cast<std::size_t>(axis)];
      IVec<Dim> lower = filled<Dim>(0);
      lower[axis] = 1;
      for_box<Dim>(lower, window.n(), [&](const IVec<Dim>& i) {
        const auto at = static_cast<std::size_t>(window.at(i));
        IVec<Dim> below = i;
        --below[axis];
        if (aperture[at] > 0 || !(*free_cells)[static_cast<std::size_t>(window.global_cell(i))] ||
            !(*free_cells)[static_cast<std::size_t>(window.global_cell(below))])
          return;
        w[at] = motion::velocity_at<Dim>(twist, mask->half().pose, window.face_centre(i, axis))[axis];
      });
      window.store_faces(w, axis, state.w);
    }
  }
  operator_.rigid() = {};
  right_side(state, dt, rhs_);
  if (free_cells) remove_region_means();
  CellField<double, Dim> potential(forest_);
  const auto report = cg_.solve(operator_, multigrid_, rhs_, potential, options.tolerance / (dt * dt),
                                options.max_iterations);
  correct(state, potential, dt, true);
  field::restrict_faces<double, Dim>(forest_, state.w);
  return report;
}

template void Projection<2>::close_kept_faces(const std::vector<char>&);
template void Projection<3>::close_kept_faces(const std::vector<char>&);
template void Projection<2>::remove_region_means();
template void Projection<3>::remove_region_means();
template linear::SolveReport Projection<2>::repair(FlowState<2>&, const HullMask<2>*, const motion::Twist<2>&,
                                                   const std::vector<char>*, double, const ProjectionOptions&);
template linear::SolveReport Projection<3>::repair(FlowState<3>&, const HullMask<3>*, const motion::Twist<3>&,
                                                   const std::vector<char>*, double, const ProjectionOptions&);

}  // namespace seaway::flow
