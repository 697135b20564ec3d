// SPDX-License-Identifier: GPL-3.0-or-later
// decay, rao and sweeps as people type them: with the stand-in, and a small run of the real solver.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using nlohmann::json;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string build = SEAWAY_BUILD_DIR;
const std::string source = SEAWAY_SOURCE_DIR;
const std::string small = source + "/tests/e2e/small.yaml";

class Reports : public ::testing::Test {
 protected:
  Finished seaway(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), build + "/bin/seaway");
    return run_program(std::move(arguments), {"SEAWAY_SERVER=" + daemon_.address()});
  }
  static Finished offline(std::vector<std::string> arguments, const std::string& program = "/tests/seaway_fake_offline") {
    arguments.insert(arguments.begin(), build + program);
    return run_program(std::move(arguments));
  }
  TempFolder folder_;
  Daemon daemon_{build + "/tests/seaway_fake_daemon", folder_.path()};
};

TEST_F(Reports, ASweepFromTheCommandLineToItsCurve) {
  daemon_.start();
  const Finished sweep = seaway({"sweep", small, "--period", "1.2,1.4", "--height", "0.03", "--label", "ship=box", "--json"});
  ASSERT_EQ(sweep.code, 0) << sweep.output;
  EXPECT_EQ(json::parse(sweep.output)["sweep"]["points"].size(), 2u);
  EXPECT_EQ(seaway({"watch"}).code, 0);
  const auto made = json::parse(seaway({"sweeps", "latest", "--json"}).output);  // alive over the loop
  for (const auto& point : made["points"])
    EXPECT_EQ(seaway({"watch", point["job"].get<std::string>().substr(5)}).code, 0);
  EXPECT_THAT(seaway({"sweeps"}).output, HasSubstr("succeeded 2"));
  EXPECT_THAT(seaway({"sweeps", "latest"}).output, HasSubstr("1.2 s"));
  // A stage of the case lasts 2 s: one whole period.
  const Finished rao = seaway({"rao", "--sweep", "latest", "--periods", "1", "-o", folder_ / "pictures"});
  EXPECT_EQ(rao.code, 0) << rao.output;
  EXPECT_THAT(rao.output, HasSubstr("heave"));
  EXPECT_GT(fs::file_size(folder_ / "pictures/rao.png"), 10000u);
  const Finished more = seaway({"rao", "latest", "--periods", "1", "--json"});
  EXPECT_NEAR(json::parse(more.output)["points"][0]["motions"][1]["amplitude"].get<double>(), 0.02 * (1 + 0.1 / 3), 3e-4);
  EXPECT_EQ(seaway({"rao"}).code, 2);
  EXPECT_EQ(seaway({"sweep", small, "--period", "1.2,1.2"}).code, 2);
  EXPECT_THAT(seaway({"sweep", small, "--height", "-1"}).output, HasSubstr("--height: -1 is not allowed"));
  std::string wrong = read_text(small);
  wrong.replace(wrong.find("dimension: 2"), 12, "dimension: 4");
  std::ofstream(folder_ / "wrong.yaml") << wrong;
  EXPECT_THAT(seaway({"sweep", small, folder_ / "wrong.yaml", "--period", "1.2"}).output, HasSubstr("wrong.yaml:3:1: dimension: 4"));
  EXPECT_EQ(seaway({"sweeps", "latest", "--cancel"}).code, 0);
  EXPECT_EQ(seaway({"sweeps", "nothing"}).code, 5);
}

TEST_F(Reports, OfflineAndOnlineSayTheSame) {
  daemon_.start();
  ASSERT_EQ(seaway({"submit", "--watch", small}).code, 0);
  ASSERT_EQ(offline({small, "-o", folder_ / "run", "-q"}).code, 0);
  auto here = json::parse(offline({"rao", folder_ / "run", "--periods", "1", "--json", "--out", folder_ / "rao"}).output);
  auto there = json::parse(seaway({"rao", "latest", "--periods", "1", "--json"}).output);
  EXPECT_GT(fs::file_size(folder_ / "rao/rao.png"), 10000u);
  for (auto* report : {&here, &there}) (*report)["points"][0].erase("source");
  EXPECT_EQ(here, there);
}

