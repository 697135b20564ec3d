#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/hull/surface_hull.hpp"
#include "core/hull/surface_patch.hpp"
#include "core/hull/surface_shapes.hpp"

namespace seaway::hull {
namespace {

OffsetsTable dtmb5415() { return read_offsets_table(SEAWAY_EXAMPLES "/dtmb5415_offsets.csv"); }

const Surface& full_scale() {
  static const Surface s = [] {
    OffsetsHullSpec spec;
    spec.origin = 71;
    return offsets_surface(dtmb5415(), spec);
  }();
  return s;
}

/// Displacement and the integral of x over it at a draft.
SolidPart<3> immersed(const Surface& s, double draft) {
  const std::vector<std::shared_ptr<const SurfaceTree>> solids{std::make_shared<SurfaceTree>(s)};
  OrientedBox<3> below{{0, 0, draft - 50}, {200, 50, 50}, Eigen::Matrix3d::Identity()};
  return SurfacePatch(solids, below, nullptr, false).solid_part(below);
}

TEST(OffsetsSurface, Dtmb5415IsClosedAndHasItsSize) {
  const Surface& s = full_scale();
  EXPECT_TRUE(find_surface_problems(s).empty());
  EXPECT_GT(s.triangles.size(), 5000u);
  EXPECT_LT(s.triangles.size(), 30000u);
  const Box<3> box = bounds_of(s);
  EXPECT_NEAR(box.lower.x(), 0.55 - 71, 1e-9);
  EXPECT_NEAR(box.upper.x(), 150.5 - 71, 1e-9);
  EXPECT_NEAR(box.lower.z(), -3.0023, 1e-6);
}

// Targets: integrals of the same table by the trapezoid rule and published values, see
// client/examples/dtmb5415_offsets.csv; 8389 m3 from the table, 8424 m3 published.
TEST(OffsetsSurface, Dtmb5415DisplacesWhatItsTableSays) {
  const SolidPart<3> at_design = immersed(full_scale(), 6.15);
  EXPECT_NEAR(at_design.volume, 8389.1, 0.001 * 8389.1);
  EXPECT_NEAR(at_design.moment.x() / at_design.volume + 71, 70.307, 0.05);
  EXPECT_NEAR(at_design.moment.z() / at_design.volume, 3.667, 0.01);
  EXPECT_NEAR(at_design.moment.y() / at_design.volume, 0, 1e-9);
  EXPECT_NEAR(immersed(full_scale(), 5.5).volume, 7066.6, 0.001 * 7066.6);
  EXPECT_NEAR(immersed(full_scale(), 7.41).volume, 11102.5, 0.001 * 11102.5);
}

TEST(OffsetsSurface, NotchBetweenDomeAndStemStaysOpen) {
  const SurfaceTree tree(full_scale());
  const DistanceGrid grid(tree, 0.6, 1.0);
  EXPECT_LT(tree.distance({141.5 - 71, 0, -1.2}, 10), 1.5);
  // In front of the notch there is water, the dome below it reaches farther forward.
  const auto part = immersed(full_scale(), 3.0).volume - immersed(full_scale(), 2.2).volume;
  EXPECT_GT(part, 0);
  const OrientedBox<3> notch{{141.6 - 71, 0, 2.5}, {0.3, 0.5, 0.2}, Eigen::Matrix3d::Identity()};
  const OrientedBox<3> dome{{141.3 - 71, 0, -1.2}, {0.1, 0.5, 0.2}, Eigen::Matrix3d::Identity()};
  const std::vector<std::shared_ptr<const SurfaceTree>> solids{
      std::make_shared<SurfaceTree>(full_scale())};
  EXPECT_NEAR(SurfacePatch(solids, notch, nullptr, false).solid_part(notch).volume, 0, 1e-12);
  EXPECT_NEAR(SurfacePatch(solids, dome, nullptr, false).solid_part(dome).volume,
              8 * dome.half.prod(), 1e-12);
}

TEST(OffsetsSurface, ScaleShiftsAndExtensionAct) {
  OffsetsHullSpec spec;
  spec.scale = 51;
  spec.origin = 71;
  spec.extend_to = 0.35;
  const Surface s = offsets_surface(dtmb5415(), spec);
  EXPECT_TRUE(find_surface_problems(s).empty());
  EXPECT_NEAR(bounds_of(s).upper.z(), 0.35, 1e-12);
  EXPECT_NEAR(immersed(s, 6.15 / 51).volume * 51 * 51 * 51, 8389.1, 8.4);
  spec.extend_to = 0.25;
  EXPECT_THROW(offsets_surface(dtmb5415(), spec), Error);
}

TEST(OffsetsSurface, WallSidedTableGivesABox) {
  OffsetsTable t;
  t.waterlines = {0.0, 1.0, 2.0};
  for (const double x : {0.0, 5.0, 10.0}) {
    OffsetsTable::Station s;
    s.x = x;
    s.half_breadths = {2.0, 2.0, 2.0};
    t.stations.push_back(s);
  }
  OffsetsHullSpec spec;
  spec.n_girth = 8;
  const Surface s = offsets_surface(t, spec);
  EXPECT_NEAR(enclosed_volume(s), 80, 1e-9);
  t.stations.pop_back();
  t.stations.pop_back();
  EXPECT_THROW(offsets_surface(t, spec), Error);
}

TEST(OffsetsSurface, BadTablesHaveTheirMessage) {
  const auto problem = [](const OffsetsTable& t) -> std::string {
    try {
      offsets_surface(t, {});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  OffsetsTable t = dtmb5415();
  EXPECT_EQ(problem(t), "");
  for (auto& y : t.stations[20].half_breadths) y.reset();
  EXPECT_NE(problem(t).find("no half-breadths"), std::string::npos);
  t = dtmb5415();
  t.stations[20].half_breadths[20].reset();
  t.stations[20].half_breadths[25].reset();
  EXPECT_NE(problem(t).find("2 gaps"), std::string::npos);
  t = dtmb5415();
  t.stations[20].half_breadths[20].reset();  // a gap far from the notch
  EXPECT_NE(problem(t).find("only one notch"), std::string::npos);
  t.stations.clear();
  EXPECT_NE(problem(t).find("0 stations"), std::string::npos);
}

}  // namespace
}  // namespace seaway::hull
