#include "core/flow/hull_mask.hpp"

#include <algorithm>
#include <cmath>

#include "core/flow/near_hull.hpp"

namespace seaway::flow {

using field::filled;
using field::for_box;

template <int Dim>
HullMask<Dim>::HullMask(const Forest<Dim>& forest, std::shared_ptr<const hull::Hull<Dim>> hull,
                        const motion::RigidBody<Dim>& body, int clearance, Walls walls, bool fixed)
    : hull_(std::move(hull)), body_(body), window_(forest, fixed), clearance_(clearance), walls_(walls) {}

template <int Dim>
hull::OrientedBox<Dim> HullMask<Dim>::box_at(const HullGeometry<Dim>& g, const Vec<Dim>& centre) const {
  return {motion::earth_to_hull<Dim>(body_, g.pose, centre), 0.5 * window_.h(),
          motion::rotation(g.pose).transpose()};
}

template <int Dim>
void HullMask<Dim>::make_patches(const HullGeometry<Dim>& g,
                                 std::vector<std::unique_ptr<hull::HullPatch<Dim>>>& out) const {
  constexpr int nb = BlockShape<Dim>::n;
  const auto& tiles = window_.tiles();
  out.clear();
  out.resize(tiles.size());
  mesh::parallel_for(static_cast<int>(tiles.size()), window_.forest().threads(), [&](int t) {
    const auto& tile = tiles[static_cast<std::size_t>(t)];
    // Control volumes reach half a cell out.
    const Vec<Dim> centre = window_.cell_centre(tile.at) + 0.5 * (nb - 1) * window_.h();
    hull::OrientedBox<Dim> block = box_at(g, centre);
    block.half = (0.5 * nb + 0.6) * window_.h();
    out[static_cast<std::size_t>(t)] = hull_->patch(block);
  });
}

template <int Dim>
void HullMask<Dim>::sample_distance(HullGeometry<Dim>& g) const {
  constexpr int nb = BlockShape<Dim>::n;
  g.phi.assign(window_.size(), 1e3);
  const auto& tiles = window_.tiles();
  const auto rotate = motion::rotation(g.pose);
  mesh::parallel_for(static_cast<int>(tiles.size()), window_.forest().threads(), [&](int t) {
    const auto& tile = tiles[static_cast<std::size_t>(t)];
    // One look at the middle tells whether the hull's surface can reach the tile.
    Vec<Dim> middle = window_.cell_centre(tile.at) + 0.5 * (nb - 1) * window_.h();
    const double reach = 0.5 * nb * window_.h().norm() + 4 * window_.h().maxCoeff();
    const double there = hull_->signed_distance(motion::earth_to_hull<Dim>(body_, g.pose, middle));
    const bool far = std::abs(there) > reach;
    IVec<Dim> upper = tile.at;
    for (int& u : upper) u += nb;
    for_box<Dim>(tile.at, upper, [&](const IVec<Dim>& i) {
      double value = there;
      if (!far) {
        const Vec<Dim> x = window_.cell_centre(i);
        const Vec<Dim> in_hull = rotate.transpose() * (x - g.pose.cog) + body_.cog;
        value = hull_->signed_distance(in_hull);
      }
      g.phi[static_cast<std::size_t>(window_.at(i))] = value;
    });
  });
}

template <int Dim>
bool HullMask<Dim>::porous(const HullGeometry<Dim>& g, const Vec<Dim>& x) const {
  return hull_->has_porous_space() &&
         hull_->compartment_at(motion::earth_to_hull<Dim>(body_, g.pose, x)) >= 0;
}

template <int Dim>
void HullMask<Dim>::find_apertures(HullGeometry<Dim>& g, bool with_solid_faces) {
  constexpr int nb = BlockShape<Dim>::n;
  std::vector<std::unique_ptr<hull::HullPatch<Dim>>> own;
  std::vector<std::unique_ptr<hull::HullPatch<Dim>>>& patches = &g == &now_ ? patches_ : own;
  make_patches(g, patches);
  const auto& tiles = window_.tiles();
  const double volume = window_.cell_volume();
  const auto rotate = motion::rotation(g.pose);
  const double far = clip_distance_ + 0.3 * window_.h().maxCoeff();
  for (int axis = 0; axis < Dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    g.aperture[a].assign(window_.size(), 1.0);
    g.arm[a].resize(window_.size());
    if (with_solid_faces) solid_face_[a].assign(window_.size(), 0.0);
    mesh::parallel_for(static_cast<int>(tiles.size()), window_.forest().threads(), [&](int t) {
      const auto& tile = tiles[static_cast<std::size_t>(t)];
      const auto& patch = *patches[static_cast<std::size_t>(t)];
      IVec<Dim> upper = tile.at;
      for (int& u : upper) u += nb;  // the faces on the tile's upper side belong to the next one
      const bool last = window_.at_tank_side(tile, axis, 1), first = window_.at_tank_side(tile, axis, 0);
      if (last) ++upper[axis];
      for_box<Dim>(tile.at, upper, [&](const IVec<Dim>& i) {
        const auto at = static_cast<std::size_t>(window_.at(i));
        const Vec<Dim> x = window_.face_centre(i, axis);
        double phi = g.phi[at];
        if (last && i[axis] == tile.at[axis] + nb) phi = g.phi[at - static_cast<std::size_t>(window_.stride(axis))];
        else if (i[axis] > 0 && !(first && i[axis] == tile.at[axis])) phi = 0.5 * (phi + g.phi[at - static_cast<std::size_t>(window_.stride(axis))]);
        if (phi < -far) {
          g.aperture[a][at] = 0;
          if (with_solid_faces) solid_face_[a][at] = 1;
          return;
        }
        if (phi > far && !porous(g, x)) return;
        const auto box = box_at(g, x);
        const hull::SolidPart<Dim> solid = closed_part(g, patch, box, i, axis);
        double open = 1 - solid.volume / volume;
        if (open < smallest_aperture) open = 0;
        if (open > 1) open = 1;
        // What the pressure coefficients can hold: w must see the very apertures of the solve.
        open = static_cast<double>(static_cast<float>(open));
        g.aperture[a][at] = open;
        if (open > 0 && open < 1) {
          const Vec<Dim> moment = volume * box.centre - solid.moment;
          g.arm[a][at] = rotate * (moment / (volume - solid.volume) - body_.cog);
        }
        if (with_solid_faces) {
          hull::OrientedBox<Dim> cell = box;  // the cell above the face
          Vec<Dim> shift = Vec<Dim>::Zero();
          shift[axis] = 0.5 * window_.h()[axis];
          cell.centre += rotate.transpose() * shift;
          if (is_wall(g, at, axis, i[axis] == 0)) solid_face_[a][at] = 1 - open;
          else if (g.space.empty() || g.space[at] < 0) solid_face_[a][at] = patch.solid_face_fraction(cell, axis, false);
          else solid_face_[a][at] = patch.outside_space_face_fraction(cell, axis, false, g.space[at]);
        }
      });
    });
  }
}

template <int Dim>
void HullMask<Dim>::find_fluid_fractions() {
  constexpr int nb = BlockShape<Dim>::n;
  theta_.assign(window_.size(), 1.0);
  const auto& tiles = window_.tiles();
  const double volume = window_.cell_volume();
  mesh::parallel_for(static_cast<int>(tiles.size()), window_.forest().threads(), [&](int t) {
    const auto& tile = tiles[static_cast<std::size_t>(t)];
    IVec<Dim> upper = tile.at;
    for (int& u : upper) u += nb;
    for_box<Dim>(tile.at, upper, [&](const IVec<Dim>& i) {
      const auto at = static_cast<std::size_t>(window_.at(i));
      const double phi = now_.phi[at];
      if (phi < -clip_distance_) {
        theta_[at] = 0;
        return;
      }
      const Vec<Dim> x = window_.cell_centre(i);
      if (phi > clip_distance_ && !porous(now_, x)) return;
      const auto& patch = *patches_[static_cast<std::size_t>(t)];
      const signed char space = now_.space.empty() ? passage : now_.space[at];
      const double solid = space < 0 ? patch.solid_part(box_at(now_, x)).volume
                                     : patch.outside_space(box_at(now_, x), space).volume;
      const double fluid = 1 - solid / volume;
      theta_[at] = fluid < 1e-12 ? 0 : (fluid > 1 - 1e-12 ? 1 : fluid);
    });
  });
}

template <int Dim>
void HullMask<Dim>::update(const motion::Pose<Dim>& now, const motion::Pose<Dim>& half_step) {
  const auto same = [](const motion::Pose<Dim>& a, const motion::Pose<Dim>& b) {
    return a.cog == b.cog && motion::rotation(a) == motion::rotation(b);
  };
  if (has_pose_ && same(now, now_.pose) && same(half_step, half_.pose)) {
    moved_ = false;
    return;
  }
  now_.pose = now;
  half_.pose = half_step;
  const hull::Box<Dim> bounds = hull_->bounds();
  Vec<Dim> lower = Vec<Dim>::Constant(1e300), upper = Vec<Dim>::Constant(-1e300);
  for (const auto& pose : {now, half_step}) {
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      Vec<Dim> x;
      for (int a = 0; a < Dim; ++a) x[a] = ((corner >> a) & 1) ? bounds.upper[a] : bounds.lower[a];
      const Vec<Dim> earth = motion::hull_to_earth<Dim>(body_, pose, x);
      lower = lower.cwiseMin(earth);
      upper = upper.cwiseMax(earth);
    }
  }
  const Vec<Dim> h = window_.forest().cell_size(window_.forest().n_levels() - 1);
  const Vec<Dim> around = clearance_ * h;
  const auto touches = [&](const Vec<Dim>& low, const Vec<Dim>& high) {
    for (const auto& pose : {now, half_step})
      if (comes_near<Dim>(*hull_, body_, pose, low - around, high + around, 0.0)) return true;
    return false;
  };
  moved_ = window_.cover(lower - around, upper + around, touches) || !has_pose_;
  has_pose_ = true;
  // Half diagonal, and the table's interpolation error near corners.
  clip_distance_ = 0.5 * h.norm() + 0.25 * h.maxCoeff();
  sample_distance(now_);
  if (walls_ == Walls::thin) find_spaces(now_);
  find_apertures(now_, false);
  find_fluid_fractions();
  if (walls_ == Walls::thin) find_carried();
  if (same(now, half_step)) {
    half_ = now_;
    for (int axis = 0; axis < Dim; ++axis) solid_face_[static_cast<std::size_t>(axis)].assign(window_.size(), 0.0);
  } else {
    sample_distance(half_);
    if (walls_ == Walls::thin) find_spaces(half_);
  }
  find_apertures(half_, true);
}

