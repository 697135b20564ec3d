#include "core/hull/ship_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/hull/boolean3.hpp"
#include "core/hull/section_hull.hpp"
#include "core/hull/spaced_patch.hpp"
#include "core/hull/surface_hull.hpp"
#include "core/hull/surface_shapes.hpp"
#include "tests/unit/core/hull/example_section.hpp"

namespace seaway::hull {
namespace {

/// Barge 2 x 0.4 x 0.3 m with one compartment amidships behind walls of 10 mm, open to port.
ShipSpec barge() {
  ShipSpec spec;
  spec.length = 2;
  spec.beam = 0.4;
  spec.height = 0.3;
  ShipCompartmentSpec c;
  c.name = "hold";
  c.box = {{-0.3, -0.3, 0.0}, {0.3, 0.3, 0.25}};
  c.wall_thickness = 0.01;
  c.openings = {{"hole", {{-0.05, 0.18, 0.05}, {0.05, 0.22, 0.15}}}};
  spec.compartments = {c};
  return spec;
}

ShipSpec dtmb5415() {
  ShipSpec spec;
  spec.shape = ShipSpec::Shape::offsets;
  spec.file = SEAWAY_EXAMPLES "/dtmb5415_offsets.csv";
  spec.scale = 51;
  spec.amidships = 71;
  return spec;
}

TEST(Boolean3, VolumesOfBoxes) {
  const Surface a = surface_of({{0, 0, 0}, {1, 1, 1}}), b = surface_of({{0.5, 0, 0.25}, {2, 1, 2}});
  EXPECT_NEAR(enclosed_volume(intersect(a, b)), 0.375, 1e-15);
  EXPECT_NEAR(enclosed_volume(subtract(a, b)), 0.625, 1e-15);
  EXPECT_NEAR(enclosed_volume(unite(a, b)), 1 + 1.5 * 1.75 - 0.375, 1e-14);
  EXPECT_TRUE(intersect(a, surface_of({{3, 0, 0}, {4, 1, 1}})).triangles.empty());
  EXPECT_TRUE(find_surface_problems(subtract(a, b)).empty());
  const Surface shell = subtract(a, surface_of({{0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}}));
  EXPECT_NEAR(enclosed_volume(shell), 1 - 0.512, 1e-15);
}

TEST(Boolean3, CrossingIsFound) {
  EXPECT_FALSE(first_crossing(box_surface(1, 1, 1)));
  const Surface two = joined(
      box_surface(1, 1, 1),
      transformed(box_surface(1, 1, 1), 1, Eigen::Matrix3d::Identity(), Vec3(0.5, 0.2, 0.1)));
  EXPECT_TRUE(first_crossing(two));
}

TEST(ShipShape, BargeWithHold) {
  const Ship ship = build_ship(barge());
  ASSERT_EQ(ship.compartments.size(), 1u);
  EXPECT_NEAR(ship.compartments[0].volume, 0.6 * 0.38 * 0.24, 1e-14);
  ASSERT_EQ(ship.solid.size(), 1u);
  EXPECT_NEAR(enclosed_volume(ship.solid[0].surface), 0.24 - 0.6 * 0.38 * 0.24 - 0.1 * 0.01 * 0.1,
              1e-14);
  EXPECT_TRUE(find_surface_problems(ship.solid[0].surface).empty());
  const Solid closed = buoyant_surfaces(ship, {false});
  EXPECT_NEAR(enclosed_volume(closed[0].surface), 0.24, 1e-14);
}

TEST(ShipShape, PorousSpaceKeepsItsSolidPart) {
  ShipSpec spec = barge();
  spec.compartments[0].permeability = 0.9;
  const Ship ship = build_ship(spec);
  ASSERT_EQ(ship.solid.size(), 2u);
  EXPECT_NEAR(ship.solid[1].weight, 0.1, 1e-15);
}

TEST(ShipShape, ShrinkingMovesFacetsByTheThickness) {
  const Box<3> all{{-5, -5, -5}, {5, 5, 5}};
  const Surface box = shrunk_within(box_surface(2, 0.4, 0.3), all, 0.02);
  EXPECT_NEAR(enclosed_volume(box), 1.96 * 0.36 * 0.26, 1e-14);
  const Surface sphere = shrunk_within(sphere_surface(0.5, 48), all, 0.05);
  double worst = 0;
  for (const Vec3& x : sphere.vertices)
    worst = std::max(worst, std::abs((x - Vec3(0, 0, 0.5)).norm() - 0.45));
  EXPECT_LT(worst, 1e-3);
  // Outside of the box nothing moves.
  const Surface part = shrunk_within(sphere_surface(0.5, 48), {{0.3, -1, 0}, {1, 1, 1}}, 0.05);
  EXPECT_NEAR(bounds_of(part).lower.x(), bounds_of(sphere_surface(0.5, 48)).lower.x(), 1e-15);
}

TEST(ShipShape, Dtmb5415WithTwoCompartments) {
  ShipSpec spec = dtmb5415();
  for (int i = 0; i < 2; ++i) {
    ShipCompartmentSpec c;
    c.name = i == 0 ? "aft" : "fore";
    c.box = {{-0.36 + 0.245 * i, -0.3, -0.05}, {-0.12 + 0.245 * i, 0.3, 0.19}};
    c.wall_thickness = 0.004;
    c.openings = {{"hole", {{-0.27 + 0.245 * i, 0.15, 0.1}, {-0.21 + 0.245 * i, 0.25, 0.14}}}};
    spec.compartments.push_back(c);
  }
  const Ship ship = build_ship(spec);
  for (const auto& c : ship.compartments) {
    EXPECT_TRUE(find_surface_problems(c.space).empty());
    // Full-breadth block of the hull less its shell: 24.36 m amidships hold 2717 to 2893 m3 below
    // 7.41 m at full scale (see the header of the table), that is 0.0105 m3 each at 1:51.
    EXPECT_GT(c.volume, 0.010);
    EXPECT_LT(c.volume, 0.020);
  }
  ASSERT_EQ(ship.solid.size(), 1u);
  EXPECT_TRUE(find_surface_problems(ship.solid[0].surface).empty());
  EXPECT_FALSE(first_crossing(ship.solid[0].surface));
  const double walls = enclosed_volume(ship.solid[0].surface), all = enclosed_volume(ship.outer);
  const double holes = all - walls - ship.compartments[0].volume - ship.compartments[1].volume;
  EXPECT_NEAR(holes, 2 * 0.06 * 0.04 * 0.004, 4e-6);
}

std::vector<ShapeProblem> problems_of(const ShipSpec& spec) {
  return find_compartment_problems(spec, outer_surface(spec));
}

TEST(ShipShape, BadCompartmentsAreNamed) {
  ShipSpec spec = barge();
  EXPECT_TRUE(problems_of(spec).empty());
  spec.compartments[0].box.lower.x() = 3;
  ASSERT_EQ(problems_of(spec).size(), 1u);
  EXPECT_EQ(problems_of(spec)[0].where, "compartments[0].x");
  spec = barge();
  spec.compartments[0].box = {{1.2, -1, 0}, {1.5, 1, 1}};
  EXPECT_EQ(problems_of(spec).at(0).where, "compartments[0]");
  spec = barge();
  spec.compartments[0].openings[0].box = {{0.5, 0.1, 0.1}, {0.6, 0.15, 0.15}};
  EXPECT_EQ(problems_of(spec).at(0).where, "compartments[0].openings[0]");
  spec = barge();
  spec.compartments[0].openings[0].box = {{-0.02, -0.02, 0.1}, {0.02, 0.02, 0.15}};
  EXPECT_NE(problems_of(spec).at(0).message.find("touches no wall"), std::string::npos);
  spec = barge();
  spec.compartments[0].wall_thickness = 0.21;
  EXPECT_FALSE(problems_of(spec).empty());
  spec = barge();
  spec.compartments.push_back(spec.compartments[0]);
  EXPECT_NE(problems_of(spec).at(0).message.find("overlaps"), std::string::npos);
  EXPECT_THROW(build_ship(spec), Error);
}

OrientedBox<3> block_of(const OrientedBox<3>& cv) {
  OrientedBox<3> block = cv;
  block.half *= 5;
  return block;
}

TEST(SpacedPatch, SpacesAndWallsFillEveryControlVolume) {
  ShipSpec spec = barge();
  spec.compartments[0].permeability = 0.8;
  const SurfaceHull hull(build_ship(spec), 0.02, 0.1, 0.03);
  EXPECT_EQ(hull.n_compartments(), 1);
  EXPECT_TRUE(hull.has_porous_space());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    OrientedBox<3> cv;
    cv.centre = {0.35 * any(random), 0.22 * any(random), 0.14 + 0.16 * any(random)};
    cv.half = {0.02, 0.015, 0.018};
    cv.axes = Eigen::AngleAxisd(any(random), Vec3(any(random), any(random), 1).normalized())
                  .toRotationMatrix();
    const auto patch = hull.patch(block_of(cv));
    const double full = 8 * cv.half.prod();
    const auto solid = patch->solid_part(cv);
    const auto sea = patch->outside_space(cv, 0), hold = patch->outside_space(cv, 1);
    // Sea + hold + solid = all.
    EXPECT_NEAR((full - sea.volume) + (full - hold.volume) + solid.volume, full, 1e-17);
    const Vec3 centre = full * cv.centre;
    EXPECT_NEAR(((centre - sea.moment) + (centre - hold.moment) + solid.moment - centre).norm(), 0,
                1e-17);
    HalfSpace<3> water{Vec3(any(random), any(random), any(random)), 0};
    water.d = water.normal.dot(cv.centre) + 0.01 * any(random);
    const double below = box_volume_below(cv, water);
    EXPECT_NEAR(2 * below - patch->outside_space_below(cv, water, 0) -
                    patch->outside_space_below(cv, water, 1) + patch->solid_volume_below(cv, water),
                below, 1e-16);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(2 - patch->outside_space_face_fraction(cv, axis, true, 0) -
                      patch->outside_space_face_fraction(cv, axis, true, 1) +
                      patch->solid_face_fraction(cv, axis, true),
                  1, 1e-10);
  }
}

TEST(SpacedPatch, ThinWallsSeparateSpaces) {
  ShipSpec spec = barge();
  spec.compartments[0].wall_thickness = 0.001;
  const SurfaceHull hull(build_ship(spec), 0.02, 0.1, 0.02);
  OrientedBox<3> cv{{0.2, 0.2, 0.1}, {0.01, 0.01, 0.01}, Eigen::Matrix3d::Identity()};
  const auto patch = hull.patch(block_of(cv));
  EXPECT_NEAR(patch->outside_space(cv, 0).volume, 4e-6, 1e-15);
  EXPECT_NEAR(patch->outside_space(cv, 1).volume, 4.4e-6, 1e-15);
  EXPECT_NEAR(patch->outside_space_face_fraction(cv, 1, true, 0), 0, 1e-12);
  EXPECT_NEAR(patch->outside_space_face_fraction(cv, 1, true, 1), 1, 1e-12);
  EXPECT_NEAR(patch->outside_space_face_fraction(cv, 1, false, 0), 1, 1e-12);
  EXPECT_NEAR(patch->outside_space_face_fraction(cv, 1, false, 1), 0, 1e-12);
  EXPECT_EQ(hull.space_near({0.2, 0.2005, 0.1}), 0);
  EXPECT_EQ(hull.space_near({0.2, 0.1998, 0.1}), 0);
  EXPECT_EQ(hull.space_near({0.2, 0.1992, 0.1}), 1);
  EXPECT_EQ(hull.space_near({0.2, 0.1, 0.1}), 1);
  EXPECT_EQ(hull.space_near({0.0, 0.2, 0.1}), -1);
  EXPECT_EQ(hull.compartment_at({0.2, 0.1, 0.1}), 0);
  EXPECT_EQ(hull.compartment_at({0.2, 0.1995, 0.1}), -1);
}

TEST(SpaceMap, KeepsCellsOfOneSpaceAndLeavesTheOthersOpen) {
  int asked = 0;
  const Box<3> box{Vec3(-0.1, -0.1, -0.1), Vec3(0.3, 0.2, 0.1)};
  const auto by_plane = [&](const Vec3& x, double radius) {  // 1 above y = 0.03
    ++asked;
    return std::abs(x.y() - 0.03) <= radius ? SpaceMap::unknown : x.y() > 0.03 ? 1 : 0;
  };
  const SpaceMap map(box, 0.01, by_plane);
  EXPECT_EQ(map.at({0.29, 0.19, 0.09}), 1);
  EXPECT_EQ(map.at({0.0, 0.06, 0.0}), 1);
  EXPECT_EQ(map.at({0.0, -0.01, 0.0}), 0);
  EXPECT_EQ(map.at({0.0, 0.031, 0.0}), SpaceMap::unknown);
  EXPECT_EQ(map.at({0.0, 0.21, 0.0}), SpaceMap::unknown);
  EXPECT_LT(asked, 40 * 30 * 20 / 2);  // not cell by cell
}

TEST(SpaceMap, AnswersOfAHullDoNotDependOnIt) {
  ShipSpec spec = barge();
  spec.compartments[0].wall_thickness = 0.004;
  // The map of the second hull has other cells: points near walls in one lie in plain cells of the other.
  const SurfaceHull coarse(build_ship(spec), 0.05, 0.1, 0.02), fine(build_ship(spec), 0.0125, 0.1, 0.02);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  const Box<3> around = coarse.compartment_bounds();
  const Vec3 middle = 0.5 * (around.lower + around.upper), half = 0.6 * (around.upper - around.lower);
  std::array<int, 3> seen{};
  for (int trial = 0; trial < 20000; ++trial) {
    const Vec3 x = middle + half.cwiseProduct(Vec3(any(random), any(random), any(random)));
    const int space = coarse.space_near(x);
    ASSERT_EQ(space, fine.space_near(x)) << x.transpose();
    if (coarse.compartment_at(x) >= 0 && space >= 0) {
      ASSERT_EQ(space, 1 + coarse.compartment_at(x)) << x.transpose();
    }
    ++seen[static_cast<std::size_t>(space + 1)];
  }
  for (const int count : seen) EXPECT_GT(count, 10);
}

TEST(SpacedPatch, OpeningsReachOutAlongTheirThinDirection) {
  const SurfaceHull hull(build_ship(barge()), 0.02, 0.1, 0.05);
  // Box 0.1 x 0.04 x 0.1 at y = 0.18 to 0.22, extended to 0.13 .. 0.27.
  OrientedBox<3> cv{{0.0, 0.27, 0.1}, {0.01, 0.01, 0.01}, Eigen::Matrix3d::Identity()};
  EXPECT_NEAR(hull.patch(block_of(cv))->opening_part(cv).volume, 4e-6, 1e-16);
  cv.centre = {0.05, 0.15, 0.1};
  EXPECT_NEAR(hull.patch(block_of(cv))->opening_part(cv).volume, 4e-6, 1e-16);
  cv.centre = {0.2, 0.2, 0.1};
  EXPECT_EQ(hull.patch(block_of(cv))->opening_part(cv).volume, 0);
}

TEST(SpacedPatch, SectionsAnswerTheSameQuestions) {
  const SectionHull hull(build_section(damaged_midship()), 0.0025, 0.25, 0.02);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  int n_near = 0;
  for (int trial = 0; trial < 300; ++trial) {
    OrientedBox<2> cv;
    cv.centre = {0.22 * any(random), 0.14 + 0.15 * any(random)};
    cv.half = {0.004, 0.003};
    const double angle = any(random);
    cv.axes << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const auto patch = hull.patch({cv.centre, Vec2::Constant(0.03), cv.axes});
    const double full = 4 * cv.half.prod();
    double sum = patch->solid_part(cv).volume, fractions = patch->solid_face_fraction(cv, 1, false);
    HalfSpace<2> water{{any(random), any(random)}, 0};
    water.d = water.normal.dot(cv.centre) + 0.001 * any(random);
    const double below = box_volume_below(cv, water);
    double sum_below = patch->solid_volume_below(cv, water);
    for (int space = 0; space <= hull.n_compartments(); ++space) {
      sum += full - patch->outside_space(cv, space).volume;
      fractions += 1 - patch->outside_space_face_fraction(cv, 1, false, space);
      sum_below += below - patch->outside_space_below(cv, water, space);
    }
    EXPECT_NEAR(sum, full, 1e-13);  // the polygons' raster is 1e-9 m
    EXPECT_NEAR(fractions, 1, 1e-6);
    EXPECT_NEAR(sum_below, below, 1e-13);
    const int space = hull.space_near(cv.centre);
    if (space >= 0 && hull.compartment_at(cv.centre) >= 0) {
      EXPECT_EQ(space, 1 + hull.compartment_at(cv.centre));
      ++n_near;
    }
  }
  EXPECT_GT(n_near, 10);
}

TEST(BoxVolumeBelow, MatchesSimpleCases) {
  const OrientedBox<3> cv{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, Eigen::Matrix3d::Identity()};
  EXPECT_NEAR(box_volume_below<3>(cv, {{1, 1, 1}, 0.5}), 0.125 / 6, 1e-16);
  EXPECT_NEAR(box_volume_below<3>(cv, {{1, 1, 1}, 1.5}), 0.5, 1e-15);
  EXPECT_NEAR(box_volume_below<3>(cv, {{-1, -1, -1}, -2.5}), 0.125 / 6, 1e-16);
  EXPECT_NEAR(box_volume_below<3>(cv, {{0, 2, 0}, 0.5}), 0.25, 1e-16);
  EXPECT_NEAR(box_volume_below<3>(cv, {{1e-13, 2, 1e-9}, 0.5}), 0.25, 1e-9);
  EXPECT_NEAR(box_volume_below<3>(cv, {{1, 1, 0}, 0.5}), 0.125, 1e-16);
  EXPECT_EQ(box_volume_below<3>(cv, {{1, 1, 0}, -0.5}), 0);
  EXPECT_NEAR(box_volume_below<3>(cv, {{1, 1, 0}, 3}), 1, 1e-15);
}

}  // namespace
}  // namespace seaway::hull
