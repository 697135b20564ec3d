// Finished runs are read back only if they are of the example as it is.
#include "tests/validation/support/kept_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/validation/report/kept_cases.hpp"

namespace seaway::validation {
namespace {

constexpr const char* example = "dtmb5415_ship_intact_decay_desk.yaml";

RunRecord decay(const std::string& digest) {
  RunRecord r;
  r.digest = digest;
  r.version = "1";
  r.t = {0, 0.0125};
  r.roll = {0.342, 0.3410000049};
  r.heave = {0, -1e-3};
  r.cpu_s = {0, 2.5};
  r.stages = {{"only", 1000, 1, 0, 0.0125, 2.5, 0, true}};
  r.total_cpu_s = 3;
  return r;
}

std::string digest_of_run(const std::string& name) {
  std::ifstream file(std::string(SEAWAY_EXAMPLES) + "/" + example);
  std::stringstream text;
  text << file.rdbuf();
  return name + " " + digest_of(text.str());
}

TEST(KeptRuns, AFinishedRunOfTheExampleIsRead) {
  const testing::TempFolder folder;
  save(decay(digest_of_run("run")), folder / "run.json");
  const RunRecord r = KeptRuns(folder.path(), "case").finished("run", example, {}, 1, {});
  EXPECT_EQ(r.version, "1");
  EXPECT_EQ(r.t, (std::vector<double>{0, 0.0125}));
  EXPECT_NEAR(r.roll[1], 0.3410000049, 1e-8);
  EXPECT_EQ(r.stages.front().cells, 1000);
  EXPECT_EQ(r.total_cpu_s, 3);
}

TEST(KeptRuns, ARunKeptWithTheProjectIsReadUnlessResultsAreAskedFor) {
  const testing::TempFolder project, results;
  save(decay(digest_of_run("run")), project / "run.json");
  EXPECT_EQ(KeptRuns("", "case", project.path()).finished("run", example, {}, 1, {}).version, "1");
  EXPECT_THROW(KeptRuns(results.path(), "case", project.path()).finished("run", example, {}, 1, {}), std::exception);
}

// The empty case cannot run: that it is asked to shows that the record was not taken.
TEST(KeptRuns, ARunOfAnotherTextOfTheExampleIsRunAgain) {
  const testing::TempFolder folder;
  save(decay(digest_of_run("run") + "0"), folder / "run.json");
  EXPECT_THROW(KeptRuns(folder.path(), "case").finished("run", example, {}, 1, {}), std::exception);
}

TEST(RunRecord, ConvergesWhenTheSwingsRepeatByTheRuleOfAStage) {
  // Amplitude 1 + exp(-n) after n periods: its change over two periods is below 1 % from exp(-n) (e^2 - 1) < 0.01 on,
  // that is from the mean of the eighth period; the stage starts at the second.
  RunRecord r;
  constexpr double period = 1.4;
  for (int i = 0; i <= 2000; ++i) {
    const double n = i / 100.0;
    r.t.push_back(n * period);
    r.roll.push_back(n < 2 ? 5.0 : (1 + std::exp(2 - n)) * std::cos(2 * pi * n));
    r.heave.push_back(0.01 * std::sin(2 * pi * n));
  }
  sim::EndRule rule;
  rule.min_periods = 4;
  const double at = r.converged_at(2 * period, rule, period);
  EXPECT_GT(at, 8.5 * period);
  EXPECT_LT(at, 10.5 * period);
  EXPECT_NEAR(std::remainder(at, period), 0, 1e-6);  // rules are looked at when a period is over
  rule.min_periods = 12;
  EXPECT_NEAR(r.converged_at(2 * period, rule, period), 14 * period, 1e-6);
  rule.tolerance = 1e-12;
  EXPECT_TRUE(std::isinf(r.converged_at(2 * period, rule, period)));
}

}  // namespace
}  // namespace seaway::validation
