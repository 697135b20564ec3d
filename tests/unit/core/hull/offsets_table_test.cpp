#include "core/hull/offsets_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "core/base/error.hpp"

namespace seaway::hull {
namespace {

using ::testing::HasSubstr;

class OffsetsFile : public ::testing::Test {
 protected:
  void TearDown() override { std::remove(file_.c_str()); }
  const std::string& write(const std::string& text) {
    std::ofstream(file_) << text;
    return file_;
  }
  std::string message_of(const std::string& text) {
    try {
      (void)read_offsets_table(write(text));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::string file_ = ::testing::TempDir() + "seaway_offsets_test.csv";
};

TEST_F(OffsetsFile, InterpolatesBetweenStations) {
  const auto table = read_offsets_table(write("# note\nx,0,1,2\n0,,1,2\n10,0.5,3,4\n"));
  const auto half = half_section_at(table, 5.0);
  ASSERT_EQ(half.size(), 2u);  // z = 0 is blank at one of the stations
  EXPECT_EQ(half[0], (std::pair{1.0, 2.0}));
  EXPECT_EQ(half[1], (std::pair{2.0, 3.0}));
  EXPECT_EQ(half_section_at(table, 10.0).size(), 3u);
}

TEST_F(OffsetsFile, KeelAndDeckCloseTheSection) {
  const auto table =
      read_offsets_table(write("x,0.1,1,2,keel_z,deck_z,deck_y\n0,1,2,3,0.05,2.5,3.5\n"));
  const auto half = half_section_at(table, 0.0);
  ASSERT_EQ(half.size(), 5u);
  EXPECT_EQ(half.front(), (std::pair{0.05, 0.0}));
  EXPECT_EQ(half.back(), (std::pair{2.5, 3.5}));
}

TEST_F(OffsetsFile, MalformedTablesAreNamedByLine) {
  EXPECT_THAT(message_of("x,0,1\n0,1,abc\n"), HasSubstr(":2: cell 3 is 'abc'"));
  EXPECT_THAT(message_of("x,0,1\n0,1,nan\n"), HasSubstr("cell 3 is 'nan'"));
  EXPECT_THAT(message_of("x,0,1\n0,1\n"), HasSubstr(":2: 2 cells where the head has 3"));
  EXPECT_THAT(message_of("x,1,0\n0,1,1\n"), HasSubstr("does not rise"));
  EXPECT_THAT(message_of("x,0,1\n5,1,1\n0,1,1\n"), HasSubstr(":3: station x = 0"));
  EXPECT_THAT(message_of("x,0,1\n0,-1,1\n"), HasSubstr("negative"));
  EXPECT_THAT(message_of("x,0,height\n0,1,1\n"), HasSubstr("headed 'height'"));
  EXPECT_THAT(message_of("x,0,1\n"), HasSubstr("no stations"));
  EXPECT_THAT(message_of("x,0\n0,1\n"), HasSubstr("at least 2"));
}

TEST_F(OffsetsFile, MissingFileIsNotFound) {
  try {
    (void)read_offsets_table("does_not_exist.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    EXPECT_THAT(error.what(), HasSubstr("does_not_exist.csv"));
  }
}

TEST_F(OffsetsFile, BadStationsAreRefused) {
  const auto table = read_offsets_table(write("x,0,1,2\n0,1,,2\n10,,,1\n"));
  EXPECT_THROW(half_section_at(table, 11.0), Error);  // outside
  EXPECT_THROW(half_section_at(table, 0.0), Error);   // gap
  EXPECT_THROW(half_section_at(table, 10.0), Error);  // one point
}

}  // namespace
}  // namespace seaway::hull
