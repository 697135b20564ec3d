#include "core/flow/hull_walls.hpp"

#include <algorithm>
#include <cmath>

#include "core/field/restrict.hpp"
#include "core/flow/wall_law.hpp"

namespace seaway::flow {

using field::filled;
using field::for_box;

namespace {

constexpr double image_distance = 1.5;   ///< of the image point, in cells along the normal
constexpr double second_distance = 2.5;  ///< of the second one

/// Linear interpolation in a window array at x: calls f(entry, weight) for the 2^Dim entries around it. `shift`:
/// position of entry 0 against the window's lower corner, in cells. False too close to the window's edge.
template <int Dim, class F>
bool around(const HullWindow<Dim>& window, const Vec<Dim>& x, const Vec<Dim>& shift, F&& f) {
  IVec<Dim> base{};
  Vec<Dim> part;
  const Vec<Dim> first = window.cell_centre(filled<Dim>(0)) - 0.5 * window.h();
  for (int a = 0; a < Dim; ++a) {
    const double at = (x[a] - first[a]) / window.h()[a] - shift[a];
    base[a] = static_cast<int>(std::floor(at));
    part[a] = at - base[a];
    if (base[a] < 0 || base[a] + 1 >= window.n()[a]) return false;
  }
  const int entry = window.at(base);
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    int at = entry;
    double weight = 1;
    for (int a = 0; a < Dim; ++a) {
      const int up = (corner >> a) & 1;
      at += up * window.stride(a);
      weight *= up ? part[a] : 1 - part[a];
    }
    f(static_cast<std::size_t>(at), weight);
  }
  return true;
}

template <int Dim>
Vec<Dim> cell_shift() {
  return Vec<Dim>::Constant(0.5);
}
template <int Dim>
Vec<Dim> face_shift(int axis) {
  Vec<Dim> shift = cell_shift<Dim>();
  shift[axis] = 0;
  return shift;
}

template <int Dim>
double cell_value(const HullWindow<Dim>& window, const std::vector<double>& f, const Vec<Dim>& x) {
  double sum = 0;
  around<Dim>(window, x, cell_shift<Dim>(), [&](std::size_t at, double w) { sum += w * f[at]; });
  return sum;
}

}  // namespace

/// What the flow looks like from a cell at a wall.
template <int Dim>
struct HullWalls<Dim>::Look {
  bool valid = false;
  Vec<Dim> normal, wall, image, along;  ///< `along`: direction of the flow along the wall
  double cell = 0;                      ///< length of a cell along the normal [m]
  double y = 0;                         ///< of the image point [m]
  double u = 0;                         ///< along the wall, relative to it [m/s]
  double rho = 0, nu = 0;
  bool wet = false, one_fluid = false;
};

template <int Dim>
Vec<Dim> HullWalls<Dim>::velocity_at(const HullWindow<Dim>& window, const Vec<Dim>& x) const {
  Vec<Dim> v = Vec<Dim>::Zero();
  for (int a = 0; a < Dim; ++a) {
    const auto& u = u_[static_cast<std::size_t>(a)];
    around<Dim>(window, x, face_shift<Dim>(a), [&](std::size_t at, double w) { v[a] += w * u[at]; });
  }
  return v;
}

template <int Dim>
typename HullWalls<Dim>::Look HullWalls<Dim>::look(const HullMask<Dim>& mask, const IVec<Dim>& cell,
                                                   const motion::Twist<Dim>& twist) const {
  const HullWindow<Dim>& window = mask.window();
  const auto& phi = mask.half().phi;
  const auto at = static_cast<std::size_t>(window.at(cell));
  Look out;
  Vec<Dim> gradient;
  for (int a = 0; a < Dim; ++a) {
    const auto s = static_cast<std::size_t>(window.stride(a));
    gradient[a] = (phi[at + s] - phi[at - s]) / (2 * window.h()[a]);
  }
  if (!(gradient.norm() > 0.5)) return out;  // between two walls
  out.normal = gradient.normalized();
  out.cell = out.normal.cwiseAbs().dot(window.h());
  out.wall = window.cell_centre(cell) - phi[at] * out.normal;
  out.y = image_distance * out.cell;
  out.image = out.wall + out.y * out.normal;
  const double there = cell_value<Dim>(window, phi, out.image);
  if (!(there > 0.6 * out.y)) {  // a corner or another wall is in the way
    out.y = std::max(phi[at], 0.5 * out.cell);
    out.image = out.wall + out.y * out.normal;
  }
  const Vec<Dim> relative =
      velocity_at(window, out.image) - motion::velocity_at<Dim>(twist, mask.half().pose, out.wall);
  out.along = relative - relative.dot(out.normal) * out.normal;
  out.u = out.along.norm();
  if (out.u > 0) out.along /= out.u;
  const double water = std::clamp(cell_value<Dim>(window, vof_, out.image), 0.0, 1.0);
  out.rho = fluids_.rho(water);
  out.nu = (water * fluids_.rho_water * fluids_.nu_water + (1 - water) * fluids_.rho_air * fluids_.nu_air) / out.rho;
  out.wet = water > 0.5;
  out.one_fluid = water < 1e-6 || water > 1 - 1e-6;
  out.valid = true;
  return out;
}

