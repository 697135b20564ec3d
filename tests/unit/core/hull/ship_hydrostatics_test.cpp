#include "core/hull/ship_hydrostatics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/constants.hpp"
#include "core/hull/ship_shape.hpp"
#include "core/hull/surface_shapes.hpp"

namespace seaway::hull {
namespace {

Solid solid(Surface s) { return {{std::move(s), 1.0}}; }

TEST(ShipHydrostatics, UprightBox) {
  const Solid box = solid(box_surface(2, 0.4, 0.3));
  const ShipHydrostatics h = hydrostatics(box, {0.1, 0, 0});
  EXPECT_NEAR(h.volume, 0.08, 1e-15);
  EXPECT_NEAR((h.buoyancy_centre - Vec3(0, 0, 0.05)).norm(), 0, 1e-15);
  EXPECT_NEAR(h.wetted_surface, 0.8 + 2 * 0.2 + 2 * 0.04, 1e-14);
  EXPECT_NEAR(h.waterplane_area, 0.8, 1e-15);
  EXPECT_NEAR(h.bm, 0.4 * 0.4 / 1.2, 1e-14);
  EXPECT_NEAR(h.bm_longitudinal, 4 / 1.2, 1e-13);
}

TEST(ShipHydrostatics, TurnedCylinderDoesNotChange) {
  const Solid c = solid(cylinder_surface(1.2, 0.2, 96));
  for (const double heel : {0.0, 0.3, 1.4, 3.0}) {
    // Axis at 0.2 above the keel; level through the axis.
    const ShipAttitude at{0.2 * std::cos(heel), heel, 0};
    const ShipHydrostatics h = hydrostatics(c, at);
    EXPECT_NEAR(h.volume, 0.5 * pi * 0.04 * 1.2, 1e-4 * h.volume);
    EXPECT_NEAR(metacentric_heights(h, at, {0, 0, 0.15}).transverse, 0.05 * std::cos(heel), 1e-3);
  }
}

TEST(ShipHydrostatics, LeverIsTheSlopeOfTheEnergy) {
  // d(lever)/d(heel) = GM at an upright symmetric ship, by finite differences.
  const Solid w = solid(wigley_surface(2, 0.2, 0.125, 0.2));
  const double volume = 0.02;
  const Vec3 cog(0, 0, 0.1);
  const auto upright = find_waterline(w, 0, 0, volume);
  ASSERT_TRUE(upright);
  const auto gm = metacentric_heights(hydrostatics(w, {*upright, 0, 0}), {*upright, 0, 0}, cog);
  const double d = 1e-4;
  const ShipAttitude heeled{*find_waterline(w, d, 0, volume), d, 0},
      trimmed{*find_waterline(w, 0, d, volume), 0, d};
  EXPECT_NEAR(hydrostatics(w, heeled).volume, volume, 1e-13);
  EXPECT_NEAR(levers(hydrostatics(w, heeled), heeled, cog).y() / d, -gm.transverse, 1e-6);
  EXPECT_NEAR(levers(hydrostatics(w, trimmed), trimmed, cog).x() / d, gm.longitudinal, 1e-5);
}

TEST(ShipHydrostatics, BoxFindsItsLevelTrimAndHeel) {
  const Solid box = solid(box_surface(2, 0.4, 0.3));
  // Weight off the middle: small angles heel = y / GM, trim = x / GM_L (a box of large freeboard).
  const auto e = find_equilibrium(box, 0.08, {0.002, -0.0005, 0.05}, true, true);
  ASSERT_TRUE(e.floats);
  ASSERT_TRUE(e.stable);
  EXPECT_NEAR(e.at.heel, 0.0005 / 0.13333, 2e-5);
  EXPECT_NEAR(e.at.trim, 0.002 / 3.3333, 1e-5);
  EXPECT_NEAR(levers(e.water, e.at, {0.002, -0.0005, 0.05}).head<2>().norm(), 0, 1e-9);
  EXPECT_FALSE(find_equilibrium(box, 0.3, {0, 0, 0.05}, true, true).floats);
}

TEST(ShipHydrostatics, RightingCurveOfBoxIsWallSided) {
  const Solid box = solid(box_surface(2, 0.4, 0.3));
  const double bm = 2 * 0.4 * 0.4 * 0.4 / 12 / 0.12, gm = 0.075 + bm - 0.12;  // draft 0.15
  const auto curve = righting_curve(box, 0.12, {0, 0, 0.12}, {0.1, 0.2, 0.3}, true);
  ASSERT_EQ(curve.size(), 3u);
  for (const auto& [heel, gz] : curve) {
    const double t = std::tan(heel);
    EXPECT_NEAR(gz, std::sin(heel) * (gm + 0.5 * bm * t * t), 1e-12);
  }
}

TEST(ShipHydrostatics, OpenHoldIsLostBuoyancy) {
  ShipSpec spec;
  spec.length = 2;
  spec.beam = 0.4;
  spec.height = 0.3;
  spec.compartments = {{"hold", {{-0.3, -0.5, -0.1}, {0.3, 0.5, 0.5}}, 0, 1, {}}};
  const Ship ship = build_ship(spec);
  const auto e = find_equilibrium(ship.solid, 0.08, {0, 0, 0.05}, true, true);
  ASSERT_TRUE(e.stable);
  EXPECT_NEAR(e.at.waterline, 0.08 / (1.4 * 0.4), 1e-12);  // two boxes of 0.7 m carry it
  EXPECT_NEAR(e.gm.transverse, 0.5 * e.at.waterline + 1.4 * 0.4 * 0.4 * 0.4 / 12 / 0.08 - 0.05,
              1e-9);
}

class Dtmb5415 : public ::testing::Test {
 protected:
  static const Solid& hull() {
    static const Solid s = [] {
      OffsetsHullSpec spec;
      spec.origin = 71;
      return solid(
          offsets_surface(read_offsets_table(SEAWAY_EXAMPLES "/dtmb5415_offsets.csv"), spec));
    }();
    return s;
  }
};

// Trapezoid integrals of the same table at full scale; LCB and LCF from the aft perpendicular.
struct Reference {
  double draft, volume, lcb, kb, awp, lcf, bm, bml;
};
constexpr Reference references[] = {
    {5.5, 7066.6353, 71.3461, 3.2615, 1978.2354, 65.3169, 6.2668, 312.5041},
    {6.15, 8389.1142, 70.3073, 3.6670, 2091.2827, 64.2161, 5.8583, 297.0592},
    {6.5, 9125.4948, 69.8308, 3.8816, 2122.8693, 64.3976, 5.6048, 279.2714},
    {7.41, 11102.5215, 68.8364, 4.4295, 2208.1566, 64.4740, 5.0159, 247.2227}};

TEST_F(Dtmb5415, MatchesTheIntegralsOfItsTable) {
  for (const Reference& r : references) {
    const ShipHydrostatics h = hydrostatics(hull(), {r.draft, 0, 0});
    EXPECT_NEAR(h.volume, r.volume, 1e-3 * r.volume) << r.draft;
    EXPECT_NEAR(h.buoyancy_centre.x() + 71, r.lcb, 0.05) << r.draft;
    EXPECT_NEAR(h.buoyancy_centre.z(), r.kb, 0.01) << r.draft;
    EXPECT_NEAR(h.waterplane_area, r.awp, 0.005 * r.awp) << r.draft;
    EXPECT_NEAR(h.waterplane_centre.x() + 71, r.lcf, 0.25) << r.draft;
    EXPECT_NEAR(h.bm, r.bm, 0.005 * r.bm) << r.draft;
    EXPECT_NEAR(h.bm_longitudinal, r.bml, 0.015 * r.bml) << r.draft;
  }
}

// Published (SIMMAN 2008): 2972.6 m2; a public STL of the hull: 2985 m2.
TEST_F(Dtmb5415, WettedSurfaceNearThePublishedOne) {
  EXPECT_NEAR(hydrostatics(hull(), {6.15, 0, 0}).wetted_surface, 2979, 0.01 * 2979);
}

TEST_F(Dtmb5415, FloatsUprightAtItsDraft) {
  const ShipHydrostatics h = hydrostatics(hull(), {6.15, 0, 0});
  const auto e = find_equilibrium(hull(), h.volume, {h.buoyancy_centre.x(), 0, 7.555}, true, true);
  ASSERT_TRUE(e.stable);
  EXPECT_NEAR(e.at.waterline, 6.15, 1e-6);
  EXPECT_NEAR(e.at.heel, 0, 1e-9);
  EXPECT_NEAR(e.at.trim, 0, 1e-8);
  EXPECT_NEAR(e.gm.transverse, 1.95, 0.05);  // published GM 1.95 with KG 7.555
}

}  // namespace
}  // namespace seaway::hull
