#include "core/flow/hull_extension.hpp"

#include <algorithm>
#include <cmath>

#include "core/flow/plic.hpp"

namespace seaway::flow {

using field::filled;
using field::for_box;

namespace {

/// Offsets of the 3^Dim neighbourhood without the middle, with their distance in cells.
template <int Dim>
struct Neighbour {
  IVec<Dim> at{};
  int index = 0;
  int distance = 0;  ///< number of axes in which it differs
};

template <int Dim>
std::vector<Neighbour<Dim>> neighbours(const HullWindow<Dim>& window) {
  std::vector<Neighbour<Dim>> out;
  for_box<Dim>(filled<Dim>(-1), filled<Dim>(2), [&](const IVec<Dim>& i) {
    Neighbour<Dim> n;
    n.at = i;
    for (int a = 0; a < Dim; ++a) {
      n.index += i[a] * window.stride(a);
      n.distance += i[a] != 0;
    }
    if (n.distance > 0) out.push_back(n);
  });
  return out;
}

/// A fuller or emptier cell holds no surface that could go on through the wall: its plane would turn a trace of
/// air in a submerged cell into a hull full of it.
constexpr double least_surface = 0.01;

/// Gradient of the distance at a cell by central differences.
template <int Dim>
Vec<Dim> distance_gradient(const HullWindow<Dim>& window, const std::vector<double>& phi, int at) {
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) {
    const int s = window.stride(a);
    g[a] = (phi[static_cast<std::size_t>(at + s)] - phi[static_cast<std::size_t>(at - s)]) / (2 * window.h()[a]);
  }
  return g;
}

/// Whether a neighbour lies on the fluid side.
template <int Dim>
bool visible(const HullWindow<Dim>& window, const Neighbour<Dim>& n, const Vec<Dim>& gradient) {
  double along = 0;
  for (int a = 0; a < Dim; ++a) along += n.at[a] * window.h()[a] * gradient[a];
  return along > 0.3 * window.h().minCoeff();
}

}  // namespace