TEST_F(Reports, WavePrintsAndDrawsWhatACaseAsksFor) {
  const Finished regular = offline({"wave", small, "--json"}, "/bin/seaway-run");
  ASSERT_EQ(regular.code, 0) << regular.output;
  EXPECT_NEAR(json::parse(regular.output)["length_m"].get<double>(), 2.935, 0.005);
  const std::string sea = source + "/tests/e2e/sea.yaml";
  const Finished irregular = offline({"wave", sea, "--json", "--out", folder_ / "wave"}, "/bin/seaway-run");
  ASSERT_EQ(irregular.code, 0) << irregular.output;
  const json report = json::parse(irregular.output);
  EXPECT_EQ(report["components"].size(), 40u);
  EXPECT_NEAR(report["realised"]["significant_height_m"].get<double>(), 0.06, 0.0015);
  EXPECT_LT(report["realised"]["zero_crossing_period_s"].get<double>(), 1.1);
  EXPECT_GT(fs::file_size(folder_ / "wave/wave.png"), 10000u);
  EXPECT_THAT(offline({"wave", sea}, "/bin/seaway-run").output, HasSubstr("Tz"));
  EXPECT_EQ(offline({"wave", source + "/tests/e2e/decay.yaml"}, "/bin/seaway-run").code, 2) << "calm water";
}

TEST_F(Reports, TheEmptyTankIsMeasured) {
  const Finished found = offline({"wave", source + "/tests/e2e/sea.yaml", "--json", "--calibrate", "--duration", "3", "--threads", "1", "--run",
                                  folder_ / "tank"}, "/bin/seaway-run");
  ASSERT_EQ(found.code, 0) << found.output;
  const json report = json::parse(found.output)["calibration"];
  EXPECT_NEAR(report["height_m"].get<double>() / report["asked_height_m"].get<double>(), 1, 0.15) << "three cells in Hs";
  EXPECT_NEAR(report["peak_period_s"].get<double>() / report["asked_peak_period_s"].get<double>(), 1, 0.15);
  EXPECT_LT(report["reflection"].get<double>(), 1) << "two and a half periods say no more";
}

TEST_F(Reports, ARealDecayOnCoarseCells) {
  const Finished run = offline({source + "/tests/e2e/decay.yaml", "-o", folder_ / "run", "-q", "--threads", "1"}, "/bin/seaway-run");
  ASSERT_EQ(run.code, 0) << run.output;
  const Finished decay = offline({"decay", folder_ / "run", "--json"}, "/bin/seaway-run");
  ASSERT_EQ(decay.code, 0) << decay.output;
  const json report = json::parse(decay.output);
  EXPECT_NEAR(report["peaks"][0]["angle"].get<double>(), 15, 0.5);
  EXPECT_NEAR(report["damped_cosine"]["period_s"]["value"].get<double>(), 0.93, 0.93 * 0.15) << "six cells to the draft";
  EXPECT_GE(report["cycles"].size(), 2u);
  EXPECT_GT(report["extinction"]["linear"]["value"].get<double>() + 10 * report["extinction"]["quadratic"]["value"].get<double>(), 0);
  EXPECT_THAT(offline({"decay", folder_ / "run/history.csv"}, "/bin/seaway-run").output, HasSubstr("damped cosine: period"));
  EXPECT_EQ(offline({"rao", folder_ / "run"}, "/bin/seaway-run").code, 1) << "calm water";
  EXPECT_EQ(offline({"decay", folder_ / "nothing"}, "/bin/seaway-run").code, 1);
}

}  // namespace
}  // namespace seaway
