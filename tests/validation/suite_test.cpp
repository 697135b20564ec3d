// A suite with a report folder goes on where it was broken off; cases here only count how often they ran.
#include "tests/validation/suite.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"

namespace seaway::validation {
namespace {

namespace fs = std::filesystem;

int good_runs = 0, bad_runs = 0, thrown_runs = 0;
std::string results_folder;

void run_good(const Context& context, Results& results) {
  ++good_runs;
  results_folder = context.results;
  results.expect_below("a", context.quick() ? 1 : 2, "1", 3);
  results.plot({"curve", "x", "y", {{"c", {0, 1}, {0, 1}}}});
}
void run_bad(const Context&, Results& results) {
  ++bad_runs;
  results.expect_below("b", 4, "1", 3);
}
void run_thrown(const Context&, Results& results) {
  ++thrown_runs;
  results.report("c", 1, "1");
  fail(ErrorCode::diverged, "on purpose");
}

class SuiteTest : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    good_runs = bad_runs = thrown_runs = 0;
  }
  void TearDown() override { fs::remove_all(folder_); }
  int run(const std::vector<const Case*>& cases, Suite suite = Suite::full) const {
    Context context;
    context.suite = suite;
    ::testing::internal::CaptureStdout();
    const int status = run_suite(cases, context, Format::json, folder_);
    ::testing::internal::GetCapturedStdout();
    return status;
  }
  nlohmann::json report() const { return nlohmann::json::parse(std::ifstream(folder_ + "/report.json")); }

  const Case good_{"good", Suite::quick, "passes", run_good}, bad_{"bad", Suite::quick, "fails", run_bad},
      thrown_{"thrown", Suite::quick, "throws", run_thrown};
  std::string folder_ = ::testing::TempDir() + "suite_test";
};

TEST_F(SuiteTest, FinishedCasesAreNotRunAgain) {
  EXPECT_EQ(run({&good_}), 0);
  EXPECT_EQ(run({&good_, &bad_}), 1);
  EXPECT_EQ(run({&good_, &bad_}), 1);  // a missed bar is a result: it is kept
  EXPECT_EQ(good_runs, 1);
  EXPECT_EQ(bad_runs, 1);
  EXPECT_EQ(report()["summary"]["cases"], 2);
  EXPECT_EQ(report()["summary"]["failed"], 1);
  EXPECT_TRUE(fs::exists(folder_ + "/report.html"));
}

TEST_F(SuiteTest, AnotherFormIsAnotherRun) {
  run({&good_});
  run({&good_}, Suite::quick);
  EXPECT_EQ(good_runs, 2);
  EXPECT_EQ(report()["cases"][0]["lines"][0]["value"], 1);
}

TEST_F(SuiteTest, ACaseThatThrewIsRunAgainAndIsInTheReport) {
  EXPECT_EQ(run({&thrown_, &good_}), 1);
  EXPECT_EQ(report()["cases"][0]["error"], "on purpose");
  EXPECT_EQ(report()["cases"].size(), 2u);
  run({&thrown_, &good_});
  EXPECT_EQ(thrown_runs, 2);
  EXPECT_EQ(good_runs, 1);
}

TEST_F(SuiteTest, LongCasesKeepTheirRunsInTheFolder) {
  run({&good_});
  EXPECT_EQ(results_folder.rfind(folder_ + "/runs/", 0), 0u) << results_folder;
}

TEST_F(SuiteTest, AReportIsMadeOfWhatIsKept) {
  run({&good_, &bad_});
  fs::remove(folder_ + "/report.json");
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(report_kept(folder_), 1);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "2 quantities, 1 failed\n");
  EXPECT_EQ(report()["summary"]["cases"], 2);
  EXPECT_EQ(good_runs, 1);
}

TEST_F(SuiteTest, WithoutAFolderNothingIsKept) {
  Context context;
  ::testing::internal::CaptureStdout();
  run_suite({&good_}, context, Format::json, "");
  run_suite({&good_}, context, Format::json, "");
  ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(good_runs, 2);
  EXPECT_FALSE(fs::exists(folder_));
}

}  // namespace
}  // namespace seaway::validation
