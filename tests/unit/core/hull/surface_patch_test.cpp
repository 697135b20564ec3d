#include "core/hull/surface_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/constants.hpp"
#include "core/hull/surface_shapes.hpp"

namespace seaway::hull {
namespace {

using Solids = std::vector<std::shared_ptr<const SurfaceTree>>;

Solids solid(Surface s, double weight = 1) {
  return {std::make_shared<SurfaceTree>(std::move(s), weight)};
}

Eigen::Matrix3d turned(double angle, const Vec3& about = Vec3(1, 0.4, -0.3)) {
  return Eigen::AngleAxisd(angle, about.normalized()).toRotationMatrix();
}

OrientedBox<3> box_at(const Vec3& centre, const Vec3& half,
                      const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity()) {
  return {centre, half, axes};
}

OrientedBox<3> grown(OrientedBox<3> box, double by = 1.3) {
  box.half *= by;
  return box;
}

/// Not closed by itself: a patch that answers for one control volume.
SurfacePatch patch_of(const Solids& s, const OrientedBox<3>& block) {
  return SurfacePatch(s, block, nullptr, false);
}

/// Ship-like, concave and with triangles of all directions.
const Solids& ship() {
  static const Solids s = [] {
    OffsetsHullSpec spec;
    spec.scale = 51;
    spec.origin = 71;
    spec.max_step = 4;
    spec.n_girth = 24;
    return solid(
        offsets_surface(read_offsets_table(SEAWAY_EXAMPLES "/dtmb5415_offsets.csv"), spec));
  }();
  return s;
}

TEST(SurfacePatch, BoxesInBoxAreExact) {
  const Solids s = solid(box_surface(2, 0.4, 0.3));
  const auto block = box_at({0, 0, 0}, {0.3, 0.5, 0.6});
  const auto patch = patch_of(s, block);
  const auto inside = patch.solid_part(box_at({0.1, 0.05, 0.1}, {0.01, 0.02, 0.03}));
  EXPECT_NEAR(inside.volume, 8 * 6e-6, 1e-18);
  EXPECT_NEAR((inside.moment - inside.volume * Vec3(0.1, 0.05, 0.1)).norm(), 0, 1e-18);
  EXPECT_NEAR(patch.solid_part(box_at({0.1, 0.25, 0.1}, {0.01, 0.02, 0.03})).volume, 0, 1e-18);
  // Half in the side wall, whose plane holds the middle of the box; and face on the wall.
  EXPECT_NEAR(patch.solid_part(box_at({0.1, 0.2, 0.1}, {0.01, 0.02, 0.03})).volume, 24e-6, 1e-18);
  EXPECT_NEAR(patch.solid_part(box_at({0.1, 0.18, 0.1}, {0.01, 0.02, 0.03})).volume, 48e-6, 1e-18);
  EXPECT_NEAR(patch.solid_part(box_at({0.1, 0.22, 0.1}, {0.01, 0.02, 0.03})).volume, 0, 1e-18);
}

TEST(SurfacePatch, FacesOnGridPlanesKeepFractionsWhole) {
  const Solids s = solid(box_surface(0.2, 0.2, 0.2));
  const auto block = box_at({0, 0, 0.1}, {0.2, 0.2, 0.2});
  const auto patch = patch_of(s, block);
  const Vec3 half = Vec3::Constant(0.01);
  for (int k = -12; k < 12; ++k)
    for (int j = -12; j < 12; ++j)
      for (int i = -12; i < 12; ++i) {
        const Vec3 x(0.02 * i * 0.5 + 0.01, 0.02 * j * 0.5 + 0.01, 0.1 + 0.02 * k * 0.5 + 0.01);
        const auto cv = box_at(x, half);
        Vec3 overlap;
        for (int a = 0; a < 3; ++a) {
          const double c = x[a] - (a == 2 ? 0.1 : 0.0);
          overlap[a] = std::clamp(std::min(c + 0.01, 0.1) - std::max(c - 0.01, -0.1), 0.0, 0.02);
        }
        ASSERT_NEAR(patch.solid_part(cv).volume, overlap.prod(), 1e-18);
      }
}

TEST(SurfacePatch, TilesAddUpToTheWholeAtAnyAngle) {
  const Surface& surface = ship()[0]->surface();
  const double volume = enclosed_volume(surface);
  const Vec3 moment = volume_moment(surface);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 4; ++trial) {
    const Vec3 about(any(random), any(random), any(random));
    const Eigen::Matrix3d axes =
        trial == 0 ? Eigen::Matrix3d::Identity() : turned(3 * any(random), about);
    const Vec3 h(0.11, 0.13, 0.1), middle(0.03 * any(random), 0.02, 0.13);
    const int n = 17;
    double sum = 0;
    Vec3 first = Vec3::Zero();
    for (int k = -n; k <= n; ++k)
      for (int j = -n; j <= n; ++j)
        for (int i = -n; i <= n; ++i) {
          const auto cv = box_at(middle + axes * (2 * h.cwiseProduct(Vec3(i, j, k))), h, axes);
          if ((cv.centre - Vec3(0, 0, 0.15)).norm() > 2.2) continue;
          const auto part = patch_of(ship(), grown(cv)).solid_part(cv);
          sum += part.volume;
          first += part.moment;
        }
    EXPECT_NEAR(sum / volume, 1, 1e-12) << trial;
    EXPECT_NEAR((first - moment).norm() / volume, 0, 1e-12) << trial;
  }
}

TEST(SurfacePatch, SubBoxesOfABlockAddUpToIt) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::Matrix3d axes = turned(2 * any(random), {any(random), any(random), any(random)});
    const Vec3 at(1.4 * any(random), 0.2 * any(random), 0.15 + 0.16 * any(random));
    const auto block = box_at(at, Vec3(0.05, 0.06, 0.04), axes);
    const auto patch = patch_of(ship(), block);
    const auto whole = patch.solid_part(block);
    const HalfSpace<3> water{Vec3(any(random), any(random), any(random)), 0};
    HalfSpace<3> here = water;
    here.d = water.normal.dot(at) + 0.02 * any(random);
    const double below = patch.solid_volume_below(block, here);
    HalfSpace<3> other{-here.normal, -here.d};
    EXPECT_NEAR(below + patch.solid_volume_below(block, other), whole.volume, 1e-16);
    double sum = 0, sum_below = 0;
    Vec3 first = Vec3::Zero();
    for (int k = -4; k < 4; ++k)
      for (int j = -4; j < 4; ++j)
        for (int i = -4; i < 4; ++i) {
          const Vec3 h = block.half / 8;
          const auto cv =
              box_at(at + axes * h.cwiseProduct(Vec3(2 * i + 1, 2 * j + 1, 2 * k + 1)), h, axes);
          const auto part = patch.solid_part(cv);
          sum += part.volume;
          first += part.moment;
          sum_below += patch.solid_volume_below(cv, here);
        }
    EXPECT_NEAR(sum, whole.volume, 1e-16);
    EXPECT_NEAR((first - whole.moment).norm(), 0, 1e-15);
    EXPECT_NEAR(sum_below, below, 1e-16);
  }
}