template <int Dim>
double HullMask<Dim>::submerged_solid(const IVec<Dim>& cell, const std::array<double, Dim>& normal,
                                    double d) const {
  const Vec<Dim> x = window_.cell_centre(cell);
  const auto rotate = motion::rotation(now_.pose);
  // normal . xi <= d with xi = (x - lower corner) / h, turned into hull axes.
  Vec<Dim> n_earth;
  double constant = d;
  for (int a = 0; a < Dim; ++a) {
    n_earth[a] = normal[static_cast<std::size_t>(a)] / window_.h()[a];
    constant += n_earth[a] * (x[a] - 0.5 * window_.h()[a]);
  }
  hull::HalfSpace<Dim> water;
  water.normal = rotate.transpose() * n_earth;
  water.d = constant - n_earth.dot(now_.pose.cog) + water.normal.dot(body_.cog);
  const auto& patch = *patches_[static_cast<std::size_t>(window_.tile_of(cell))];
  const signed char space = now_.space.empty() ? passage : now_.space[static_cast<std::size_t>(window_.at(cell))];
  return space < 0 ? patch.solid_volume_below(box_at(now_, x), water)
                   : patch.outside_space_below(box_at(now_, x), water, space);
}

template <int Dim>
Vec<Dim> HullMask<Dim>::wall_area(const IVec<Dim>& cell) const {
  const auto at = static_cast<std::size_t>(window_.at(cell));
  Vec<Dim> area;
  for (int a = 0; a < Dim; ++a) {
    const auto& solid = solid_face_[static_cast<std::size_t>(a)];
    area[a] = (solid[at] - solid[at + static_cast<std::size_t>(window_.stride(a))]) * window_.face_area(a);
  }
  return area;
}

