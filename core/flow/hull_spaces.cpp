// Walls::thin of HullMask: spaces of cells, what they make of a face, and the fluid that they take.
#include <algorithm>

#include "core/flow/hull_mask.hpp"

namespace seaway::flow {

using field::filled;
using field::for_box;

template <int Dim>
void HullMask<Dim>::find_spaces(HullGeometry<Dim>& g) const {
  constexpr int nb = BlockShape<Dim>::n;
  g.space.assign(window_.size(), 0);
  // Only near the compartments is there another space than the sea: the hull's own solid counts to it.
  hull::Box<Dim> box = hull_->compartment_bounds();
  const double more = 6 * window_.h().maxCoeff();
  box.lower.array() -= more;
  box.upper.array() += more;
  const auto& tiles = window_.tiles();
  mesh::parallel_for(static_cast<int>(tiles.size()), window_.forest().threads(), [&](int t) {
    const auto& tile = tiles[static_cast<std::size_t>(t)];
    IVec<Dim> upper = tile.at;
    for (int& u : upper) u += nb;
    for_box<Dim>(tile.at, upper, [&](const IVec<Dim>& i) {
      const Vec<Dim> x = motion::earth_to_hull<Dim>(body_, g.pose, window_.cell_centre(i));
      if ((x.array() < box.lower.array()).any() || (x.array() > box.upper.array()).any()) return;
      g.space[static_cast<std::size_t>(window_.at(i))] = static_cast<signed char>(hull_->space_near(x));
    });
  });
}

/// Part of a face's control volume that is closed for the flow through the face.
template <int Dim>
hull::SolidPart<Dim> HullMask<Dim>::closed_part(const HullGeometry<Dim>& g, const hull::HullPatch<Dim>& patch,
                                                const hull::OrientedBox<Dim>& box, const IVec<Dim>& face,
                                                int axis) const {
  if (g.space.empty()) return patch.solid_part(box);
  const auto at = static_cast<std::size_t>(window_.at(face));
  const signed char high = g.space[at];
  const signed char low = face[axis] > 0 ? g.space[at - static_cast<std::size_t>(window_.stride(axis))] : high;
  if (apart(low, high)) {
    const hull::SolidPart<Dim> hole = patch.opening_part(box);
    const double volume = window_.cell_volume();
    return {volume - hole.volume, volume * box.centre - hole.moment};
  }
  if (low < 0 || high < 0) return patch.solid_part(box);
  return patch.outside_space(box, low);
}

/// The fluid in the control volumes of vertical faces that belongs to a space whose cells do not share the face.
/// Only these faces see gravity, and their control volumes fill all space.
template <int Dim>
void HullMask<Dim>::find_carried() {
  constexpr int nb = BlockShape<Dim>::n;
  constexpr int up = Dim - 1;
  const auto& tiles = window_.tiles();
  const double volume = window_.cell_volume(), least = 1e-9 * volume;
  const double far = clip_distance_ + 0.3 * window_.h().maxCoeff();
  const auto rotate = motion::rotation(now_.pose);
  const int stride = window_.stride(up);
  std::vector<std::vector<Carried>> by_tile(tiles.size());
  mesh::parallel_for(static_cast<int>(tiles.size()), window_.forest().threads(), [&](int t) {
    const auto& tile = tiles[static_cast<std::size_t>(t)];
    const auto& patch = *patches_[static_cast<std::size_t>(t)];
    auto& list = by_tile[static_cast<std::size_t>(t)];
    IVec<Dim> upper = tile.at;
    for (int& u : upper) u += nb;
    for_box<Dim>(tile.at, upper, [&](const IVec<Dim>& i) {
      for (int a = 0; a < Dim; ++a)
        if (i[a] < 1 || i[a] + 1 >= window_.n()[a]) return;
      const int at = window_.at(i), below = at - stride;
      if (std::abs(now_.phi[static_cast<std::size_t>(at)]) > far) return;
      const signed char high = now_.space[static_cast<std::size_t>(at)], low = now_.space[static_cast<std::size_t>(below)];
      if (high < 0 || low < 0) return;
      const auto box = box_at(now_, window_.face_centre(i, up));
      const auto add = [&](double part, const Vec<Dim>& moment, int a, int b) {
        if (part <= least) return;
        const Vec<Dim> centroid = rotate * (moment / part - body_.cog);
        list.push_back({part, centroid, {a, b}});
      };
      if (low != high) {  // a wall: both sides lose their share, less what the openings let through
        const double closed = 1 - now_.aperture[up][static_cast<std::size_t>(at)];
        for (const auto& [space, cell] : {std::pair{low, below}, std::pair{high, at}}) {
          const auto rest = patch.outside_space(box, space);
          add(closed * (volume - rest.volume), closed * (volume * box.centre - rest.moment), cell, cell);
        }
        return;
      }
      const auto rest = patch.outside_space(box, low);
      if (rest.volume <= least) return;
      const auto solid = patch.solid_part(box);
      if (rest.volume - solid.volume <= least) return;
      // Fluid of another space reaches in: as full of water as the cells of that space beside these two.
      std::array<int, 2> cells{-1, -1};
      for (int side = 0; side < 2; ++side) {
        const int own = side == 0 ? below : at;
        for (int a = 0; a < up && cells[static_cast<std::size_t>(side)] < 0; ++a)
          for (const int step : {-window_.stride(a), window_.stride(a)})
            if (apart(now_.space[static_cast<std::size_t>(own + step)], low)) cells[static_cast<std::size_t>(side)] = own + step;
      }
      if (cells[0] < 0) cells[0] = cells[1];
      if (cells[1] < 0) cells[1] = cells[0];
      if (cells[0] < 0) return;
      add(rest.volume - solid.volume, rest.moment - solid.moment, cells[0], cells[1]);
    });
  });
  carried_.clear();
  for (const auto& list : by_tile) carried_.insert(carried_.end(), list.begin(), list.end());
}

template <int Dim>
motion::DofVector<Dim> HullMask<Dim>::carried_weight(const std::vector<double>& vof,
                                                     const FluidProperties& fluids) const {
  motion::DofVector<Dim> sum = motion::DofVector<Dim>::Zero();
  for (const Carried& c : carried_) {
    const double water = 0.5 * (vof[static_cast<std::size_t>(c.cells[0])] + vof[static_cast<std::size_t>(c.cells[1])]);
    Vec<Dim> force = Vec<Dim>::Zero();
    force[Dim - 1] = -fluids.rho(water) * fluids.gravity * c.volume;
    sum.template head<Dim>() += force;
    sum.template tail<motion::n_angular<Dim>>() += motion::moment<Dim>(now_.pose, now_.pose.cog + c.arm, force);
  }
  return sum;
}

template void HullMask<2>::find_spaces(HullGeometry<2>&) const;
template void HullMask<3>::find_spaces(HullGeometry<3>&) const;
template hull::SolidPart<2> HullMask<2>::closed_part(const HullGeometry<2>&, const hull::HullPatch<2>&,
                                                     const hull::OrientedBox<2>&, const IVec<2>&, int) const;
template hull::SolidPart<3> HullMask<3>::closed_part(const HullGeometry<3>&, const hull::HullPatch<3>&,
                                                     const hull::OrientedBox<3>&, const IVec<3>&, int) const;
template void HullMask<2>::find_carried();
template void HullMask<3>::find_carried();
template motion::DofVector<2> HullMask<2>::carried_weight(const std::vector<double>&, const FluidProperties&) const;
template motion::DofVector<3> HullMask<3>::carried_weight(const std::vector<double>&, const FluidProperties&) const;

}  // namespace seaway::flow