/// A mesh block of 8 x 8 x 8 cells with room for the control volumes around its faces.
OrientedBox<3> mesh_block(const Vec3& at, const Vec3& cell, const Eigen::Matrix3d& axes) {
  return box_at(at, 4.6 * cell, axes);
}

TEST(SurfacePatch, LatticesOfAMeshBlockHoldWhatSingleBoxesHold) {
  Solids some = ship();
  some.push_back(std::make_shared<SurfaceTree>(box_surface(0.4, 0.1, 0.2), 0.3));  // porous, overlapping
  const Vec3 h(0.02, 0.012, 0.01);
  const double full = h.prod();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  int cut = 0;
  for (int trial = 0; trial < 40; ++trial) {
    // Upright every fourth time: walls and water planes of the box along the grid.
    const Eigen::Matrix3d axes = trial % 4 == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                                : turned(2 * any(random), {any(random), any(random), any(random)});
    const Vec3 at(0.3 * any(random), 0.2 * any(random), 0.1 + 0.16 * any(random));
    const auto block = mesh_block(at, h, axes);
    const TriangleColumns columns(some, block);
    const auto patch = SurfacePatch(some, block, nullptr, true);
    for (int kind = 0; kind < 4; ++kind) {
      BoxLattice lattice;
      lattice.edge = h;
      for (int a = 0; a < 3; ++a) {
        lattice.n[a] = 8 + (a == kind);
        lattice.lower[a] = -0.5 * lattice.n[a] * h[a];
      }
      const auto all = columns.moments(lattice);
      IVec<3> i;
      for (i[2] = 0; i[2] < lattice.n[2]; ++i[2])
        for (i[1] = 0; i[1] < lattice.n[1]; ++i[1])
          for (i[0] = 0; i[0] < lattice.n[0]; ++i[0]) {
            const Vec3 centre = lattice.lower + h.cwiseProduct(Vec3(i[0] + 0.5, i[1] + 0.5, i[2] + 0.5));
            const auto one = columns.moments(TriangleColumns::Cuboid{centre, 0.5 * h});
            const auto& same = all[lattice.at(i)];
            ASSERT_NEAR(same.volume, one.volume, 1e-12 * full) << trial << ' ' << kind;
            ASSERT_NEAR((same.first - one.first).norm(), 0, 1e-12 * full * h.norm()) << trial << ' ' << kind;
            const auto cv = box_at(at + axes * centre, 0.5 * h, axes);
            const auto part = patch.solid_part(cv);
            ASSERT_NEAR(part.volume, std::clamp(one.volume, 0.0, full), 2e-12 * full);
            ASSERT_NEAR((part.moment - axes * one.first - part.volume * cv.centre).norm(), 0, 2e-12 * full);
            cut += one.volume > 1e-6 * full && one.volume < (1 - 1e-6) * full;
          }
    }
  }
  EXPECT_GT(cut, 5000);
}

