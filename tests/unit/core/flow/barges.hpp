// A barge of 0.3 x 0.1 m in a small refined tank, for the tests of what happens at the hull.
#pragma once

#include "core/flow/hull_extension.hpp"
#include "core/flow/hull_mask.hpp"
#include "core/flow/projection.hpp"
#include "core/hull/section_hull.hpp"
#include "tests/unit/core/flow/tanks.hpp"

namespace seaway::flow::testing {

inline constexpr double beam = 0.3, height = 0.1, draft = 0.05;

struct BargeTank {
  Forest<2> forest;
  std::shared_ptr<const hull::SectionHull> hull;
  motion::RigidBody<2> body;
  Boundaries<2> boundaries;
  FluidProperties fluids;

  /// Cells of 25 mm, around the barge `level` times halved.
  explicit BargeTank(int level = 2, double reach = 0.25, int threads = 1)
      : forest(grid(), level,
               mesh::refine_boxes<2>(
                   grid(), {{Vec2(-reach, -0.15), Vec2(reach, 0.15), 0.025 / (1 << level)}}),
               threads) {
    hull::SectionSpec spec;
    spec.shape = hull::SectionSpec::Shape::box;
    spec.beam = beam;
    spec.height = height;
    hull =
        std::make_shared<hull::SectionHull>(hull::build_section(spec), 0.5 * forest.finest_cell());
    body = motion::make_rigid_body<2>(15, Vec3(0, 0, 0.05), Vec3(0.1322, 0, 0));
    boundaries.kind[1][1] = BoundaryKind::open;
  }
  static mesh::TankGrid<2> grid() {
    mesh::TankGrid<2> g;
    g.lower = {-0.8, -0.4};
    g.upper = {0.8, 0.4};
    g.root_blocks = {4, 2};
    return g;
  }
  /// Afloat (the cog is at z = 0 there), shifted off the grid lines, at a roll angle.
  static motion::Pose<2> afloat(double roll, double y = 0.0037, double z = 0.0021) {
    motion::Pose<2> pose;
    pose.cog = {y, z};
    pose.roll = roll;
    return pose;
  }
  HullMask<2> mask_at(const motion::Pose<2>& pose) const {
    HullMask<2> mask(forest, hull, body);
    mask.update(pose, pose);
    return mask;
  }
};

/// Water up to `level`, going straight on through the hull.
inline void fill_flat(const BargeTank& tank, const HullMask<2>* mask, double level,
                      FlowState<2>& state) {
  fill_water<2>(
      tank.forest, [level](const Vec2&) { return level; }, state);
  if (!mask) return;
  std::vector<double> vof;
  mask->window().load_cells(state.vof, vof);
  HullExtension<2>().extend_vof(*mask, vof);
  mask->window().store_cells(vof, state.vof);
  field::restrict_cells<double, 2>(tank.forest, state.vof);
}

template <int Dim>
double largest(const Forest<Dim>& forest, const FaceField<double, Dim>& f) {
  double value = 0;
  for (int axis = 0; axis < Dim; ++axis)
    each_face<Dim>(forest, axis, [&](int b, const IVec<Dim>& i) {
      const double v = std::abs(face_of(f, axis, b, i));
      if (!(v <= value)) value = v;
    });
  return value;
}

}  // namespace seaway::flow::testing
