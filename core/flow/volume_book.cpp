#include "core/flow/volume_book.hpp"

#include <algorithm>
#include <cmath>

#include "core/flow/plic.hpp"

namespace seaway::flow {

using field::filled;
using field::for_box;

namespace {

/// Part of the reservoirs that goes back to the flow in a second.
constexpr double release_rate = 100.0;

/// Cells with less fluid get their volume fraction from their neighbours each step: nothing stays in them.
constexpr double smallest_taker = 0.5;

/// A space with less water than so many cells is dry.
constexpr double least_wet_cells = 10;

/// What of a wanted change a volume fraction takes at most. A cell that is all but full or empty takes next to
/// nothing: it would become air under water, which rises along the hull as a jet.
double most_taken(double fraction, double wanted) {
  const double most = fraction * (1 - fraction);
  return std::clamp(wanted, -most, most);
}

template <int Dim>
bool on_edge(const HullWindow<Dim>& window, const IVec<Dim>& i, int margin) {
  for (int a = 0; a < Dim; ++a)
    if (i[a] < margin || i[a] >= window.n()[a] - margin) return true;
  return false;
}

}  // namespace

template <int Dim>
double VolumeBook<Dim>::visible_in(const HullMask<Dim>& mask, const IVec<Dim>& i,
                                   const std::vector<double>& vof) const {
  const HullWindow<Dim>& window = mask.window();
  const int at = window.at(i);
  const double theta = mask.fluid_fraction()[static_cast<std::size_t>(at)];
  const double c = vof[static_cast<std::size_t>(at)];
  const double volume = window.cell_volume();
  if (theta >= 1) return c * volume;
  if (theta <= 0 || c <= mixed_limit) return 0;
  if (c >= 1 - mixed_limit || on_edge<Dim>(window, i, 1)) return c * theta * volume;
  const Plane<Dim> plane = interface_plane<Dim>(window, vof, mask.now().space, at);
  return std::max(0.0, c * volume - mask.submerged_solid(i, plane.normal, plane.d));
}

template <int Dim>
void VolumeBook<Dim>::measure(const HullMask<Dim>& mask, const std::vector<double>& vof) {
  visible_.assign(mask.window().size(), 0.0);
  mask.window().for_cells_on_threads([&](const IVec<Dim>& i) {
    visible_[static_cast<std::size_t>(mask.window().at(i))] = visible_in(mask, i, vof);
  });
}

template <int Dim>
void VolumeBook<Dim>::restart(const HullMask<Dim>& mask, const std::vector<double>& vof) {
  reservoir_.clear();
  book_.clear();
  last_defect_ = 0;
  measure(mask, vof);
}

template <int Dim>
void VolumeBook<Dim>::begin_step(const HullMask<Dim>& mask, const FlowState<Dim>& state) {
  for (int axis = 0; axis < Dim; ++axis) {
    mask.window().load_faces(state.w, axis, w_[static_cast<std::size_t>(axis)]);
    swept_[static_cast<std::size_t>(axis)].assign(mask.window().size(), 0.0);
  }
  if (mask.walls() == Walls::thin) mask.window().load_cells(state.vof, start_vof_);
}

template <int Dim>
void VolumeBook<Dim>::add_fluxes(const HullMask<Dim>& mask, int axis, const FaceField<double, Dim>& swept) {
  mask.window().load_faces(swept, axis, loaded_);
  auto& sum = swept_[static_cast<std::size_t>(axis)];
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += loaded_[k];
}

template <int Dim>
void VolumeBook<Dim>::close_fluxes(const HullMask<Dim>& mask, const CellField<double, Dim>& vof,
                                   const motion::Twist<Dim>& twist, double dt) {
  const HullWindow<Dim>& window = mask.window();
  const auto& theta = mask.fluid_fraction();
  using Held = std::pair<std::int64_t, Entry>;
  const auto held = window.template collect<Held>([&](const IVec<Dim>& i, std::vector<Held>& out) {
    const auto at = static_cast<std::size_t>(window.at(i));
    bool touched = theta[at] < 1;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto& solid = mask.solid_face(axis);
      touched = touched || solid[at] > 0 || solid[at + static_cast<std::size_t>(window.stride(axis))] > 0;
    }
    if (!touched || window.tile_of(i) < 0) return;
    double volume = visible_[at];
    for (int axis = 0; axis < Dim; ++axis) {
      const auto ax = static_cast<std::size_t>(axis);
      for (int side = 0; side < 2; ++side) {
        const std::size_t f = at + static_cast<std::size_t>(side * window.stride(axis));
        const double w = w_[ax][f], solid = mask.solid_face(axis)[f];
        double passed = swept_[ax][f];  // [m]
        if (solid > 0) {
          IVec<Dim> face = i;
          face[axis] += side;
          const double wall = motion::velocity_at<Dim>(twist, mask.half().pose, window.face_centre(face, axis))[axis];
          double phi;
          if (std::abs(w * dt) > 1e-12 * window.h()[axis]) {
            phi = std::clamp(passed / (w * dt), 0.0, 1.0);
          } else {
            phi = std::clamp(vof.data()[static_cast<std::size_t>(window.global_cell(i))], 0.0, 1.0);
          }
          passed = phi * dt * (w - solid * wall);
        }
        volume -= (side == 0 ? -1.0 : 1.0) * passed * window.face_area(axis);
      }
    }
    out.push_back({window.global_cell(i), {volume, mask.walls() == Walls::thin ? space_of(mask, i) : -1}});
  });
  book_.clear();
  book_.insert(held.begin(), held.end());
}

