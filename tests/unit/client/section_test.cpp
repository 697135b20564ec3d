// SPDX-License-Identifier: GPL-3.0-or-later
#include "client/plot/section.hpp"

#include <gtest/gtest.h>

#include "client/job_client.hpp"
#include "client/plot/gnuplot.hpp"
#include "proto/text.hpp"

namespace seaway::client {
namespace {

double area(const Loop& loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point& a = loop[i];
    const Point& b = loop[(i + 1) % loop.size()];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return 0.5 * twice;
}

TEST(Section, ReadsTheArtifact) {
  const Section s = parse_section(
      R"({"time_s":1.5,"bounds":{"y":[-1,1],"z":[-0.5,0.5]},"surface":[[[0,0],[1,0]]],"hull":[[[0,0],[1,0],[1,1]]]})");
  EXPECT_EQ(s.time_s, 1.5);
  EXPECT_EQ(s.surface.at(0).at(1)[0], 1);
  EXPECT_TRUE(s.water.empty());
  EXPECT_THROW(parse_section("{}"), ClientError);
  EXPECT_THROW(parse_section("no json"), ClientError);
}

TEST(Section, HolesStayOpen) {
  const Loop outer{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const Loop hole{{1, 1}, {1, 2}, {2, 2}, {2, 1}};  // the other way round
  const auto loops = open_holes({hole, outer});
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_DOUBLE_EQ(area(loops[0]), 15);
}

TEST(Gnuplot, TextCannotLeaveItsQuotes) {
  EXPECT_EQ(gnuplot_text("it's\n!ls"), "it''s !ls");
}

TEST(RequestId, IsAUuid) {
  const std::string id = new_request_id();
  EXPECT_EQ(id.size(), 36u);
  EXPECT_EQ(id[14], '4');
  EXPECT_NE(id, new_request_id());
}

}  // namespace
}  // namespace seaway::client
