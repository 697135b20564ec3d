#include "core/hull/surface_patch.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace seaway::hull {

SurfacePatch::SurfacePatch(const std::vector<std::shared_ptr<const SurfaceTree>>& solids,
                           const OrientedBox<3>& block, std::shared_ptr<const DistanceGrid> table,
                           bool porous)
    : centre_(block.centre),
      half_(block.half),
      axes_(block.axes),
      columns_(solids, block),
      table_(std::move(table)),
      porous_(porous) {}

LatticeParts::LatticeParts(const TriangleColumns& columns, const BoxLattice& lattice)
    : lattice_(lattice), entry_(lattice.size()) {
  const double full = lattice.edge.prod(), least = 1e-12 * full;  // rounding of the sums: 1e-15
  const auto all = columns.moments(lattice);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::abs(all[i].volume) <= least) continue;
    if (std::abs(all[i].volume - full) <= least) {
      entry_[i] = -1;
      continue;
    }
    cut_.push_back(all[i]);
    entry_[i] = static_cast<short>(cut_.size());
  }
}

/// Boxes of the block's lattices lie at whole (faces) or half (cells) multiples of their edges from the block's middle cells;
/// the block's half edges hold as many cells as leave room for half a cell on both sides.
SurfacePatch::Place SurfacePatch::find(const Vec3& centre, const Vec3& half) const {
  constexpr int fewest = 2, most = 16;  // cells along an axis that are worth it
  BoxLattice wanted;
  wanted.edge = 2 * half;
  IVec<3> i{};
  int kind = 3;
  for (int a = 0; a < 3; ++a) {
    if (!(half[a] > 0)) return {};
    const int cells = static_cast<int>(std::floor(std::min(half_[a] / half[a] - 1, 1e3)));
    if (cells < fewest || cells > most) return {};
    const double twice = centre[a] / half[a] + cells, whole = std::round(twice);
    if (std::abs(twice - whole) > 1e-9) return {};
    const int q = static_cast<int>(whole);  // odd: the middle of a cell
    const bool face = q % 2 == 0;
    if (q < 0 || q > 2 * cells || (face && kind != 3)) return {};
    if (face) kind = a;
    i[a] = q / 2;
    wanted.n[a] = cells + face;
    wanted.lower[a] = -(cells + face) * half[a];
  }
  Kept& kept = kept_[static_cast<std::size_t>(kind)];
  std::call_once(kept.once, [&] { kept.parts = std::make_unique<const LatticeParts>(columns_, wanted); });
  const BoxLattice& lattice = kept.parts->lattice();
  if (lattice.n != wanted.n || (lattice.edge - wanted.edge).cwiseAbs().maxCoeff() > 1e-12 * wanted.edge.maxCoeff()) return {};
  return {kept.parts.get(), lattice.at(i)};
}

SurfacePatch::Seen SurfacePatch::seen_at(const Place& place) {
  switch (place.parts->kind(place.box)) {
    case LatticeParts::Kind::fluid: return Seen::fluid;
    case LatticeParts::Kind::solid: return Seen::solid;
    case LatticeParts::Kind::cut: break;
  }
  return Seen::unknown;
}

SurfacePatch::Seen SurfacePatch::look(const Vec3& centre, double radius) const {
  if (columns_.empty()) return Seen::fluid;
  if (table_ == nullptr) return Seen::unknown;
  const double d = table_->value(centre), need = radius + table_->error_bound();
  if (d > need) return porous_ ? Seen::unknown : Seen::fluid;
  return d < -need ? Seen::solid : Seen::unknown;
}

TriangleColumns::Cuboid SurfacePatch::local(const OrientedBox<3>& cv) const {
  SEAWAY_ASSERT((cv.axes - axes_).cwiseAbs().maxCoeff() < 1e-9);
  return {axes_.transpose() * (cv.centre - centre_), cv.half};
}

SolidPart<3> SurfacePatch::solid_part(const OrientedBox<3>& cv) const {
  SolidPart<3> part;
  if (columns_.empty()) return part;
  const double full = 8 * cv.half.prod();
  const auto box = local(cv);
  const Place place = find(box.centre, box.half);
  const Seen seen = place.parts == nullptr ? look(cv.centre, cv.half.norm()) : seen_at(place);
  if (seen == Seen::fluid) return part;
  if (seen == Seen::solid) {
    part.volume = full;
    part.moment = full * cv.centre;
    return part;
  }
  const BoxMoments m = place.parts == nullptr ? columns_.moments(box) : place.parts->cut(place.box);
  part.volume = std::clamp(m.volume, 0.0, full);
  part.moment = axes_ * m.first + part.volume * cv.centre;
  return part;
}

double SurfacePatch::solid_volume_below(const OrientedBox<3>& cv, const HalfSpace<3>& water) const {
  if (columns_.empty()) return 0;
  const Vec3 n = axes_.transpose() * water.normal;
  const double d = water.d - water.normal.dot(cv.centre);
  const double reach = n.cwiseAbs().dot(cv.half);
  if (d >= reach) return solid_part(cv).volume;
  if (d <= -reach || look(cv.centre, cv.half.norm()) == Seen::fluid) return 0;
  return std::clamp(columns_.volume_below(local(cv), n, d), 0.0, 8 * cv.half.prod());
}

double SurfacePatch::solid_face_fraction(const OrientedBox<3>& cv, int axis, bool high) const {
  Vec3 half = cv.half;
  half[axis] = 0;
  const Vec3 middle = cv.centre + (high ? 1.0 : -1.0) * cv.half[axis] * axes_.col(axis);
  if (columns_.empty()) return 0;
  const Place around = find(axes_.transpose() * (middle - centre_), cv.half);
  const Seen seen = around.parts == nullptr ? look(middle, half.norm()) : seen_at(around);
  if (seen != Seen::unknown) return seen == Seen::solid ? 1 : 0;
  const double full = 8 * cv.half.prod() / (2 * cv.half[axis]);
  return std::clamp(columns_.face_area(local(cv), axis, high) / full, 0.0, 1.0);
}

}  // namespace seaway::hull