/// tau_w / rho [m2/s2].
template <int Dim>
double HullWalls<Dim>::stress_of(const HullMask<Dim>& mask, const Look& at) const {
  const HullWindow<Dim>& window = mask.window();
  if (model_ == WallModel::no_slip) {
    const double second = second_distance * at.cell;
    const Vec<Dim> farther = at.wall + second * at.normal;
    if (second <= at.y || cell_value<Dim>(window, mask.half().phi, farther) < 0.6 * second) return at.nu * at.u / at.y;
    const Vec<Dim> change = velocity_at(window, farther) - velocity_at(window, at.image);
    const double u2 = at.u + change.dot(at.along);
    const double slope = (at.u * second * second - u2 * at.y * at.y) / (at.y * second * (second - at.y));
    return at.nu * std::max(slope, 0.0);
  }
  if (model_ == WallModel::non_equilibrium && at.one_fluid) {
    // Along the flow, less the weight: one cell to each side of the image point.
    const Vec<Dim> step = at.cell * at.along;
    double gradient = (cell_value<Dim>(window, p_, at.image + step) - cell_value<Dim>(window, p_, at.image - step)) /
                      (2 * at.cell * at.rho);
    gradient += fluids_.gravity * at.along[Dim - 1];
    return wall_law::sensitised_stress(at.u, at.y, at.nu, cell_value<Dim>(window, k_, at.image), gradient);
  }
  const double u_tau = wall_law::friction_velocity(at.u, at.y, at.nu);
  return u_tau * u_tau;
}

template <int Dim>
void HullWalls<Dim>::find_stress(const HullMask<Dim>& mask, const FlowState<Dim>& state,
                                 const motion::Twist<Dim>& twist) {
  pieces_.clear();
  near_.clear();
  if (model_ == WallModel::slip) return;
  const HullWindow<Dim>& window = mask.window();
  for (int a = 0; a < Dim; ++a) window.load_faces(state.u, a, u_[static_cast<std::size_t>(a)]);
  window.load_cells(state.vof, vof_);
  if (state.turbulent()) window.load_cells(state.tke, k_);
  if (model_ == WallModel::non_equilibrium) window.load_cells(state.p, p_);
  const auto& phi = mask.half().phi;
  const auto& theta = mask.fluid_fraction();
  const double reach = 1.5 * window.h().maxCoeff() * std::sqrt(static_cast<double>(Dim));
  IVec<Dim> upper = window.n();
  for (int& u : upper) u -= 3;
  for_box<Dim>(filled<Dim>(3), upper, [&](const IVec<Dim>& i) {
    const auto at = static_cast<std::size_t>(window.at(i));
    if (!(std::abs(phi[at]) < reach) || window.tile_of(i) < 0) return;
    const Vec<Dim> area = mask.wall_area(i);
    const bool has_wall = area.squaredNorm() > 1e-12 * window.face_area(0) * window.face_area(0);
    const bool beside = state.turbulent() && theta[at] >= 0.5;
    if (!has_wall && !beside) return;
    const Look seen = look(mask, i, twist);
    if (!seen.valid) return;
    const bool near = beside && phi[at] > 0 && phi[at] <= image_distance * seen.cell;
    if (!has_wall && !near) return;
    const double stress = stress_of(mask, seen);
    if (near) {
      const double y = std::max(phi[at], 0.5 * seen.cell);
      const wall_law::Sources s = model_ == WallModel::non_equilibrium
                                      ? wall_law::averaged_sources(stress, y, seen.nu, k_[at])
                                      : wall_law::equilibrium_sources(stress, y, seen.nu);
      const std::int64_t global = window.global_cell(i);
      near_.push_back({static_cast<int>(global / BlockShape<Dim>::cells), static_cast<int>(global % BlockShape<Dim>::cells),
                       s.production, s.dissipation});
    }
    if (!has_wall) return;
    Piece piece;
    piece.force_point = seen.wall + 0.5 * seen.cell * seen.normal;
    piece.area = area.norm();
    piece.traction = stress * piece.area * seen.along;
    piece.rho = seen.rho;
    piece.y_plus = std::sqrt(stress) * seen.y / seen.nu;
    piece.wet = seen.wet;
    const auto& spaces = mask.half().space;
    piece.space = spaces.empty() ? mask.space_at(seen.image) : std::max<int>(spaces[at], 0);
    pieces_.push_back(piece);
  });
}

