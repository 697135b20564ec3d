#include "core/flow/slip_flux.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::flow {

using field::filled;
using field::for_box;

namespace {

/// Length of the sum of the wall's areas around a face over the sum of their lengths: from the first value on the
/// wall counts as plane, below the second as an edge, where "along the wall" means nothing.
constexpr double plane_wall = 0.99, edge_of_wall = 0.95;

/// f(neighbour) for the indices within `lower` .. `upper` (exclusive) of `at` that lie in the window and, as cells,
/// in one of its tiles.
template <int Dim, class F>
void for_cells_around(const HullWindow<Dim>& window, const IVec<Dim>& at, const IVec<Dim>& lower, const IVec<Dim>& upper,
                      F&& f) {
  for_box<Dim>(lower, upper, [&](const IVec<Dim>& offset) {
    IVec<Dim> i = at;
    for (int a = 0; a < Dim; ++a) {
      i[a] += offset[a];
      if (i[a] < 0 || i[a] >= window.n()[a]) return;
    }
    if (window.tile_of(i) >= 0) f(i);
  });
}

}  // namespace

/// The wall in the cells on both sides of the face and beside them.
template <int Dim>
typename SlipFlux<Dim>::Wall SlipFlux<Dim>::wall_at(const HullMask<Dim>& mask, const IVec<Dim>& face, int axis) const {
  IVec<Dim> lower = filled<Dim>(-1), upper = filled<Dim>(2);
  upper[axis] = 1;
  Vec<Dim> own = Vec<Dim>::Zero(), all = Vec<Dim>::Zero();
  double areas = 0;
  for_cells_around<Dim>(mask.window(), face, lower, upper, [&](const IVec<Dim>& cell) {
    const Vec<Dim> area = mask.wall_area(cell);
    bool beside = true;
    for (int a = 0; a < Dim; ++a) beside = beside && (a == axis || cell[a] == face[a]);
    if (beside) own += area;
    all += area;
    areas += area.norm();
  });
  Wall wall;
  const double least = 1e-6 * mask.window().face_area(0);
  if (!(areas > least)) return wall;
  wall.flatness = std::clamp((all.norm() / areas - edge_of_wall) / (plane_wall - edge_of_wall), 0.0, 1.0);
  wall.normal = own.norm() > least ? own.normalized() : all.normalized();
  return wall;
}

/// Velocity at the face: means of the faces around it that are open, by the square of their apertures.
template <int Dim>
bool SlipFlux<Dim>::velocity_at(const HullMask<Dim>& mask, const IVec<Dim>& face, int axis, double dt,
                                Vec<Dim>& velocity) const {
  const HullWindow<Dim>& window = mask.window();
  const HullGeometry<Dim>& half = mask.half();
  const auto space = [&](std::size_t at, std::size_t below) { return std::max(half.space[at], half.space[below]); };
  const auto here = static_cast<std::size_t>(window.at(face));
  const auto here_below = here - static_cast<std::size_t>(window.stride(axis));
  for (int d = 0; d < Dim; ++d) {
    const auto dd = static_cast<std::size_t>(d);
    IVec<Dim> lower = filled<Dim>(-1), upper = filled<Dim>(2);
    if (d != axis) {
      lower[d] = 0;
      upper[axis] = 1;
    }
    double sum = 0, weight = 0;
    for_cells_around<Dim>(window, face, lower, upper, [&](const IVec<Dim>& i) {
      if (i[d] == 0) return;
      const auto at = static_cast<std::size_t>(window.at(i));
      const auto below = at - static_cast<std::size_t>(window.stride(d));
      const double w = half.aperture[dd][at] * half.aperture[dd][at];
      if (!(w > 0) || (!half.space.empty() && apart(space(at, below), space(here, here_below)))) return;
      const double rho = 0.5 * (fluids_.rho(vof_[at]) + fluids_.rho(vof_[below]));
      sum += w * (u_[dd][at] - dt * (p_[at] - p_[below]) / (rho * window.h()[d]));
      weight += w;
    });
    if (!(weight > 0)) return false;
    velocity[d] = sum / weight;
  }
  return true;
}

template <int Dim>
void SlipFlux<Dim>::find(const HullMask<Dim>& mask, const FlowState<Dim>& state, const motion::Twist<Dim>& twist,
                         double dt) {
  const HullWindow<Dim>& window = mask.window();
  for (int a = 0; a < Dim; ++a) window.load_faces(state.u, a, u_[static_cast<std::size_t>(a)]);
  window.load_cells(state.p, p_);
  window.load_cells(state.vof, vof_);
  constexpr int n = BlockShape<Dim>::n;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto ax = static_cast<std::size_t>(axis);
    flux_[ax].assign(window.size(), 0.0);
    const auto& tiles = window.tiles();
    mesh::parallel_for(static_cast<int>(tiles.size()), window.forest().threads(), [&](int t) {
      const IVec<Dim> first = tiles[static_cast<std::size_t>(t)].at;
      IVec<Dim> upper = first;
      for (int& v : upper) v += n;
      for_box<Dim>(first, upper, [&](const IVec<Dim>& i) {
        const auto at = static_cast<std::size_t>(window.at(i));
        const double aperture = mask.half().aperture[ax][at];
        const double missing = 1 - mask.solid_face(axis)[at] - aperture;
        if (!(aperture > 0 && aperture < 1) || std::abs(missing) < 1e-6) return;
        IVec<Dim> below = i;
        --below[axis];
        if (below[axis] < 0 || window.tile_of(below) < 0) return;  // given on the tank's sides
        const Wall wall = wall_at(mask, i, axis);
        Vec<Dim> v;
        if (!(wall.flatness > 0) || !velocity_at(mask, i, axis, dt, v)) return;
        v -= motion::velocity_at<Dim>(twist, mask.half().pose, window.face_centre(i, axis));
        flux_[ax][at] = wall.flatness * missing * (v - v.dot(wall.normal) * wall.normal)[axis];
      });
    });
  }
}

template class SlipFlux<2>;
template class SlipFlux<3>;

}  // namespace seaway::flow
