// The slip flux: a flow that only slides along an oblique wall is solenoidal, water at rest stays at rest.
#include "core/flow/slip_flux.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/flow/barges.hpp"

namespace seaway::flow {
namespace {

using namespace testing;

/// Rises one cell in two: apertures and open parts of the faces differ most.
const double heel = std::atan(0.5);

/// Largest flux out of a cell at the middle of the barge's bottom, over face area and speed, for a uniform flow of 1 m/s
/// along it and a hull that moves with `twist` (the flow with it).
double out_of_cells_at_bottom(bool with_slip, const motion::Twist<2>& twist) {
  const BargeTank tank(3, 0.22);
  const auto pose = BargeTank::afloat(heel);
  const HullMask<2> mask = tank.mask_at(pose);
  const Vec2 along(std::cos(heel), std::sin(heel)), down(std::sin(heel), -std::cos(heel));
  FlowState<2> state(tank.forest);
  fill_water<2>(tank.forest, [](const Vec2&) { return 1.0; }, state);
  fill_faces<2>(tank.forest, [&](const Vec2&, int axis) { return along[axis] + twist[axis]; }, state.u);
  SlipFlux<2> slip(tank.fluids);
  slip.find(mask, state, twist, 0.0);
  const Projection<2> projection(tank.forest, tank.fluids, tank.boundaries);
  projection.mixture_velocity(state, &mask, twist, with_slip ? &slip : nullptr);
  std::array<std::vector<double>, 2> w;
  for (int a = 0; a < 2; ++a) mask.window().load_faces(state.w, a, w[static_cast<std::size_t>(a)]);
  double worst = 0;
  int cut = 0;
  mask.window().for_cells([&](const IVec<2>& i) {
    const auto at = static_cast<std::size_t>(mask.window().at(i));
    const Vec2 x = mask.window().cell_centre(i) - pose.cog;
    if (std::abs(x.dot(along)) > 0.08 || x.dot(down) < 0.03 || std::abs(mask.half().phi[at]) > 0.005) return;
    double out = 0;
    for (int a = 0; a < 2; ++a) {
      const auto& f = w[static_cast<std::size_t>(a)];
      out += f[at + static_cast<std::size_t>(mask.window().stride(a))] - f[at];
    }
    worst = std::max(worst, std::abs(out));
    ++cut;
  });
  EXPECT_GT(cut, 40);
  return worst;
}

TEST(SlipFlux, AFlowAlongAnObliqueWallIsSolenoidal) {
  motion::Twist<2> still = motion::Twist<2>::Zero(), drifting = still;
  drifting.head<2>() << 0.3, -0.2;
  for (const auto& twist : {still, drifting}) {
    EXPECT_GT(out_of_cells_at_bottom(false, twist), 0.03) << "apertures alone";
    EXPECT_LT(out_of_cells_at_bottom(true, twist), 1e-6);
  }
}

// All faces are kicked by gravity; the pressure that holds the water takes it back.
TEST(SlipFlux, IsNothingForWaterAtRest) {
  const BargeTank tank(3, 0.22);
  const HullMask<2> mask = tank.mask_at(BargeTank::afloat(heel));
  FlowState<2> state(tank.forest);
  fill_water<2>(tank.forest, [](const Vec2&) { return 1.0; }, state);
  const double dt = 0.008;
  each_cell<2>(tank.forest, [&](int b, const IVec<2>& i) {
    state.p.block(b)[field::offset<2>(i, field::cell_strides<2>())] =
        -tank.fluids.rho_water * tank.fluids.gravity * tank.forest.block(b).cell_centre(i)[1];
  });
  fill_faces<2>(tank.forest, [&](const Vec2&, int axis) { return axis == 1 ? -tank.fluids.gravity * dt : 0.0; }, state.u);
  SlipFlux<2> slip(tank.fluids);
  slip.find(mask, state, motion::Twist<2>::Zero(), dt);
  for (int axis = 0; axis < 2; ++axis)
    for (const double flux : slip.through(axis)) ASSERT_LT(std::abs(flux), 1e-12);
}

// At the corners of the barge "along the wall" has no meaning.
TEST(SlipFlux, LeavesEdgesAlone) {
  const BargeTank tank(3, 0.22);
  const auto pose = BargeTank::afloat(heel);
  const HullMask<2> mask = tank.mask_at(pose);
  FlowState<2> state(tank.forest);
  fill_water<2>(tank.forest, [](const Vec2&) { return 1.0; }, state);
  fill_faces<2>(tank.forest, [](const Vec2&, int) { return 1.0; }, state.u);
  SlipFlux<2> slip(tank.fluids);
  slip.find(mask, state, motion::Twist<2>::Zero(), 0.0);
  bool any = false;
  for (int axis = 0; axis < 2; ++axis)
    mask.window().for_faces(axis, [&](const IVec<2>& i) {
      const double flux = slip.through(axis)[static_cast<std::size_t>(mask.window().at(i))];
      any = any || flux != 0;
      const Vec2 x = motion::earth_to_hull<2>(tank.body, pose, mask.window().face_centre(i, axis));
      const Vec2 from_corner(0.5 * beam - std::abs(x[0]), 0.5 * height - std::abs(x[1] - 0.5 * height));
      if (from_corner.cwiseAbs().maxCoeff() >= 0.5 * mask.window().h()[0]) return;
      ASSERT_EQ(flux, 0) << x.transpose();
    });
  EXPECT_TRUE(any);
}

}  // namespace
}  // namespace seaway::flow
