// SPDX-License-Identifier: GPL-3.0-or-later
// The commands that people type, as processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "client/job_client.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string build = SEAWAY_BUILD_DIR;
const std::string source = SEAWAY_SOURCE_DIR;
const std::string small = source + "/tests/e2e/small.yaml";

class Programs : public ::testing::Test {
 protected:
  void start(std::vector<std::string> environment = {}) {
    daemon_ = std::make_unique<Daemon>(build + "/tests/seaway_fake_daemon", folder_.path(), std::move(environment));
    daemon_->start();
  }
  Finished seaway(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), build + "/bin/seaway");
    return run_program(std::move(arguments), {"SEAWAY_SERVER=" + (daemon_ ? daemon_->address() : "127.0.0.1:1")});
  }
  static Finished offline(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), build + "/tests/seaway_fake_offline");
    return run_program(std::move(arguments));
  }
  TempFolder folder_;
  std::unique_ptr<Daemon> daemon_;
};

TEST_F(Programs, SubmitWatchAndAllResults) {
  start();
  const Finished submit = seaway({"submit", "--watch", small});
  EXPECT_EQ(submit.code, 0) << submit.output;
  EXPECT_THAT(submit.output, HasSubstr("hydrostatics"));
  EXPECT_THAT(submit.output, HasSubstr("succeeded"));
  EXPECT_THAT(submit.output, HasSubstr("roll amplitude"));
  EXPECT_THAT(seaway({"list"}).output, HasSubstr("Small test section"));
  EXPECT_THAT(seaway({"show"}).output, HasSubstr("samples           600"));
  EXPECT_THAT(seaway({"show", "--case"}).output, HasSubstr("height_m: 0.03"));
  const Finished history = seaway({"history"});
  EXPECT_THAT(history.output, HasSubstr("heave [m],roll [deg]"));
  EXPECT_EQ(std::count(history.output.begin(), history.output.end(), '\n'), 601);
  const auto stages = nlohmann::json::parse(seaway({"stages", "--json"}).output);
  EXPECT_EQ(stages["stages"].size(), 3u);
  EXPECT_THAT(seaway({"artifacts"}).output, HasSubstr("section_6.00.json"));
  EXPECT_EQ(seaway({"download", "latest", "section_6.00.json", "-o", folder_ / "s.json"}).code, 0);
  EXPECT_TRUE(nlohmann::json::parse(read_text(folder_ / "s.json")).contains("hull"));
  const Finished plot = seaway({"plot", "-o", folder_ / "pictures", "--json"});
  ASSERT_EQ(plot.code, 0) << plot.output;
  const auto plotted = nlohmann::json::parse(plot.output);  // alive over the loop
  for (const auto& file : plotted["files"]) EXPECT_GT(fs::file_size(file.get<std::string>()), 10000u);
  EXPECT_EQ(seaway({"watch", "--json"}).code, 0);
  EXPECT_EQ(daemon_->terminate(), 0);
}

TEST_F(Programs, ServiceAndForegroundRunGiveTheSameBytes) {
  start();
  ASSERT_EQ(seaway({"submit", "--watch", small}).code, 0);
  ASSERT_EQ(seaway({"history", "-o", folder_ / "service.csv"}).code, 0);
  const Finished run = offline({small, "-o", folder_ / "run", "--json"});
  ASSERT_EQ(run.code, 0) << run.output;
  EXPECT_EQ(nlohmann::json::parse(run.output)["samples"], 600);
  EXPECT_EQ(read_text(folder_ / "service.csv"), read_text(folder_ / "run/history.csv"));
}

TEST_F(Programs, ForegroundRunGoesOnAfterAStop) {
  ASSERT_EQ(offline({small, "-o", folder_ / "whole", "-q"}).code, 0);
  const std::vector<std::string> command{build + "/tests/seaway_fake_offline", small, "-o", folder_ / "parts", "-q"};
  const std::vector<std::string> slow{"SEAWAY_FAKE_STEP_US=2000", "SEAWAY_FAKE_CHECKPOINT_STEPS=50"};
  const auto lines = [&] {
    const std::string text = read_text(folder_ / "parts/history.csv");
    return std::count(text.begin(), text.end(), '\n');
  };
  for (const int number : {SIGTERM, SIGKILL, SIGINT}) {
    Process part(command, "", slow);
    const auto before = lines();
    while (lines() < before + 60) ASSERT_EQ(part.wait_for(std::chrono::milliseconds(2)), -1);
    part.signal(number);
    EXPECT_EQ(part.wait(), number == SIGKILL ? 128 + SIGKILL : 3);
  }
  EXPECT_EQ(Process(command).wait(), 0);
  EXPECT_EQ(read_text(folder_ / "parts/history.csv"), read_text(folder_ / "whole/history.csv"));
}