template <int Dim>
void HullExtension<Dim>::extend_vof(const HullMask<Dim>& mask, std::vector<double>& vof) {
  const HullWindow<Dim>& window = mask.window();
  const auto& theta = mask.fluid_fraction();
  const auto& phi = mask.now().phi;
  const auto& spaces = mask.now().space;
  const auto behind = [&](int at, int other) {  // another space's cell says nothing about this one
    return !spaces.empty() && apart(spaces[static_cast<std::size_t>(at)], spaces[static_cast<std::size_t>(other)]);
  };
  const auto around = neighbours<Dim>(window);
  // 0: known; 1, 2, ...: layers; -1: not reached.
  layer_.assign(window.size(), -1);
  level_.assign(window.size(), 0);
  IVec<Dim> inner_upper = window.n();
  for (int& u : inner_upper) u -= 1;
  window.for_cells_on_threads([&](const IVec<Dim>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    if (theta[at] < 0.5) return;
    layer_[at] = 0;
    level_[at] = 1;
  });
  // A surface that lies exactly on a grid line leaves no mixed cell: the face between water and air is it.
  const auto sharp_plane = [&](int at, Plane<Dim>& plane) {
    const double c = vof[static_cast<std::size_t>(at)];
    for (int a = Dim - 1; a >= 0; --a) {
      for (int side = -1; side <= 1; side += 2) {
        const auto beside = static_cast<std::size_t>(at + side * window.stride(a));
        if (layer_[beside] != 0 || behind(at, static_cast<int>(beside)) || is_mixed(vof[beside]) || (vof[beside] > 0.5) == (c > 0.5)) continue;
        const double outwards = c > 0.5 ? side : -side;  // from water to air
        plane.normal.fill(0);
        plane.normal[static_cast<std::size_t>(a)] = outwards;
        plane.d = side > 0 ? outwards : 0.0;
        return true;
      }
    }
    return false;
  };
  front_.clear();  // cells over water that see nothing at their own height; on a floor that is right, water stands there
  deeper_.clear();
  for (int layer = 1; layer <= extension_layers; ++layer) {
    struct Filled {
      int at = 0;
      double value = 0;
      bool level = false, below = false;  ///< found at its own height; the fluid that it sees does not lie above it
    };
    const auto filled_cells = window.template collect<Filled>(filled<Dim>(1), inner_upper, [&](const IVec<Dim>& i, std::vector<Filled>& out) {
      const int at = window.at(i);
      if (layer_[static_cast<std::size_t>(at)] != -1 || phi[static_cast<std::size_t>(at)] < -(layer + 2) * window.h().maxCoeff())
        return;
      const Vec<Dim> gradient = distance_gradient<Dim>(window, phi, at);
      // At the cell's own height, by planes or level neighbours; and over all neighbours.
      double levels = 0, level_weight = 0, means = 0, mean_weight = 0;
      for (const bool only_visible : {true, false}) {
        for (const auto& n : around) {
          if (layer > 1 && n.distance > 1) continue;
          const int from = at + n.index;
          const int l = layer_[static_cast<std::size_t>(from)];
          if (l < 0 || l >= layer || behind(at, from) || (only_visible && !visible<Dim>(window, n, gradient))) continue;
          const double c = vof[static_cast<std::size_t>(from)];
          means += c;
          mean_weight += 1;
          const double weight = n.distance == 1 ? 1.0 : 0.5;
          bool inside = layer == 1;  // the plane needs the neighbour's own 3^Dim stencil
          for (int a = 0; a < Dim; ++a)
            inside = inside && i[a] + n.at[a] >= 1 && i[a] + n.at[a] < window.n()[a] - 1;
          const bool surface = std::min(c, 1 - c) > least_surface;
          Plane<Dim> plane;
          if (inside && surface) plane = interface_plane<Dim>(window, vof, spaces, from);
          if (inside && (surface || sharp_plane(from, plane))) {
            for (int a = 0; a < Dim; ++a) plane.d += n.at[a] * plane.normal[static_cast<std::size_t>(a)];
            levels += weight * plane_fraction<Dim>(plane.normal, plane.d);
            level_weight += weight;
          } else if (n.at[Dim - 1] == 0 && level_[static_cast<std::size_t>(from)]) {
            levels += weight * c;
            level_weight += weight;
          }
        }
        if (mean_weight > 0) break;
      }
      if (mean_weight == 0) return;
      out.push_back({at, level_weight > 0 ? levels / level_weight : means / mean_weight, level_weight > 0, gradient[Dim - 1] <= 0});
    });
    for (const auto& [at, value, level, below] : filled_cells) {
      vof[static_cast<std::size_t>(at)] = value;
      layer_[static_cast<std::size_t>(at)] = static_cast<signed char>(layer);
      if (level) level_[static_cast<std::size_t>(at)] = 1;
      else if (below && value > 0.5) (layer == 1 ? front_ : deeper_).push_back(at);
    }
  }
  level_off(mask.window(), behind, vof);
}

