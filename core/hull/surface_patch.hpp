// The piece of a triangle surface that a mesh block sees, ready for many exact queries (core/hull/triangle_columns.hpp).
//
// The cells of the block and the control volumes around their faces are asked for most: their solid parts are found together, at
// the first query of a kind (core/hull/box_lattice.hpp), and kept.
//
// Const after construction, thread-safe.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "core/hull/distance_grid.hpp"
#include "core/hull/triangle_columns.hpp"

namespace seaway::hull {

/// What a lattice's boxes hold: most of them nothing, or solid alone.
class LatticeParts {
 public:
  /// cut: neither empty nor full of solid of density 1.
  enum class Kind : signed char { fluid, solid, cut };

  LatticeParts(const TriangleColumns& columns, const BoxLattice& lattice);
  const BoxLattice& lattice() const { return lattice_; }
  Kind kind(std::size_t box) const { return entry_[box] < 0 ? Kind::solid : entry_[box] == 0 ? Kind::fluid : Kind::cut; }
  /// Before: kind is cut.
  const BoxMoments& cut(std::size_t box) const { return cut_[static_cast<std::size_t>(entry_[box] - 1)]; }

 private:
  BoxLattice lattice_;
  std::vector<short> entry_;  ///< 0: fluid; -1: solid; else 1 + the place in cut_
  std::vector<BoxMoments> cut_;
};

class SurfacePatch final : public HullPatch<3> {
 public:
  /// `table` belongs to the walls among `solids` and serves to pass boxes without walls quickly;
  /// not used if `porous` (some solid fills a space with a density below 1).
  SurfacePatch(const std::vector<std::shared_ptr<const SurfaceTree>>& solids,
               const OrientedBox<3>& block, std::shared_ptr<const DistanceGrid> table, bool porous);

  SolidPart<3> solid_part(const OrientedBox<3>& cv) const override;
  double solid_volume_below(const OrientedBox<3>& cv, const HalfSpace<3>& water) const override;
  double solid_face_fraction(const OrientedBox<3>& cv, int axis, bool high) const override;

  int n_triangles() const { return columns_.n_triangles(); }

 private:
  enum class Seen { fluid, solid, unknown };
  Seen look(const Vec3& centre, double radius) const;
  TriangleColumns::Cuboid local(const OrientedBox<3>& cv) const;

  /// A box of one of the block's own lattices.
  struct Place {
    const LatticeParts* parts = nullptr;  ///< null: none of them
    std::size_t box = 0;
  };
  /// `centre` from the block's centre, along its axes.
  Place find(const Vec3& centre, const Vec3& half) const;
  static Seen seen_at(const Place& place);

  Vec3 centre_, half_;
  Eigen::Matrix3d axes_;
  TriangleColumns columns_;
  std::shared_ptr<const DistanceGrid> table_;
  bool porous_;
  struct Kept {
    std::once_flag once;
    std::unique_ptr<const LatticeParts> parts;
  };
  mutable std::array<Kept, 4> kept_;  ///< around the faces of each axis; cells
};

}  // namespace seaway::hull
