#include "core/flow/pressure_probe.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::flow {
namespace {

/// Whether the pressure is solved in the finest cell around q, on the side of space `space` of a thin wall.
template <int Dim>
bool is_open(const HullMask<Dim>& mask, const Vec<Dim>& q, int space) {
  const HullWindow<Dim>& window = mask.window();
  const Vec<Dim> lower = window.cell_centre(field::filled<Dim>(0)) - 0.5 * window.h();
  IVec<Dim> i{};
  for (int a = 0; a < Dim; ++a) {
    i[a] = static_cast<int>(std::floor((q[a] - lower[a]) / window.h()[a]));
    if (i[a] < 0 || i[a] >= window.n()[a]) return true;
  }
  if (window.tile_of(i) < 0) return true;  // the hull cannot touch it
  const auto at = static_cast<std::size_t>(window.at(i));
  const auto& spaces = mask.half().space;
  if (!spaces.empty() && apart(spaces[at], static_cast<signed char>(space))) return false;
  for (int a = 0; a < Dim; ++a) {
    const auto& aperture = mask.half().aperture[static_cast<std::size_t>(a)];
    if (aperture[at] > 0 || aperture[at + static_cast<std::size_t>(window.stride(a))] > 0) return true;
  }
  return false;
}

/// Cell of the leaf that holds q: its entry in cell fields, and its centre.
template <int Dim>
int entry_of(const mesh::Block<Dim>& block, const Vec<Dim>& q, Vec<Dim>& centre) {
  IVec<Dim> i{};
  for (int a = 0; a < Dim; ++a)
    i[a] = std::clamp(static_cast<int>((q[a] - block.origin[a]) / block.h[a]), 0, BlockShape<Dim>::n - 1);
  centre = block.cell_centre(i);
  return field::offset<Dim>(i, field::cell_strides<Dim>());
}

}  // namespace

template <int Dim>
std::optional<double> pressure_at(const Forest<Dim>& forest, const FlowState<Dim>& state, const FluidProperties& fluids,
                                  const HullMask<Dim>* mask, const Vec<Dim>& x) {
  const auto& home = forest.block(forest.find_leaf(x));
  const int space = mask ? mask->space_at(x) : 0;
  Vec<Dim> first, part;  // centre of the lowest of the cells around x, and where x lies between them
  for (int a = 0; a < Dim; ++a) {
    const double at = (x[a] - home.origin[a]) / home.h[a] - 0.5;
    part[a] = at - std::floor(at);
    first[a] = home.origin[a] + (std::floor(at) + 0.5) * home.h[a];
  }
  double sum = 0, weights = 0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    Vec<Dim> q = first;
    double weight = 1;
    bool inside = true;
    for (int a = 0; a < Dim; ++a) {
      const int up = (corner >> a) & 1;
      q[a] += up * home.h[a];
      weight *= up ? part[a] : 1 - part[a];
      inside = inside && q[a] > forest.grid().lower[a] && q[a] < forest.grid().upper[a];
    }
    if (!inside || !(weight > 0) || (mask && !is_open<Dim>(*mask, q, space))) continue;
    const int b = forest.find_leaf(q);
    Vec<Dim> centre;
    const int at = entry_of<Dim>(forest.block(b), q, centre);
    const double rise = centre[Dim - 1] - x[Dim - 1];
    sum += weight * (state.p.block(b)[at] + fluids.rho(state.vof.block(b)[at]) * fluids.gravity * rise);
    weights += weight;
  }
  if (!(weights > 0)) return std::nullopt;
  return sum / weights;
}

template std::optional<double> pressure_at(const Forest<2>&, const FlowState<2>&, const FluidProperties&,
                                           const HullMask<2>*, const Vec2&);
template std::optional<double> pressure_at(const Forest<3>&, const FlowState<3>&, const FluidProperties&,
                                           const HullMask<3>*, const Vec3&);

}  // namespace seaway::flow