template <int Dim>
void VolumeBook<Dim>::undo_wall_fluxes(const HullMask<Dim>& mask, CellField<double, Dim>& vof, double dt) {
  if (mask.walls() != Walls::thin) return;
  const HullWindow<Dim>& window = mask.window();
  window.load_cells(vof, loaded_);
  std::vector<double> fixed = loaded_;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto ax = static_cast<std::size_t>(axis);
    const auto stride = static_cast<std::size_t>(window.stride(axis));
    const auto& aperture = mask.half().aperture[ax];
    window.for_cells([&](const IVec<Dim>& i) {
      const auto at = static_cast<std::size_t>(window.at(i));
      if (aperture[at] > 0 || !mask.is_wall(mask.half(), at, axis, i[axis] == 0)) return;
      const double passed = swept_[ax][at] / window.h()[axis], volume = dt * w_[ax][at] / window.h()[axis];
      fixed[at] -= passed - volume * start_vof_[at];
      fixed[at - stride] += passed - volume * start_vof_[at - stride];
    });
  }
  for (std::size_t k = 0; k < fixed.size(); ++k)
    if (fixed[k] != loaded_[k]) fixed[k] = std::clamp(fixed[k], 0.0, 1.0);
  window.store_cells(fixed, vof);
}

template <int Dim>
int VolumeBook<Dim>::space_of(const HullMask<Dim>& mask, const IVec<Dim>& i) const {
  const HullWindow<Dim>& window = mask.window();
  const int at = window.at(i);
  if (mask.walls() == Walls::thin) return std::max<int>(0, mask.now().space[static_cast<std::size_t>(at)]);
  const auto& phi = mask.now().phi;
  Vec<Dim> x = window.cell_centre(i), g;
  for (int a = 0; a < Dim; ++a) {
    const int s = window.stride(a);
    g[a] = (phi[static_cast<std::size_t>(at + s)] - phi[static_cast<std::size_t>(at - s)]) / (2 * window.h()[a]);
  }
  const double reach = 0.7 * window.h().maxCoeff() - phi[static_cast<std::size_t>(at)];
  if (reach > 0 && g.norm() > 0.1) x += g / g.norm() * reach;
  return mask.space_at(x);
}

template <int Dim>
double VolumeBook<Dim>::give(const HullMask<Dim>& mask, const IVec<Dim>& i, int space, double defect,
                             std::vector<double>& vof) const {
  const HullWindow<Dim>& window = mask.window();
  const auto& theta = mask.fluid_fraction();
  const double volume = window.cell_volume();
  const bool thin = mask.walls() == Walls::thin;
  std::vector<std::pair<std::size_t, double>> takers;
  double weights = 0;
  for_box<Dim>(filled<Dim>(-2), filled<Dim>(3), [&](const IVec<Dim>& o) {
    IVec<Dim> j = i;
    for (int a = 0; a < Dim; ++a) j[a] += o[a];
    if (on_edge<Dim>(window, j, 2)) return;
    const auto at = static_cast<std::size_t>(window.at(j));
    const double c = vof[at];
    if (theta[at] < 1 || !is_mixed(c)) return;
    if ((thin ? space_of(mask, j) : mask.space_at(window.cell_centre(j))) != space) return;
    takers.emplace_back(at, c * (1 - c));
    weights += c * (1 - c);
  });
  double left = defect;
  for (const auto& [at, weight] : takers) {
    const double before = vof[at];
    vof[at] = before + most_taken(before, defect * weight / weights / volume);
    left -= (vof[at] - before) * volume;
  }
  return left;
}

