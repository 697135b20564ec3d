#include "core/flow/interface_planes.hpp"

namespace seaway::flow {

using field::cell_strides;
using field::cells_upper;
using field::filled;
using field::for_box;
using field::offset;
using field::Scratch;
using field::ScratchShape;

template <int Dim>
InterfacePlanes<Dim>::InterfacePlanes(const Forest<Dim>& forest)
    : forest_(forest), phase_(static_cast<std::size_t>(forest.n_blocks()), BlockPhase::mixed),
      around_(static_cast<std::size_t>(forest.n_blocks()), BlockPhase::mixed),
      slot_(static_cast<std::size_t>(forest.n_blocks()), -1) {}

template <int Dim>
void InterfacePlanes<Dim>::reconstruct(const CellField<double, Dim>& vof, const std::vector<int>& changed,
                                       const std::vector<int>& wanted) {
  constexpr int cells = BlockShape<Dim>::cells;
  mesh::for_each(changed, forest_.threads(), [&](int b) {
    const double* c = vof.block(b);
    int water = 0, air = 0;
    for (int i = 0; i < cells; ++i) {
      water += c[i] >= 1 - mixed_limit;
      air += c[i] <= mixed_limit;
    }
    phase_[static_cast<std::size_t>(b)] =
        water == cells ? BlockPhase::water : (air == cells ? BlockPhase::air : BlockPhase::mixed);
  });
  for (int level = forest_.n_levels() - 2; level >= 0; --level) {  // parents
    for (int b = forest_.level_begin(level); b < forest_.level_begin(level + 1); ++b) {
      if (forest_.block(b).leaf) continue;
      BlockPhase phase = phase_[static_cast<std::size_t>(forest_.block(b).child[0])];
      for (const int c : forest_.block(b).child)
        if (phase_[static_cast<std::size_t>(c)] != phase) phase = BlockPhase::mixed;
      phase_[static_cast<std::size_t>(b)] = phase;
    }
  }
  mixed_leaves_.clear();
  for (const int b : wanted) {
    const auto& block = forest_.block(b);
    BlockPhase phase = phase_[static_cast<std::size_t>(b)];
    slot_[static_cast<std::size_t>(b)] = -1;
    if (phase == BlockPhase::mixed) {
      slot_[static_cast<std::size_t>(b)] = static_cast<int>(mixed_leaves_.size());
      mixed_leaves_.push_back(b);
    }
    const auto& coarse = block.parent >= 0 ? forest_.block(block.parent).neighbour : block.neighbour;
    for (const int nb : block.neighbour) {
      if (nb >= 0 && phase_[static_cast<std::size_t>(nb)] != phase) phase = BlockPhase::mixed;
      if (nb == mesh::coarser_neighbour) {
        for (const int c : coarse)
          if (c >= 0 && phase_[static_cast<std::size_t>(c)] != phase) phase = BlockPhase::mixed;
      }
    }
    around_[static_cast<std::size_t>(b)] = phase;
  }
  planes_.resize(mixed_leaves_.size() * static_cast<std::size_t>(cells));
  mesh::parallel_for(static_cast<int>(mixed_leaves_.size()), forest_.threads(), [&](int m) {
    const int b = mixed_leaves_[static_cast<std::size_t>(m)];
    Scratch<double, Dim> c;
    field::gather_cells<double, Dim>(forest_, vof, b, 1, c);
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      const double value = c(i);
      if (!is_mixed(value)) return;
      double stencil[Dim == 2 ? 9 : 27];
      int e = 0;
      const double* centre = &c(i);
      for (int k = Dim == 2 ? 0 : -1; k <= (Dim == 2 ? 0 : 1); ++k)
        for (int j = -1; j <= 1; ++j)
          for (int l = -1; l <= 1; ++l)
            stencil[e++] = centre[l + j * ScratchShape<Dim>::stride(1) + (Dim == 3 ? k * ScratchShape<Dim>::stride(2) : 0)];
      Plane<Dim>& plane = planes_[static_cast<std::size_t>(m) * cells +
                                  static_cast<std::size_t>(offset<Dim>(i, cell_strides<Dim>()))];
      plane.normal = interface_normal<Dim>(stencil);
      plane.d = plane_constant<Dim>(plane.normal, value);
    });
  });
}

template class InterfacePlanes<2>;
template class InterfacePlanes<3>;

}  // namespace seaway::flow