/// Adds to sink[face] the force along `axis` that the piece takes from the face [N; 2-D per metre].
template <int Dim>
void HullWalls<Dim>::spread(const HullMask<Dim>& mask, const Piece& piece, int axis, std::vector<double>& sink) const {
  const auto& aperture = mask.half().aperture[static_cast<std::size_t>(axis)];
  const HullWindow<Dim>& window = mask.window();
  double sum = 0;
  const Vec<Dim> shift = face_shift<Dim>(axis);
  around<Dim>(window, piece.force_point, shift, [&](std::size_t at, double w) { sum += w * aperture[at]; });
  if (!(sum > 0)) return;
  const double force = piece.rho * piece.traction[axis] / sum;
  around<Dim>(window, piece.force_point, shift,
              [&](std::size_t at, double w) { sink[at] += force * w * aperture[at]; });
}

template <int Dim>
motion::DofVector<Dim> HullWalls<Dim>::apply(const HullMask<Dim>& mask, FlowState<Dim>& state,
                                             const motion::Twist<Dim>& twist, double dt) {
  motion::DofVector<Dim> load = motion::DofVector<Dim>::Zero();
  if (pieces_.empty()) return load;
  const HullWindow<Dim>& window = mask.window();
  for (const Piece& piece : pieces_) {
    if (!piece.wet) continue;
    YPlusRange& range = y_plus_[piece.space];
    range.smallest = std::min(range.smallest, piece.y_plus);
    range.largest = std::max(range.largest, piece.y_plus);
    range.weighted += dt * piece.area * piece.y_plus;
    range.weight += dt * piece.area;
  }
  std::vector<double> sink;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    sink.assign(window.size(), 0.0);
    for (const Piece& piece : pieces_) spread(mask, piece, axis, sink);
    window.load_faces(state.u, axis, u_[a]);
    IVec<Dim> lower = filled<Dim>(0);
    lower[axis] = 1;
    for_box<Dim>(lower, window.n(), [&](const IVec<Dim>& i) {
      const auto at = static_cast<std::size_t>(window.at(i));
      if (sink[at] == 0) return;
      IVec<Dim> below = i;
      --below[axis];
      if (window.tile_of(i) < 0 || window.tile_of(below) < 0) return;  // given on the tank's sides
      const double water = 0.5 * (vof_[at] + vof_[at - static_cast<std::size_t>(window.stride(axis))]);
      // The whole control volume's, as transport and stress have it.
      const double mass = fluids_.rho(water) * window.cell_volume();
      const Vec<Dim> x = window.face_centre(i, axis);
      const double relative = u_[a][at] - motion::velocity_at<Dim>(twist, mask.half().pose, x)[axis];
      const double ratio = dt * sink[at] / (mass * relative);
      if (!(ratio > 0)) return;  // friction stops a flow, it does not turn it round
      // Explicit up to half of the velocity, then with a bound: never past rest, however long the step.
      const double taken = (ratio <= 0.5 ? ratio : 1 - 0.25 / ratio) * relative;
      u_[a][at] -= taken;
      const double force = mass * taken / dt;
      Vec<Dim> vector = Vec<Dim>::Zero();
      vector[axis] = force;
      load[axis] += force;
      load.template tail<motion::n_angular<Dim>>() += motion::moment<Dim>(mask.half().pose, x, vector);
    });
    window.store_faces(u_[a], axis, state.u);
  }
  field::restrict_faces<double, Dim>(window.forest(), state.u);
  return load;
}

template class HullWalls<2>;
template class HullWalls<3>;

}  // namespace seaway::flow