template <int Dim>
void VolumeBook<Dim>::release(const HullMask<Dim>& mask, std::vector<double>& vof, double dt) {
  const HullWindow<Dim>& window = mask.window();
  const auto& theta = mask.fluid_fraction();
  const bool thin = mask.walls() == Walls::thin;
  const double volume = window.cell_volume(), part = 1 - std::exp(-release_rate * dt);
  struct Taker {
    std::size_t at;
    double weight;
  };
  for (auto& [space, owed] : reservoir_) {
    if (std::abs(owed) < 1e-15 * volume) continue;
    auto takers = window.template collect<Taker>([&](const IVec<Dim>& i, std::vector<Taker>& out) {
      const auto at = static_cast<std::size_t>(window.at(i));
      const double c = vof[at];
      if (theta[at] < 1 || !is_mixed(c) || on_edge<Dim>(window, i, 2)) return;
      if ((thin ? space_of(mask, i) : mask.space_at(window.cell_centre(i))) != space) return;
      out.push_back({at, c * (1 - c)});
    });
    double weights = 0;
    for (const Taker& t : takers) weights += t.weight;
    const double amount = part * owed;
    double left = amount;
    for (const Taker& t : takers) {
      const double before = vof[t.at];
      vof[t.at] = before + most_taken(before, amount * t.weight / weights / volume);
      left -= (vof[t.at] - before) * volume;
    }
    owed -= amount - left;
    if (std::abs(left) < 1e-3 * std::abs(amount)) continue;
    // No surface away from the walls: cells that the walls cut. What they show then is settled by the caller.
    takers.clear();
    weights = 0;
    double wet = 0;  // cells of water
    window.for_cells([&](const IVec<Dim>& i) {
      const auto at = static_cast<std::size_t>(window.at(i));
      const double c = vof[at];
      if (theta[at] < smallest_taker || !(c > 0) || on_edge<Dim>(window, i, 2) || space_of(mask, i) != space) return;
      wet += theta[at] * c;
      if (theta[at] >= 1 || !is_mixed(c)) return;
      takers.push_back({at, theta[at] * c * (1 - c)});
      weights += takers.back().weight;
    });
    // What a dry space is owed are errors at its walls, not water.
    if (left > 0 && wet < least_wet_cells) continue;
    for (const Taker& t : takers)
      vof[t.at] = std::clamp(vof[t.at] + left * t.weight / weights / (theta[t.at] * volume), 0.0, 1.0);
  }
}

template <int Dim>
void VolumeBook<Dim>::settle(const HullMask<Dim>& mask, const std::vector<double>& advected,
                             std::vector<double>& vof, double dt, bool correct) {
  const HullWindow<Dim>& window = mask.window();
  const auto& theta = mask.fluid_fraction();
  last_defect_ = 0;
  // All defects first: what one cell gives must not change what the next one sees.
  struct Defect {
    IVec<Dim> cell;
    int space;
    double volume;
  };
  struct Look {  // at one cell
    IVec<Dim> cell{};
    std::array<Defect, 2> defects;
    int n_defects = 0;
    bool is_cut = false;
    double seen = 0;
  };
  const auto looks = window.template collect<Look>([&](const IVec<Dim>& i, std::vector<Look>& out) {
    const auto at = static_cast<std::size_t>(window.at(i));
    const auto entry = book_.find(window.global_cell(i));
    if (entry == book_.end() && theta[at] >= 1) return;
    Look look;
    const auto missing = [&](int space, double volume) {
      if (volume != 0) look.defects[static_cast<std::size_t>(look.n_defects++)] = {i, space, volume};
    };
    const double wanted = entry != book_.end() ? entry->second.volume : advected[at] * window.cell_volume();
    const double seen = visible_in(mask, i, vof);
    const int space = space_of(mask, i);
    const int before = entry != book_.end() && entry->second.space >= 0 ? entry->second.space : space;
    if (before != space) {  // a wall has passed the cell's middle: it now shows another space's water
      missing(before, wanted);
      missing(space, -seen);
    } else if (wanted != seen) {
      missing(space, wanted - seen);
    }
    look.cell = i;
    look.is_cut = theta[at] < 1;
    look.seen = seen;
    out.push_back(look);
  });
  for (const Look& look : looks)
    for (int k = 0; k < look.n_defects; ++k) {
      const auto& [i, space, defect] = look.defects[static_cast<std::size_t>(k)];
      last_defect_ += std::abs(defect);
      if (!correct) continue;
      const double left = give(mask, i, space, defect, vof);
      if (left != 0) reservoir_[space] += left;
    }
  if (correct) release(mask, vof, dt);
  measure(mask, vof);
  if (!correct) return;
  // What was given to a cell tilts the planes of the cut cells beside it: they show more or less water than
  // before, although their volume fraction is the same. That too is owed.
  for (const Look& look : looks) {
    if (!look.is_cut) continue;
    const double shown = visible_[static_cast<std::size_t>(window.at(look.cell))] - look.seen;
    if (shown != 0) reservoir_[space_of(mask, look.cell)] -= shown;
  }
}

template <int Dim>
double VolumeBook<Dim>::reservoir_total() const {
  double sum = 0;
  for (const auto& [space, owed] : reservoir_) sum += owed;
  return sum;
}

template class VolumeBook<2>;
template class VolumeBook<3>;

}  // namespace seaway::flow