template <int Dim>
linear::RigidRows<Dim> HullMask<Dim>::rigid_rows(const HullGeometry<Dim>& g) const {
  using Row = Eigen::Matrix<double, linear::n_dof<Dim>, 1>;
  using Entry = std::pair<std::int64_t, Row>;
  const auto entries = window_.template collect<Entry>([&](const IVec<Dim>& i, std::vector<Entry>& out) {
    const auto at = static_cast<std::size_t>(window_.at(i));
    bool cut = false;
    bool any_open = false;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto& a = g.aperture[static_cast<std::size_t>(axis)];
      const double lo = a[at], hi = a[at + static_cast<std::size_t>(window_.stride(axis))];
      cut = cut || lo < 1 || hi < 1;
      any_open = any_open || lo > 0 || hi > 0;
    }
    if (!cut || !any_open || window_.tile_of(i) < 0) return;
    Row j = Row::Zero();
    for (int axis = 0; axis < Dim; ++axis) {
      const auto ax = static_cast<std::size_t>(axis);
      for (int side = 0; side < 2; ++side) {
        const std::size_t f = at + static_cast<std::size_t>(side * window_.stride(axis));
        const double flux = (side == 0 ? 1.0 : -1.0) * g.aperture[ax][f] * window_.face_area(axis);
        if (flux == 0) continue;
        IVec<Dim> face = i;
        face[axis] += side;
        const Vec<Dim> r = g.aperture[ax][f] < 1 ? g.arm[ax][f] : Vec<Dim>(window_.face_centre(face, axis) - g.pose.cog);
        j[axis] += flux;
        if constexpr (Dim == 2) {
          j[2] += flux * (axis == 0 ? -r[1] : r[0]);
        } else {
          Vec3 n = Vec3::Zero();
          n[axis] = 1;
          j.template tail<3>() += flux * r.cross(n);
        }
      }
    }
    out.emplace_back(window_.global_cell(i), j);
  });
  linear::RigidRows<Dim> rows;
  for (const auto& [cell, j] : entries) {
    rows.cell.push_back(cell);
    rows.j.push_back(j);
  }
  return rows;
}

