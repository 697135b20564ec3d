// What a stage's flow is asked for between steps: volumes of water, heights, velocities.
#include <algorithm>
#include <cmath>

#include "core/flow/pressure_probe.hpp"
#include "core/sim/simulation.hpp"

namespace seaway::sim {

using field::cell_strides;
using field::cells_upper;
using field::face_strides;
using field::filled;
using field::for_box;
using field::offset;
using mesh::BlockShape;

template <int Dim>
WaterBalance Simulation<Dim>::water() const {
  std::vector<char> in_window(static_cast<std::size_t>(forest_->n_blocks()), 0);
  WaterBalance balance;
  if (mask_) {
    for (const auto& tile : mask_->window().tiles()) in_window[static_cast<std::size_t>(tile.block)] = 1;
    for (const double v : book_.visible()) balance.visible += v;
    balance.reservoir = book_.reservoir_total();
  }
  balance.visible += forest_->sum_over_leaves([&](int b) {
    if (in_window[static_cast<std::size_t>(b)]) return 0.0;
    double sum = 0;
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) sum += state_.vof.block(b)[i];
    return sum * forest_->block(b).cell_volume();
  });
  balance.exchanged = exchanged_;
  return balance;
}

template <int Dim>
std::vector<double> Simulation<Dim>::compartment_volumes() const {
  std::vector<double> out(model_->compartments.size(), 0.0);
  if (!mask_ || out.empty()) return out;
  const auto& window = mask_->window();
  window.for_cells([&](const IVec<Dim>& i) {
    const double v = book_.visible()[static_cast<std::size_t>(window.at(i))];
    if (v <= 0) return;
    const auto& spaces = mask_->now().space;
    const int space = spaces.empty() ? mask_->space_at(window.cell_centre(i))
                                     : spaces[static_cast<std::size_t>(window.at(i))];
    if (space > 0) out[static_cast<std::size_t>(space - 1)] += v;
  });
  return out;
}

template <int Dim>
double Simulation<Dim>::elevation(double x, double y) const {
  Vec3 at(x, y, 0);
  Vec<Dim> foot = from_vec3<Dim>(at);
  double z = forest_->grid().lower[Dim - 1], water = 0;
  while (z < forest_->grid().upper[Dim - 1] - 1e-12) {
    foot[Dim - 1] = z + 1e-9;
    const int b = forest_->find_leaf(foot);
    const auto& block = forest_->block(b);
    IVec<Dim> i{};
    for (int a = 0; a < Dim - 1; ++a)
      i[a] = std::clamp(static_cast<int>((foot[a] - block.origin[a]) / block.h[a]), 0, BlockShape<Dim>::n - 1);
    for (int l = 0; l < BlockShape<Dim>::n; ++l) {
      i[Dim - 1] = l;
      water += block.h[Dim - 1] * state_.vof.block(b)[offset<Dim>(i, cell_strides<Dim>())];
    }
    z = block.origin[Dim - 1] + BlockShape<Dim>::n * block.h[Dim - 1];
  }
  return forest_->grid().lower[Dim - 1] + water;
}

template <int Dim>
double Simulation<Dim>::pressure(const Probe& probe) const {
  Vec<Dim> x = from_vec3<Dim>(probe.place);
  if (probe.on_hull) x = motion::to_earth(body_.pose, Vec<Dim>(x - model_->body.cog));
  return flow::pressure_at<Dim>(*forest_, state_, model_->fluids, mask_.get(), x).value_or(0.0);
}

template <int Dim>
double Simulation<Dim>::rms_water_velocity() const {
  double volume = 0;
  const auto sum_of = [&](bool squares) {
    return forest_->sum_over_leaves([&](int b) {
      double sum = 0;
      const double* vof = state_.vof.block(b);
      for_box<Dim>(filled<Dim>(0), cells_upper<Dim>(), [&](const IVec<Dim>& i) {
        const double c = vof[offset<Dim>(i, cell_strides<Dim>())];
        double square = 1;
        if (squares) {
          square = 0;
          for (int a = 0; a < Dim; ++a) {
            const IVec<Dim> fs = face_strides<Dim>(a);
            const double* w = state_.w.block(a, b) + offset<Dim>(i, fs);
            const double mean = 0.5 * (w[0] + w[fs[a]]);
            square += mean * mean;
          }
        }
        sum += c * square;
      });
      return sum * forest_->block(b).cell_volume();
    });
  };
  volume = sum_of(false);
  return volume > 0 ? std::sqrt(sum_of(true) / volume) : 0.0;
}

#define SEAWAY_INSTANTIATE(D)                                            \
  template WaterBalance Simulation<D>::water() const;                      \
  template std::vector<double> Simulation<D>::compartment_volumes() const; \
  template double Simulation<D>::elevation(double, double) const;          \
  template double Simulation<D>::pressure(const Probe&) const;             \
  template double Simulation<D>::rms_water_velocity() const;
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::sim