TEST(SurfacePatch, PatchesOfAllSizesAgree) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Matrix3d axes = turned(2 * any(random), {any(random), any(random), any(random)});
    const Vec3 at(1.45 * any(random), 0.2 * any(random), 0.15 + 0.17 * any(random));
    const auto cv = box_at(at, Vec3(0.01, 0.012, 0.009), axes);
    const auto small = patch_of(ship(), grown(cv, 1.001)).solid_part(cv);
    for (const double by : {3.0, 12.0, 100.0}) {
      const auto large = patch_of(ship(), grown(cv, by)).solid_part(cv);
      EXPECT_NEAR(small.volume, large.volume, 1e-17);
      EXPECT_NEAR((small.moment - large.moment).norm(), 0, 1e-17);
    }
  }
}

TEST(SurfacePatch, VolumeBelowPlaneOfSphereMatchesTheCap) {
  const double r = 0.3;
  const Solids s = solid(sphere_surface(r, 200));
  for (const double angle : {0.0, 0.4, 1.2}) {
    const Eigen::Matrix3d axes = turned(angle);
    const auto all = box_at({0, 0, r}, Vec3::Constant(0.7), axes);
    const auto patch = patch_of(s, all);
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0, -1, 0), Vec3(1, 1, -1), Vec3(0.2, -0.9, 0.1)})
      for (const double d : {-0.2, 0.0, 0.11}) {
        const double depth = r + d;
        const double cap = pi * depth * depth * (3 * r - depth) / 3;
        const Vec3 unit = n.normalized();
        EXPECT_NEAR(patch.solid_volume_below(all, {unit, unit.dot(Vec3(0, 0, r)) + d}), cap,
                    2e-4 * cap);
      }
  }
}

TEST(SurfacePatch, PlanesAlongEachAxisAndThroughFacesAreExact) {
  const Solids s = solid(box_surface(2, 0.4, 0.3));
  const auto cv = box_at({0.95, 0.15, 0.25}, {0.1, 0.1, 0.1});  // solid: 0.15 x 0.15 x 0.15
  const auto patch = patch_of(s, grown(cv));
  const Vec3 corner(0.85, 0.05, 0.15);
  for (int a = 0; a < 3; ++a)
    for (const double part : {0.0, 0.25, 0.5, 1.0}) {
      Vec3 n = Vec3::Zero();
      n[a] = 2;
      const double at = corner[a] + 0.15 * part;
      const double volume = 0.15 * 0.15 * 0.15;
      EXPECT_NEAR(patch.solid_volume_below(cv, {n, 2 * at}), volume * part, 1e-15);
      EXPECT_NEAR(patch.solid_volume_below(cv, {-n, -2 * at}), volume * (1 - part), 1e-15);
    }
}

TEST(SurfacePatch, FaceFractionIsTheDerivativeOfTheVolume) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  int n_cut = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Matrix3d axes = turned(2 * any(random), {any(random), any(random), any(random)});
    const Vec3 at(1.4 * any(random), 0.19 * any(random), 0.1 + 0.13 * any(random));
    const auto cv = box_at(at, Vec3(0.02, 0.018, 0.022), axes);
    const auto patch = patch_of(ship(), grown(cv));
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        const double step = 1e-6, side = high ? 1 : -1;
        auto slab = cv;  // around the face
        slab.half[axis] = step;
        slab.centre += side * cv.half[axis] * axes.col(axis);
        const double expected = patch.solid_part(slab).volume / (8 * slab.half.prod());
        const double got = patch.solid_face_fraction(cv, axis, high);
        EXPECT_NEAR(got, expected, 1e-4);
        n_cut += got > 0.01 && got < 0.99;
      }
  }
  EXPECT_GT(n_cut, 100);
}

TEST(SurfacePatch, WeightsOfSolidsAdd) {
  Solids s = solid(box_surface(2, 0.4, 0.3));
  s.push_back(solid(box_surface(1, 0.2, 0.1), -0.25)[0]);
  const auto cv = box_at({0, 0, 0.05}, {0.02, 0.02, 0.02});
  const auto patch = SurfacePatch(s, grown(cv), nullptr, true);
  EXPECT_NEAR(patch.solid_part(cv).volume, 0.75 * 64e-6, 1e-18);
  EXPECT_NEAR(patch.solid_face_fraction(cv, 1, true), 0.75, 1e-12);
}

}  // namespace
}  // namespace seaway::hull
