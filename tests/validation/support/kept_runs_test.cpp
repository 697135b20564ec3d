// Finished runs are read back only if they are of the example as it is.
#include "tests/validation/support/kept_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/validation/report/kept_cases.hpp"

namespace seaway::validation {
namespace {

constexpr const char* example = "dtmb5415_ship_intact_decay_desk.yaml";

RunRecord decay(const std::string& digest) {
  RunRecord r;
  r.digest = digest;
  r.version = std::string("1");
  r.t = {0, 0.0125};
  r.roll = {0.342, 0.3410000049};
  r.heave = {0, -1e-3};
  r.cpu_s = {0, 2.5};
  r.stages = {{"only", 1000, 1, 0, 0.0125, 2.5, 0, true, -2e-6}};
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
  EXPECT_EQ(r.stages.front().volume_drift, -2e-6);
  EXPECT_EQ(r.total_cpu_s, 3);
}

TEST(KeptRuns, ARecordFromBeforeTheDriftWasKeptHasNone) {
  const testing::TempFolder folder;
  RunRecord old = decay(digest_of_run("run"));
  old.stages.front().volume_drift = std::nan("");
  save(old, folder / "run.json");
  EXPECT_TRUE(std::isnan(KeptRuns(folder.path(), "case").finished("run", example, {}, 1, {}).stages.front().volume_drift));
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

}  // namespace
}  // namespace seaway::validation
