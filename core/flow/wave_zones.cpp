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
WaveZones<Dim>::WaveZones(const Forest<Dim>& forest, std::shared_ptr<const waves::WaveField> wave,
                          const SideZones<Dim>& sides, double rate)
    : forest_(forest), wave_(std::move(wave)), sides_(sides), rate_(rate) {
  const auto& tank = forest.grid();
  for (const int b : forest.leaves()) {
    const auto& block = forest.block(b);
    bool touches = false;
    for (int a = 0; a + 1 < Dim; ++a) {
      const auto& [lower, upper] = sides_[static_cast<std::size_t>(a)];
      const double lo = block.origin[a], hi = lo + BlockShape<Dim>::n * block.h[a];
      touches = touches || (has_zones(a) && (lo < tank.lower[a] + lower.length || hi > tank.upper[a] - upper.length));
    }
    if (touches) blocks_.push_back(b);
  }
}

template <int Dim>
bool WaveZones<Dim>::has_zones(int axis) const {
  if (axis + 1 >= Dim) return false;
  const auto& [lower, upper] = sides_[static_cast<std::size_t>(axis)];
  return lower.length > 0 || upper.length > 0;
}

template <int Dim>
typename WaveZones<Dim>::Pull WaveZones<Dim>::pull_at(const Vec<Dim>& x) const {
  const auto& tank = forest_.grid();
  double deepest = 0;
  Pull out;
  for (int a = 0; a + 1 < Dim; ++a) {
    const auto& [lower, upper] = sides_[static_cast<std::size_t>(a)];
    const double into_lower = lower.length > 0 ? (tank.lower[a] + lower.length - x[a]) / lower.length : 0;
    const double into_upper = upper.length > 0 ? (x[a] - tank.upper[a] + upper.length) / upper.length : 0;
    const double into = std::clamp(std::max(into_lower, into_upper), 0.0, 1.0);
    if (!(into > deepest)) continue;
    deepest = into;
    out.to_wave = drives(a, into_lower >= into_upper ? 0 : 1);
  }
  out.rate = rate_ * deepest * deepest;
  return out;
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
      const Pull pull = pull_at(x);
      if (pull.rate <= 0 || !pull.to_wave) return;
      const Vec<Dim> half = 0.5 * block.h;
      double target;
      if (x[Dim - 1] + half[Dim - 1] <= wave_->trough()) target = 1;
      else if (x[Dim - 1] - half[Dim - 1] >= wave_->crest()) target = 0;
      else target = waves::water_fraction<Dim>(*wave_, x - half, x + half, t);
      double& value = c[offset<Dim>(i, cell_strides<Dim>())];
      if (value == target) return;
      const double weight = 1 - std::exp(-pull.rate * dt);
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
        const int side = foot[a] == 0 ? 0 : 1;
        const bool on_end = has_zones(a) && (foot[a] == 0 || foot[a] == n) && block.across(a, side) == mesh::no_block;
        const Pull pull = pull_at(x);
        if (pull.rate <= 0 && !on_end) return;
        const bool wave = on_end ? drives(a, side) : pull.to_wave;
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
            value = water * target;
            continue;
          }
          const double rate = pull.rate * dt * water;
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
    double* cells = f.block(b);
    for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
      const Pull pull = pull_at(block.cell_centre(i));
      double& c = cells[offset<Dim>(i, cell_strides<Dim>())];
      if (pull.to_wave) c += (1 - std::exp(-pull.rate * dt)) * (value - c);
    });
  });
  field::restrict_cells<double, Dim>(forest_, f);
}

template class WaveZones<2>;
template class WaveZones<3>;

}  // namespace seaway::flow
