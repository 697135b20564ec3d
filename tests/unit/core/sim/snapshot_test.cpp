#include "core/sim/snapshot.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/unit/core/sim/barge_case.hpp"

namespace seaway::sim {
namespace {

using namespace testing;
using nlohmann::json;
using ::seaway::testing::TempFolder;

TEST(Snapshot, HoldsTheSurfaceOutsideTheHullAndTheHullWhereItIs) {
  const TempFolder folder;
  Case c = barge(0.0125);
  c.tank.lower.z() = -0.41;  // the surface runs through cells
  c.tank.upper.z() = 0.39;
  c.body.angles = {5 * degree, 0, 0};
  const auto s = simulate(c);
  const std::string path = folder / "section.json";
  write_section(*s, 3, path);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  json j;
  std::ifstream(path) >> j;
  EXPECT_EQ(j.at("stage"), 3);
  EXPECT_EQ(j.at("time_s"), 0.0);
  EXPECT_EQ(j.at("bounds").at("y"), json({-0.8, 0.8}));
  EXPECT_EQ(j.at("bounds").at("z"), json({-0.41, 0.39}));
  double length = 0;
  for (const json& segment : j.at("surface")) {
    ASSERT_EQ(segment.size(), 2u);
    const double y0 = segment[0][0], z0 = segment[0][1], y1 = segment[1][0], z1 = segment[1][1];
    // Planes beside the hull lean a little: they see the values extended into it.
    EXPECT_NEAR(z0, 0, 0.1 * 0.0125);
    EXPECT_NEAR(z1, 0, 0.1 * 0.0125);
    length += std::abs(y1 - y0);
  }
  // The tank's breadth less the waterline of the barge, to a cell at either side.
  EXPECT_NEAR(length, 1.6 - 0.3 / std::cos(5 * degree), 0.025);
  ASSERT_EQ(j.at("hull").size(), 1u);
  const json& loop = j.at("hull")[0];
  double area = 0, y_mean = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const json &p = loop[i], &q = loop[(i + 1) % loop.size()];
    const double cross =
        p[0].get<double>() * q[1].get<double>() - q[0].get<double>() * p[1].get<double>();
    area += 0.5 * cross;
    y_mean += (p[0].get<double>() + q[0].get<double>()) * cross / 6;
  }
  EXPECT_NEAR(area, 0.03, 1e-12);
  EXPECT_NEAR(y_mean / area, 0, 1e-12);
}

TEST(Snapshot, SaysWhenItCannotBeWritten) {
  const auto s = simulate(barge(0.025));
  EXPECT_THROW(write_section(*s, 0, "/no/such/folder/section.json"), Error);
}

}  // namespace
}  // namespace seaway::sim
