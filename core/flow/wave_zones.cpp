#include "core/flow/wave_zones.hpp"

#include <algorithm>
#include <cmath>

#include "core/field/restrict.hpp"
#include "core/waves/water_fraction.hpp"

namespace seaway::flow {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::faces_upper;
using field::filled;
using field::for_box;
using field::offset;

template <int Dim>
WaveZones<Dim>::WaveZones(const Forest<Dim>& forest, std::shared_ptr<const waves::WaveField> wave, int axis,
                          const ZoneSpec& lower, const ZoneSpec& upper, double rate)
    : forest_(forest), wave_(std::move(wave)), axis_(axis), spec_{lower, upper}, rate_(rate),
      begin_(forest.grid().lower[axis]), end_(forest.grid().upper[axis]) {
  for (const int b : forest.leaves()) {
    const auto& block = forest.block(b);
    const double lo = block.origin[axis], hi = lo + BlockShape<Dim>::n * block.h[axis];
    if (lo < begin_ + lower.length || hi > end_ - upper.length) blocks_.push_back(b);
  }
}

template <int Dim>
double WaveZones<Dim>::gamma(double s) const {
  const double into_lower = spec_[0].length > 0 ? (begin_ + spec_[0].length - s) / spec_[0].length : 0;
  const double into_upper = spec_[1].length > 0 ? (s - end_ + spec_[1].length) / spec_[1].length : 0;
  const double x = std::clamp(std::max(into_lower, into_upper), 0.0, 1.0);
  return rate_ * x * x;
}

template <int Dim>
bool WaveZones<Dim>::towards_wave(double s) const {
  return drives(s < 0.5 * (begin_ + end_) ? 0 : 1);
}

template <int Dim>
double WaveZones<Dim>::relax_vof(CellField<double, Dim>& vof, double t, double dt) const {
  if (!wave_) return 0;
  const double added = mesh::parallel_sum(static_cast<int>(blocks_.size()), forest_.threads(), [&](int k) {
    const int b = blocks_[static_cast<std::size_t>(k)];
    const auto& block = forest_.block(b);
    const double top = block.origin[Dim - 1] + BlockShape<Dim>::n * block.h[Dim - 1];
    const double reach = 4 * wave_->height();  // beyond it only what drifted there is to be removed
    double* c = vof.block(b);
    double sum = 0;
    if (top < wave_->trough() - reach || block.origin[Dim - 1] > wave_->crest() + reach) return 0.0;
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      const Vec<Dim> x = block.cell_centre(i);
      const double g = gamma(x[axis_]);
      if (g <= 0 || !towards_wave(x[axis_])) return;
      const Vec<Dim> half = 0.5 * block.h;
      double target;
      if (x[Dim - 1] + half[Dim - 1] <= wave_->trough()) target = 1;
      else if (x[Dim - 1] - half[Dim - 1] >= wave_->crest()) target = 0;
      else target = waves::water_fraction<Dim>(*wave_, x - half, x + half, t);
      double& value = c[offset<Dim>(i, cell_strides<Dim>())];
      if (value == target) return;
      const double weight = 1 - std::exp(-g * dt);
      const double next = std::clamp(value + weight * (target - value), 0.0, 1.0);
      sum += (next - value) * block.cell_volume();
      value = next;
    });
    return sum;
  });
  field::restrict_cells<double, Dim>(forest_, vof);
  return added;
}

template <int Dim>
void WaveZones<Dim>::relax_velocity(FlowState<Dim>& state, double t, double dt) const {
  constexpr int n = BlockShape<Dim>::n;
  mesh::parallel_for(static_cast<int>(blocks_.size()), forest_.threads(), [&](int k) {
    const int b = blocks_[static_cast<std::size_t>(k)];
    const auto& block = forest_.block(b);
    field::Scratch<double, Dim> vof;
    field::gather_cells<double, Dim>(forest_, state.vof, b, 1, vof);
    // Columns of faces upwards: the wave is evaluated for a whole column at once.
    for (int a = 0; a < Dim; ++a) {
      double* u = state.u.block(a, b);
      const IVec<Dim> fs = face_strides<Dim>(a);
      IVec<Dim> upper = faces_upper<Dim>(a);
      const int count = upper[Dim - 1];
      upper[Dim - 1] = 1;
      std::array<double, n + 1> z{};
      std::array<Vec3, n + 1> velocity;
      for_box<Dim>(filled<Dim>(0), upper, [&](const IVec<Dim>& foot) {
        const Vec<Dim> x = block.face_centre(foot, a);
        const int side = foot[axis_] == 0 ? 0 : 1;
        const bool on_end = a == axis_ && (foot[axis_] == 0 || foot[axis_] == n) &&
                            block.neighbour[static_cast<std::size_t>(mesh::face_neighbour<Dim>(axis_, side))] == mesh::no_block;
        const double g = gamma(x[axis_]);
        if (g <= 0 && !on_end) return;
        const bool wave = towards_wave(x[axis_]);
        for (int l = 0; l < count; ++l) z[static_cast<std::size_t>(l)] = x[Dim - 1] + l * block.h[Dim - 1];
        if (wave) {
          const Vec3 p = to_vec3<Dim>(x);
          wave_->column_velocity(p.x(), p.y(), t, std::span<const double>(z.data(), static_cast<std::size_t>(count)),
                                 std::span<Vec3>(velocity.data(), static_cast<std::size_t>(count)));
        }
        const int S = field::ScratchShape<Dim>::stride(a);
        for (int l = 0; l < count; ++l) {
          IVec<Dim> i = foot;
          i[Dim - 1] = l;
          const double* c = &vof(i);
          const double water = std::clamp(0.5 * (c[0] + c[-S]), 0.0, 1.0);
          double& value = u[offset<Dim>(i, fs)];
          const double target = wave ? from_vec3<Dim>(velocity[static_cast<std::size_t>(l)])[a] : 0.0;
          if (on_end) {
            value = drives(side) ? water * target : 0.0;
            continue;
          }
          const double rate = g * dt * water;
          value = (value + rate * target) / (1 + rate);
        }
      });
    }
  });
  field::restrict_faces<double, Dim>(forest_, state.u);
}

template <int Dim>
void WaveZones<Dim>::relax_scalar(CellField<double, Dim>& f, double value, double dt) const {
  if (!wave_) return;
  mesh::parallel_for(static_cast<int>(blocks_.size()), forest_.threads(), [&](int k) {
    const int b = blocks_[static_cast<std::size_t>(k)];
    const auto& block = forest_.block(b);
    std::array<double, BlockShape<Dim>::n> weight{};  // by distance from the end
    for (int i = 0; i < BlockShape<Dim>::n; ++i) {
      const double s = block.origin[axis_] + (i + 0.5) * block.h[axis_];
      if (towards_wave(s)) weight[static_cast<std::size_t>(i)] = 1 - std::exp(-gamma(s) * dt);
    }
    double* cells = f.block(b);
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      double& c = cells[offset<Dim>(i, cell_strides<Dim>())];
      c += weight[static_cast<std::size_t>(i[axis_])] * (value - c);
    });
  });
  field::restrict_cells<double, Dim>(forest_, f);
}

template class WaveZones<2>;
template class WaveZones<3>;

}  // namespace seaway::flow