TEST_F(Programs, WrongCasesNameFileLineAndField) {
  start();
  const auto wrong = [&](const std::string& from, const std::string& to) {
    std::string text = read_text(small);
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::ofstream(folder_ / "wrong.yaml") << text;
    const Finished online = seaway({"submit", folder_ / "wrong.yaml"});
    const Finished local = offline({"check", folder_ / "wrong.yaml"});
    EXPECT_EQ(online.code, 2) << to;
    EXPECT_EQ(local.code, 2) << to;
    return online.output + local.output;
  };
  EXPECT_THAT(wrong("height_m: 0.03", "height_mm: 30"), HasSubstr("wrong.yaml:11:5: wave.regular.height_mm: unknown key; write height_m, in metres"));
  EXPECT_THAT(wrong("mass_kg_per_m: 15", "mass_kg_per_m: -15"), HasSubstr("wrong.yaml:26:3: body.mass_kg_per_m: -15 is not allowed"));
  EXPECT_THAT(wrong("cog: {z_m: 0.05}", ""), HasSubstr("body.cog: is missing"));
  EXPECT_THAT(wrong("dt_s: 0.01", "dt_s: .nan"), HasSubstr("must be finite"));
  EXPECT_THAT(wrong("title: Small", "title: broken"), HasSubstr("wrong.yaml:8:3: mesh.base_cell_m: 0.08 is too coarse"));
  EXPECT_THAT(wrong("title: Small", "title: [Small"), HasSubstr("not valid YAML"));
  EXPECT_EQ(nlohmann::json::parse(seaway({"list", "--json"}).output)["jobs"].size(), 0u) << "nothing is queued";
}

TEST_F(Programs, HullPrintsHydrostatics) {
  const std::string table = source + "/client/examples/dtmb5415_offsets.csv";
  const Finished done = offline({"hull", table, "--scale", "51", "--amidships", "71", "--draft", "0.12059", "--kg",
                                 "0.148", "--json", "--out", folder_ / "hull"});
  ASSERT_EQ(done.code, 0) << done.output;
  const auto report = nlohmann::json::parse(done.output);
  EXPECT_NEAR(report["at_draft"]["volume_m3"].get<double>(), 8389.1 / (51.0 * 51 * 51), 1e-4);
  EXPECT_NEAR(report["intact"]["gm_m"].get<double>(), 0.0384, 0.0005);
  EXPECT_TRUE(fs::exists(folder_ / "hull/body_plan.png"));
  EXPECT_TRUE(fs::exists(folder_ / "hull/gz.png"));
  EXPECT_EQ(offline({"hull", folder_ / "nothing.stl", "--unit", "1"}).code, 1);
  EXPECT_EQ(offline({"hull", table, "--scale", "0"}).code, 2);
}

TEST_F(Programs, ExitCodesTellWhatHappened) {
  EXPECT_EQ(seaway({"list"}).code, 4);
  start({"SEAWAY_FAKE_STEP_US=2000"});
  EXPECT_EQ(seaway({"show", "nobody"}).code, 5);
  EXPECT_EQ(seaway({"show"}).code, 5);
  EXPECT_EQ(seaway({"submit", "/does/not/exist.yaml"}).code, 2);
  EXPECT_EQ(seaway({"frobnicate"}).code, 2);
  EXPECT_EQ(seaway({"submit", small}).code, 0);
  EXPECT_EQ(seaway({"cancel", "latest"}).code, 0);
  EXPECT_EQ(seaway({"watch"}).code, 3);
  const Finished plot = run_program({build + "/bin/seaway", "--server", daemon_->address(), "plot", "-o", folder_.path()}, {"PATH=/nowhere"});
  EXPECT_EQ(plot.code, 1);
}

TEST_F(Programs, ASecondServerOnTheSameDataRefusesToStart) {
  start();
  const Finished second = run_program({build + "/tests/seaway_fake_daemon", "--data-dir", folder_ / "data", "--port", "0"});
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.output, HasSubstr("another server uses this data"));
  std::ofstream(folder_ / "config.yaml") << "workers:\n  cuont: 2\n";
  const Finished wrong = run_program({build + "/tests/seaway_fake_daemon", "-c", folder_ / "config.yaml"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.output, HasSubstr("config.yaml:2:3: workers.cuont: unknown key; did you mean count?"));
}