template <int Dim>
void HullMask<Dim>::mixture_velocity(int axis, const motion::Twist<Dim>& twist, const std::vector<double>& u,
                                     std::vector<double>& w) const {
  const auto ax = static_cast<std::size_t>(axis);
  w.resize(window_.size());
  const auto normal_velocity = [&](const Vec<Dim>& arm) {
    if constexpr (Dim == 2) {
      return axis == 0 ? twist[0] - twist[2] * arm[1] : twist[1] + twist[2] * arm[0];
    } else {
      return (twist.template head<3>() + twist.template tail<3>().cross(arm))[axis];
    }
  };
  window_.for_box_on_threads(filled<Dim>(0), window_.n_faces(axis), [&](const IVec<Dim>& i) {
    const auto at = static_cast<std::size_t>(window_.at(i));
    const double a = half_.aperture[ax][at];
    if (a >= 1) {
      w[at] = u[at];
      return;
    }
    w[at] = normal_velocity(window_.face_centre(i, axis) - half_.pose.cog);
    if (a > 0) w[at] += a * (u[at] - normal_velocity(half_.arm[ax][at]));  // closed faces have no arm
  });
}

template <int Dim>
int HullMask<Dim>::space_at(const Vec<Dim>& x) const {
  return 1 + hull_->compartment_at(motion::earth_to_hull<Dim>(body_, now_.pose, x));
}

template class HullMask<2>;
template class HullMask<3>;

}  // namespace seaway::flow