/// Over water under a flat bottom or counter the extension found water, however high the cell lies. If the surface
/// is near, it has to go on level from the hull's sides instead: the values of `level_` cells are carried along the
/// rows of the cells in `front_` and what lies around them, and the lower of the two counts. Cells that were
/// reached from above or below are no sources: under a counter the air over the deck would get into the water.
template <int Dim>
template <class Behind>
void HullExtension<Dim>::level_off(const HullWindow<Dim>& window, const Behind& behind, std::vector<double>& vof) {
  if (front_.empty()) return;
  constexpr signed char waiting = 100;
  std::vector<int> open = front_;
  open.insert(open.end(), deeper_.begin(), deeper_.end());  // were filled from the same cells
  std::vector<double> before;
  before.reserve(open.size());
  for (const int at : open) {
    before.push_back(vof[static_cast<std::size_t>(at)]);
    layer_[static_cast<std::size_t>(at)] = waiting;
  }
  std::vector<char> done(open.size(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    list_.clear();
    next_.clear();
    for (std::size_t k = 0; k < open.size(); ++k) {
      if (done[k]) continue;
      double sum = 0;
      int count = 0;
      for (int a = 0; a + 1 < Dim; ++a)
        for (const int step : {-window.stride(a), window.stride(a)}) {
          const auto from = static_cast<std::size_t>(open[k] + step);
          if (layer_[from] < 0 || layer_[from] == waiting || !level_[from] || behind(open[k], static_cast<int>(from))) continue;
          sum += vof[from];
          ++count;
        }
      if (count == 0) continue;
      done[k] = 1;
      changed = true;
      list_.push_back(open[k]);
      next_.push_back(std::min(before[k], sum / count));
    }
    for (std::size_t k = 0; k < list_.size(); ++k) {
      vof[static_cast<std::size_t>(list_[k])] = next_[k];
      layer_[static_cast<std::size_t>(list_[k])] = 1;
      level_[static_cast<std::size_t>(list_[k])] = 1;
    }
  }
}

/// Layer by layer from the entries with layer_ 0 inwards: means of the neighbours that an entry with layer_ -1 sees, and
/// that are not `behind(at, other)` a wall. At most two fields.
template <int Dim>
template <class Behind>
void HullExtension<Dim>::fill_layers(const HullWindow<Dim>& window, const std::vector<double>& phi, const Behind& behind,
                                     std::span<std::vector<double>* const> fields) {
  const auto around = neighbours<Dim>(window);
  IVec<Dim> upper = window.n();
  for (int& u : upper) --u;
  constexpr std::size_t most_fields = 2;
  struct Filled {
    std::size_t at = 0;
    std::array<double, most_fields> value{};
  };
  for (int layer = 1; layer <= extension_layers; ++layer) {
    const auto filled_entries = window.template collect<Filled>(filled<Dim>(1), upper, [&](const IVec<Dim>& i, std::vector<Filled>& out) {
      const int at = window.at(i);
      if (layer_[static_cast<std::size_t>(at)] != -1 || phi[static_cast<std::size_t>(at)] < -(layer + 2) * window.h().maxCoeff())
        return;
      const Vec<Dim> gradient = distance_gradient<Dim>(window, phi, at);
      Filled entry{static_cast<std::size_t>(at), {}};
      double weight = 0;
      for (const bool only_visible : {true, false}) {
        for (const auto& n : around) {
          const auto from = static_cast<std::size_t>(at + n.index);
          if (layer_[from] < 0 || layer_[from] >= layer || behind(at, static_cast<int>(from)) ||
              (only_visible && !visible<Dim>(window, n, gradient)))
            continue;
          for (std::size_t f = 0; f < fields.size(); ++f) entry.value[f] += (*fields[f])[from];
          weight += 1;
        }
        if (weight > 0) break;
      }
      if (weight == 0) return;
      for (double& value : entry.value) value /= weight;
      out.push_back(entry);
    });
    for (const Filled& entry : filled_entries) {
      for (std::size_t f = 0; f < fields.size(); ++f) (*fields[f])[entry.at] = entry.value[f];
      layer_[entry.at] = static_cast<signed char>(layer);
    }
  }
}

template <int Dim>
void HullExtension<Dim>::extend_scalars(const HullMask<Dim>& mask, std::array<std::vector<double>*, 2> scalars,
                                        std::array<double, 2> deep) {
  const HullWindow<Dim>& window = mask.window();
  const auto& theta = mask.fluid_fraction();
  const auto& spaces = mask.now().space;
  layer_.assign(window.size(), -1);
  window.for_cells([&](const IVec<Dim>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    if (theta[at] >= 0.5) layer_[at] = 0;
  });
  const auto behind = [&](int at, int other) {
    return !spaces.empty() && apart(spaces[static_cast<std::size_t>(at)], spaces[static_cast<std::size_t>(other)]);
  };
  fill_layers(window, mask.now().phi, behind, scalars);
  window.for_cells([&](const IVec<Dim>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    for (std::size_t s = 0; s < 2; ++s)
      if (layer_[at] < 0) (*scalars[s])[at] = deep[s];
  });
}

template <int Dim>
void HullExtension<Dim>::extend_velocity(const HullMask<Dim>& mask, int axis, const motion::Twist<Dim>& twist,
                                         std::vector<double>& u) {
  const HullWindow<Dim>& window = mask.window();
  const auto& aperture = mask.half().aperture[static_cast<std::size_t>(axis)];
  const auto& phi = mask.half().phi;
  const auto around = neighbours<Dim>(window);
  IVec<Dim> inner_upper = window.n();
  for (int& v : inner_upper) v -= 1;
  layer_.assign(window.size(), -1);
  const IVec<Dim> faces_upper = window.n_faces(axis);
  // Thin walls: a face belongs to the space of its cells; in a wall between two spaces it moves with the hull.
  const auto& spaces = mask.half().space;
  constexpr signed char in_wall = -2;
  face_space_.assign(spaces.empty() ? 0 : window.size(), passage);
  if (!spaces.empty()) {
    window.for_cells_on_threads([&](const IVec<Dim>& i) {
      const auto at = static_cast<std::size_t>(window.at(i));
      const signed char high = spaces[at];
      const signed char low = i[axis] > 0 ? spaces[at - static_cast<std::size_t>(window.stride(axis))] : high;
      face_space_[at] = apart(low, high) ? in_wall : std::max(low, high);
      if (face_space_[at] == in_wall && aperture[at] <= 0) layer_[at] = -2;
    });
  }
  const auto behind = [&](int at, int other) {
    return !face_space_.empty() &&
           apart(face_space_[static_cast<std::size_t>(at)], face_space_[static_cast<std::size_t>(other)]);
  };
  window.for_box_on_threads(filled<Dim>(0), faces_upper, [&](const IVec<Dim>& i) {
    const int at = window.at(i);
    if (aperture[static_cast<std::size_t>(at)] > 0) layer_[static_cast<std::size_t>(at)] = 0;
  });
  // Nearly closed faces: limited to the spread of the open ones around them.
  using Limited = std::pair<std::size_t, double>;
  const auto limited = window.template collect<Limited>(filled<Dim>(1), inner_upper, [&](const IVec<Dim>& i, std::vector<Limited>& out) {
    const int at = window.at(i);
    const double a = aperture[static_cast<std::size_t>(at)];
    if (!(a > 0 && a < 0.2)) return;
    double sum = 0, largest = 0;
    int count = 0;
    for (const auto& n : around) {
      const auto from = static_cast<std::size_t>(at + n.index);
      if (aperture[from] < 0.2 || behind(at, static_cast<int>(from))) continue;
      sum += u[from];
      largest = std::max(largest, std::abs(u[from]));
      ++count;
    }
    if (count == 0) return;
    const double mean = sum / count;
    out.emplace_back(at, mean + std::clamp(u[static_cast<std::size_t>(at)] - mean, -largest, largest));
  });
  for (const auto& [at, value] : limited) u[at] = value;
  fill_layers(window, phi, behind, std::array{&u});
  window.for_box_on_threads(filled<Dim>(0), faces_upper, [&](const IVec<Dim>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    if (layer_[at] >= 0) return;
    u[at] = motion::velocity_at<Dim>(twist, mask.half().pose, window.face_centre(i, axis))[axis];
  });
}

template class HullExtension<2>;
template class HullExtension<3>;

}  // namespace seaway::flow