TEST_F(Programs, StopUnderLoadIsQuickAndLosesNothing) {
  start({"SEAWAY_FAKE_STEP_US=2000"});
  ASSERT_EQ(seaway({"submit", small}).code, 0);
  Process watcher({build + "/bin/seaway", "--server", daemon_->address(), "watch"}, folder_ / "watch.txt");
  client::JobClient client(daemon_->address());
  const std::string name = client.resolve("latest");
  // The watcher has begun as well: one that meets no server at its start gives up.
  while (client.get(name).latest_sequence() < 50 || read_text(folder_ / "watch.txt").empty()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(daemon_->terminate(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10)) << read_text(folder_ / "log.txt");
  daemon_->start();
  EXPECT_EQ(watcher.wait(), 0) << read_text(folder_ / "watch.txt");
  const v1::Job job = client.get(name);
  EXPECT_EQ(job.latest_sequence(), 600);
  EXPECT_EQ(job.attempt(), 2);
}

TEST_F(Programs, CommandsOfTheJobLife) {
  start({"SEAWAY_FAKE_STEP_US=" + std::to_string(2000 * SEAWAY_SLOWDOWN)});  // the first job runs longer than its commands take
  ASSERT_EQ(seaway({"submit", small}).code, 0);
  ASSERT_EQ(seaway({"submit", "--hold", "--label", "ship=dtmb", "--note", "later", "--priority", "3", small}).code, 0);
  EXPECT_THAT(seaway({"list", "--state", "held", "--label", "ship=dtmb"}).output, HasSubstr("held"));
  EXPECT_THAT(seaway({"label", "latest", "sweep=7", "ship-"}).output, HasSubstr("held"));
  const Finished show = seaway({"show"});
  EXPECT_THAT(show.output, HasSubstr("sweep=7"));
  EXPECT_THAT(show.output, ::testing::Not(HasSubstr("ship=dtmb")));
  EXPECT_THAT(show.output, HasSubstr("later"));
  EXPECT_EQ(seaway({"note", "latest", "now"}).code, 0);
  EXPECT_EQ(seaway({"priority", "latest", "9"}).code, 0);
  EXPECT_EQ(seaway({"label", "latest", "nonsense"}).code, 2);
  EXPECT_THAT(seaway({"release", "latest"}).output, HasSubstr("queued"));
  EXPECT_THAT(seaway({"hold", "latest"}).output, HasSubstr("held"));
  EXPECT_THAT(seaway({"kill", "latest"}).output, HasSubstr("cancelled"));
  EXPECT_THAT(seaway({"retry", "latest"}).output, HasSubstr("queued"));
  // A worker may have taken it already: then it ends soon.
  EXPECT_THAT(seaway({"kill", "latest"}).output, HasSubstr("cancel"));
  seaway({"watch", "latest"});
  EXPECT_THAT(seaway({"show"}).output, HasSubstr("cancelled"));
  EXPECT_THAT(seaway({"retry", "latest", "--from-stage", "2"}).output, HasSubstr("has not kept an end of stage 1"));
  EXPECT_THAT(seaway({"retry", "latest", "--from-stage", "4"}).output, HasSubstr("stage: 4 is not allowed; must be 1 to 3"));
  EXPECT_EQ(seaway({"retry", "latest", "--from-stage", "2", "--from-start"}).code, 2);
  EXPECT_THAT(seaway({"retry", "latest", "--from-stage", "1"}).output, HasSubstr("queued"));
  EXPECT_THAT(seaway({"events", "--once"}).output, HasSubstr("CREATED"));
  EXPECT_THAT(seaway({"server", "--log-level", "debug"}).output, HasSubstr("log level  debug"));
  EXPECT_EQ(seaway({"watch"}).code, 0);
  const std::string data = folder_ / "data";
  const Finished backup = run_program({build + "/tests/seaway_fake_daemon", "--data-dir", data, "backup", folder_ / "copy.db"});
  EXPECT_EQ(backup.code, 0) << backup.output;
  EXPECT_THAT(backup.output, HasSubstr("4 jobs"));
  const Finished audit = run_program({build + "/tests/seaway_fake_daemon", "--data-dir", data, "audit", "-n", "200"});
  EXPECT_EQ(audit.code, 0) << audit.output;
  EXPECT_THAT(audit.output, ::testing::ContainsRegex("local +ipv4:127.0.0.1:[0-9]+ +KillJob +OK +jobs/"));
  EXPECT_LT(audit.output.find("CreateJob"), audit.output.find("SetLogLevel")) << "oldest first";
  EXPECT_EQ(run_program({build + "/tests/seaway_fake_daemon", "--data-dir", data, "audit", "--denied"}).output, "");
  EXPECT_EQ(run_program({build + "/tests/seaway_fake_daemon", "--data-dir", folder_ / "nowhere", "audit"}).code, 1);
  EXPECT_EQ(daemon_->terminate(), 0);
  const Finished verify = run_program({build + "/tests/seaway_fake_daemon", "--data-dir", data, "verify"});
  EXPECT_EQ(verify.code, 0) << verify.output;
  EXPECT_THAT(verify.output, HasSubstr("0 problems"));
}

TEST_F(Programs, PythonExampleRuns) {
  start();
  const Finished python = run_program({"/usr/bin/python3", source + "/client/python/example.py", daemon_->address()},
                                      {"PYTHONPATH=" + build + "/python:" + source + "/client/python", "PYTHONDONTWRITEBYTECODE=1"});
  EXPECT_EQ(python.code, 0) << python.output;
  EXPECT_THAT(python.output, HasSubstr("STATE_SUCCEEDED samples 100"));
}

}  // namespace
}  // namespace seaway
