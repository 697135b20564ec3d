// Records of cases in a folder: only those of the same code and input count as finished.
#include "tests/validation/report/kept_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"

namespace seaway::validation {
namespace {

namespace fs = std::filesystem;

class KeptCasesTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  CaseRecord record() const {
    CaseRecord r;
    r.name = "column";
    r.form = "full";
    r.code = "code";
    r.digest = "input";
    r.ended = "then";
    r.cpu_s = 2.5;
    r.lines = {{"column", "front", 0.02, "1", 0.03, 0.05, true, 1.5},
               {"column", "bad", std::nan(""), "m", std::nullopt, std::nullopt, false, 1}};
    r.plots = {{"front", "t", "z", {{"computed", {0, 1}, {2, std::nan("")}, true}}, true}};
    r.refinements = {{"height", "m", {1, 2}, {5, 6}, 1, std::nullopt, 0.1, 0.2}};
    return r;
  }
  std::string folder_ = ::testing::TempDir() + "kept_cases_test";
};

TEST_F(KeptCasesTest, ARecordComesBackAsItWas) {
  const KeptCases kept(folder_);
  EXPECT_FALSE(kept.finished("column", "full", "code", "input"));
  kept.keep(record());
  const auto r = kept.finished("column", "full", "code", "input");
  ASSERT_TRUE(r);
  ASSERT_EQ(r->lines.size(), 2u);
  EXPECT_EQ(r->lines[0].case_name, "column");
  EXPECT_EQ(r->lines[0].reference, 0.03);
  EXPECT_FALSE(r->lines[1].reference);
  EXPECT_TRUE(std::isnan(r->lines[1].value));
  EXPECT_EQ(r->failures(), 1);
  EXPECT_TRUE(r->plots[0].log_axes);
  EXPECT_TRUE(r->plots[0].curves[0].reference);
  EXPECT_TRUE(std::isnan(r->plots[0].curves[0].y[1]));
  EXPECT_EQ(r->refinements[0].u_input, 0.2);
  EXPECT_EQ(kept.all().size(), 1u);
}

TEST_F(KeptCasesTest, AnotherCodeInputOrFormIsRunAgain) {
  const KeptCases kept(folder_);
  kept.keep(record());
  EXPECT_FALSE(kept.finished("column", "full", "other", "input"));
  EXPECT_FALSE(kept.finished("column", "full", "code", "other"));
  EXPECT_FALSE(kept.finished("column", "quick", "code", "input"));
}

TEST_F(KeptCasesTest, ACaseThatBrokeOffIsRunAgain) {
  const KeptCases kept(folder_);
  CaseRecord r = record();
  r.error = "diverged";
  kept.keep(r);
  EXPECT_FALSE(kept.finished("column", "full", "code", "input"));
  EXPECT_EQ(kept.all().size(), 1u);  // but it is in the report
}

TEST_F(KeptCasesTest, ADamagedRecordIsLeftOut) {
  const KeptCases kept(folder_);
  kept.keep(record());
  for (const char* text : {"{\"case\": \"column\"", "{\"case\": 3}", "[]", ""}) {
    std::ofstream(folder_ + "/cases/column.full.json") << text;
    EXPECT_FALSE(kept.finished("column", "full", "code", "input"));
    EXPECT_TRUE(kept.all().empty());
  }
}

TEST_F(KeptCasesTest, DigestsFollowNamesAndContents) {
  EXPECT_EQ(digest_of(""), "cbf29ce484222325");  // fnv: published values
  EXPECT_EQ(digest_of("foobar"), "85944171f73967e8");
  fs::create_directories(folder_ + "/a");
  const std::string empty = digest_of_folders({folder_});
  std::ofstream(folder_ + "/a/x.csv") << "1";
  const std::string one = digest_of_folders({folder_});
  EXPECT_NE(one, empty);
  EXPECT_EQ(one, digest_of_folders({folder_}));
  std::ofstream(folder_ + "/a/x.csv") << "2";
  EXPECT_NE(digest_of_folders({folder_}), one);
  std::ofstream(folder_ + "/a/x.csv") << "1";
  fs::rename(folder_ + "/a/x.csv", folder_ + "/a/y.csv");
  EXPECT_NE(digest_of_folders({folder_}), one);
}

}  // namespace
}  // namespace seaway::validation
