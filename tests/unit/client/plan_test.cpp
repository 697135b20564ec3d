// SPDX-License-Identifier: GPL-3.0-or-later
#include "client/plot/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "client/job_client.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::client {
namespace {

const char* const two_by_three =
    R"({"time_s":2.5,"stage":1,"x":{"first":-1,"step":2,"count":2},"y":{"first":0,"step":0.5,"count":3},
        "elevation_mm":[[1,2],[null,4],[5,6]],"waterline":[[[0,0],[1,0],[1,1]]]})";

TEST(Plan, ReadsTheArtifact) {
  const Plan p = parse_plan(two_by_three);
  EXPECT_EQ(p.time_s, 2.5);
  EXPECT_EQ(p.elevation_mm.at(3), 4);
  EXPECT_TRUE(std::isnan(p.elevation_mm.at(2)));
  EXPECT_EQ(p.x_bounds()[0], -2);
  EXPECT_EQ(p.y_bounds()[1], 1.25);
  EXPECT_EQ(p.waterline.at(0).size(), 3U);
}

TEST(Plan, RefusesWhatIsNone) {
  EXPECT_THROW(parse_plan("{}"), ClientError);
  std::string short_row = two_by_three;
  short_row.replace(short_row.find("[5,6]"), 5, "[5]");
  EXPECT_THROW(parse_plan(short_row), ClientError);
}

TEST(Plan, GridHasARowForEachY) {
  EXPECT_EQ(to_grid(parse_plan(two_by_three)),
            "-1 0 1\n1 0 2\n\n-1 0.5 NaN\n1 0.5 4\n\n-1 1 5\n1 1 6\n\n");
}

// Squares under the hull once made gnuplot refuse the whole grid.
TEST(Plan, IsDrawnWithSquaresUnderTheHull) {
  const testing::TempFolder folder;
  const std::string picture = folder / "plan.png";
  draw_plans({parse_plan(two_by_three), parse_plan(two_by_three)}, "a ship's title", picture);
  std::ifstream file(picture, std::ios::binary);
  std::string head(4, '\0');
  file.read(head.data(), 4);
  EXPECT_EQ(head, "\x89PNG");
}

}  // namespace
}  // namespace seaway::client
