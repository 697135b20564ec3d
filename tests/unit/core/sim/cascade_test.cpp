// Whole runs of tiny cases: stages, release, checkpoints, interruption, threads, failures.
#include "core/sim/cascade.hpp"
#include "core/sim/checkpoint_name.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/unit/core/sim/barge_case.hpp"

namespace seaway::sim {
namespace {

using namespace testing;
using ::seaway::testing::TempFolder;

void expect_same(const Sample& a, const Sample& b) {
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.stage, b.stage);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.values, b.values) << "sample " << a.sequence;
}

/// Every sample that came must be that of the unbroken run, and none may be missing.
void expect_history(const std::vector<Sample>& got, const std::vector<Sample>& whole) {
  std::vector<char> seen(whole.size(), 0);
  for (const Sample& s : got) {
    ASSERT_GE(s.sequence, 1);
    ASSERT_LE(s.sequence, static_cast<std::int64_t>(whole.size()));
    expect_same(s, whole[static_cast<std::size_t>(s.sequence - 1)]);
    seen[static_cast<std::size_t>(s.sequence - 1)] = 1;
  }
  EXPECT_THAT(seen, ::testing::Each(1));
}

std::vector<Sample> joined(const Keeper& a, const Keeper& b) {
  std::vector<Sample> out = a.samples;
  out.insert(out.end(), b.samples.begin(), b.samples.end());
  return out;
}

/// The unbroken run, made once for all tests.
const Keeper& unbroken() {
  static const Keeper* keeper = [] {
    auto* k = new Keeper;
    const TempFolder folder;
    const RunOutcome outcome = run(two_stages(), folder.path(), *k);
    EXPECT_EQ(outcome.reason, StopReason::finished) << outcome.message;
    return k;
  }();
  return *keeper;
}

TEST(Cascade, RunsBothStagesAndNumbersItsSamples) {
  const Keeper& k = unbroken();
  ASSERT_EQ(k.finished.size(), 2u);
  EXPECT_EQ(k.finished[0].steps, 15);
  EXPECT_GE(k.finished[1].steps, 15);  // more where the step had to be lowered
  ASSERT_EQ(static_cast<std::int64_t>(k.samples.size()), 15 + k.finished[1].steps);
  EXPECT_FALSE(k.finished[0].has_mapping);
  ASSERT_TRUE(k.finished[1].has_mapping);
  EXPECT_GT(k.finished[1].info.cells, k.finished[0].info.cells);
  const MappingReport& mapping = k.finished[1].mapping;
  EXPECT_NEAR(mapping.water_after, mapping.water_before, 1e-12 * mapping.water_before);
  EXPECT_GE(mapping.vof_min, 0);
  EXPECT_LE(mapping.vof_max, 1);
  EXPECT_LT(mapping.divergence_after, 1e-8);
  for (std::size_t i = 0; i < k.samples.size(); ++i) {
    EXPECT_EQ(k.samples[i].sequence, static_cast<std::int64_t>(i + 1));
    EXPECT_EQ(k.samples[i].stage, i < 15 ? 0 : 1);
    EXPECT_EQ(k.samples[i].values.size(), k.channels.size());
  }
}

// The repair after mapping blew the new stage up: it tried to remove the old solve's residual in
// cells that may not change, and the Courant number rose to 100.
TEST(Cascade, MappingKeepsTheFlowSmooth) {
  const Keeper& k = unbroken();
  const std::size_t courant = k.channel("courant");
  for (const Sample& s : k.samples) EXPECT_LT(s.values[courant], 0.5) << s.sequence;
}

TEST(Cascade, ResumedRunContinuesToTheBitFromEitherStage) {
  for (const int stop_after : {7, 20}) {
    const TempFolder folder;
    Keeper first(stop_after), second;
    EXPECT_EQ(run(two_stages(), folder.path(), first).reason, StopReason::cancelled);
    EXPECT_EQ(first.samples.size(), static_cast<std::size_t>(stop_after));
    EXPECT_EQ(run(two_stages(), folder.path(), second).reason, StopReason::finished);
    EXPECT_EQ(second.count("resumed"), 1);
    EXPECT_EQ(second.samples.front().sequence, stop_after + 1);
    expect_history(joined(first, second), unbroken().samples);
  }
}

/// two_stages with longer steps in the first.
Case two_steps() {
  Case c = two_stages();
  c.stages[0].dt = 0.012;
  return c;
}

TEST(Cascade, AStageTakesItsOwnStepFromItsSecondStepOn) {
  const TempFolder folder;
  Keeper k;
  EXPECT_EQ(run(two_steps(), folder.path(), k).reason, StopReason::finished);
  ASSERT_EQ(k.started.size(), 2u);
  EXPECT_EQ(k.started[0].dt, 0.012);
  EXPECT_EQ(k.started[1].dt, 0.008);
  double before = 0;
  for (const Sample& s : k.samples) {  // velocities are half a long step ahead when the second stage begins
    EXPECT_NEAR(s.time - before, s.sequence <= 11 ? 0.012 : 0.008, 1e-12) << s.sequence;
    before = s.time;
  }
}

TEST(Cascade, AResumedRunKeepsTheStepsOfItsStages) {
  const TempFolder whole_folder;
  Keeper whole;
  EXPECT_EQ(run(two_steps(), whole_folder.path(), whole).reason, StopReason::finished);
  for (const int stop_after : {7, 10, 11}) {
    const TempFolder folder;
    Keeper first(stop_after), second;
    EXPECT_EQ(run(two_steps(), folder.path(), first).reason, StopReason::cancelled);
    EXPECT_EQ(run(two_steps(), folder.path(), second).reason, StopReason::finished);
    expect_history(joined(first, second), whole.samples);
  }
}

/// Roll of the freed barge after 0.24 s with steps of its two stages, on one mesh.
double roll_after(double first_dt, double second_dt) {
  Case c = two_stages();
  c.body.release = Body::Release::at_start;
  c.stages[1].mesh = c.stages[0].mesh;
  c.stages[0].end.duration = 0.096;
  c.stages[1].end.duration = 0.144;
  c.stages[0].dt = first_dt;
  c.stages[1].dt = second_dt;
  const TempFolder folder;
  Keeper k;
  EXPECT_EQ(run(c, folder.path(), k).reason, StopReason::finished);
  EXPECT_NEAR(k.samples.back().time, 0.24, 1e-9);
  return k.samples.back().values[k.channel("roll")] / degree;
}

TEST(Cascade, AnotherStepLeavesNoKickInTheMotion) {
  const double steady = roll_after(0.008, 0.008), halved = roll_after(0.016, 0.008), fine = roll_after(0.004, 0.004);
  EXPECT_LT(std::abs(halved - fine), 2 * std::abs(steady - fine) + 0.01) << steady << ' ' << halved << ' ' << fine;
}

TEST(Cascade, ResumeAtAStageEndMapsOnceAndGoesOn) {
  const TempFolder folder;
  Keeper first(15), second, third;
  // The stop comes with the stage's last sample: the checkpoint is that of the stage's end.
  const auto outcome = run(two_stages(), folder.path(), first);
  EXPECT_NE(outcome.reason, StopReason::diverged);
  EXPECT_EQ(run(two_stages(), folder.path(), second).reason, StopReason::finished);
  expect_history(joined(first, second), unbroken().samples);
  // A finished run has nothing left to do.
  EXPECT_EQ(run(two_stages(), folder.path(), third).reason, StopReason::finished);
  EXPECT_TRUE(third.samples.empty());
}

TEST(Cascade, SameBitsForAnyNumberOfThreads) {
  for (const int threads : {2, 4}) {
    const TempFolder folder;
    Keeper k;
    EXPECT_EQ(run(two_stages(), folder.path(), k, threads).reason, StopReason::finished);
    expect_history(k.samples, unbroken().samples);
  }
}

std::vector<std::string> checkpoint_files(const std::string& folder) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".ck") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

void damage(const std::string& path) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(0, std::ios::end);
  const auto middle = file.tellg() / 2;
  file.seekg(middle);
  const char c = static_cast<char>(file.get() ^ 0x10);
  file.seekp(middle);
  file.put(c);
}

constexpr double every_step = 1e-9;  ///< wall seconds between checkpoints

TEST(Cascade, DamagedNewestCheckpointGivesWayToTheOneBefore) {
  const TempFolder folder;
  Keeper first(20), second;
  EXPECT_EQ(run(two_stages(), folder.path(), first, 1, every_step).reason, StopReason::cancelled);
  const auto files = checkpoint_files(folder.path());
  ASSERT_EQ(files.size(), 3u) << "the last two and the end of the first stage are kept";
  damage(files.back());
  EXPECT_EQ(run(two_stages(), folder.path(), second, 1, every_step).reason, StopReason::finished);
  EXPECT_EQ(second.count("checkpoint_rejected"), 1);
  EXPECT_EQ(second.count("resumed"), 1);
  expect_history(joined(first, second), unbroken().samples);
}

// Rejected files have the highest numbers: they used to stay, and each new checkpoint was pruned at
// once.
TEST(Cascade, NewCheckpointsSurviveBesideRejectedOnes) {
  const TempFolder folder;
  Keeper first(20), second(5), third;
  EXPECT_EQ(run(two_stages(), folder.path(), first, 1, every_step).reason, StopReason::cancelled);
  for (const std::string& file : checkpoint_files(folder.path())) damage(file);
  EXPECT_EQ(run(two_stages(), folder.path(), second, 1, every_step).reason, StopReason::cancelled);
  EXPECT_EQ(second.count("checkpoint_rejected"), 3);
  EXPECT_EQ(second.count("resumed"), 0);
  EXPECT_EQ(second.samples.front().sequence, 1) << "from the start";
  ASSERT_FALSE(second.checkpoints.empty());
  EXPECT_TRUE(std::filesystem::exists(second.checkpoints.back().first));
  EXPECT_EQ(run(two_stages(), folder.path(), third).reason, StopReason::finished);
  EXPECT_EQ(third.count("resumed"), 1);
  EXPECT_EQ(third.samples.front().sequence, 6);
  expect_history(joined(second, third), unbroken().samples);
}

TEST(Cascade, EndsOfStagesAreKeptToRepeatFromThem) {
  const TempFolder folder;
  Keeper first, second;
  EXPECT_EQ(run(two_stages(), folder.path(), first, 1, every_step).reason, StopReason::finished);
  std::vector<int> ends;
  for (const std::string& file : checkpoint_files(folder.path())) {
    if (const auto stage = stage_ended_in(file)) ends.push_back(*stage);
    if (stage_ended_in(file) != 0) std::filesystem::remove(file);
  }
  EXPECT_EQ(ends, (std::vector{0, 1}));
  EXPECT_EQ(run(two_stages(), folder.path(), second).reason, StopReason::finished);
  ASSERT_FALSE(second.samples.empty());
  EXPECT_EQ(second.samples.front().sequence, 16) << "the second stage begins again";
  for (const Sample& s : second.samples) EXPECT_EQ(s.values, first.samples[static_cast<std::size_t>(s.sequence - 1)].values) << s.sequence;
}

TEST(Cascade, NamesOfCheckpointsSayWhichStageTheyEnd) {
  EXPECT_EQ(stage_ended_in("/data/jobs/abc/checkpoint_0000000123e2.ck"), 2);
  EXPECT_EQ(stage_ended_in("12e11.checkpoint"), 11);
  for (const char* inside : {"checkpoint_0000000123a.ck", "/e1/checkpoint_12a.ck", "checkpoint_12e.ck", "e1.ck", "checkpoint_12e1x.ck", "", "12e-1.ck"})
    EXPECT_EQ(stage_ended_in(inside), std::nullopt) << inside;
}

TEST(Cascade, CheckpointOfAnotherCaseIsNotResumed) {
  const TempFolder folder;
  Keeper first(5), second(5);
  EXPECT_EQ(run(two_stages(), folder.path(), first).reason, StopReason::cancelled);
  RunOptions options;
  options.folder = folder.path();
  options.case_digest = "another";
  RunContext context = quiet_context();
  context.stop = second.stop.get_token();
  EXPECT_EQ(run_cascade(two_stages(), options, second, context).reason, StopReason::cancelled);
  EXPECT_EQ(second.count("resumed"), 0);
  EXPECT_EQ(second.samples.front().sequence, 1);
}

void expect_diverged(const Case& c, const char* why) {
  const TempFolder folder;
  Keeper k;
  const RunOutcome outcome = run(c, folder.path(), k, 1, every_step);
  EXPECT_EQ(outcome.reason, StopReason::diverged);
  EXPECT_THAT(outcome.message, ::testing::HasSubstr(why));
  EXPECT_THAT(outcome.message, ::testing::HasSubstr("last good checkpoint"));
  ASSERT_FALSE(k.samples.empty());
  ASSERT_FALSE(k.checkpoints.empty());
  EXPECT_TRUE(std::filesystem::exists(k.checkpoints.back().first));
  EXPECT_EQ(k.checkpoints.back().second, k.samples.back().sequence);
  for (const Sample& s : k.samples)
    for (const double v : s.values) EXPECT_TRUE(std::isfinite(v));
}

TEST(Cascade, PressureThatDoesNotConvergeIsAnOutcomeThatKeepsHistoryAndCheckpoint) {
  Case c = barge(0.025);
  c.stages[0].end.duration = 0.4;
  c.numerics.max_pressure_iterations = 3;
  c.numerics.pressure_tolerance = 1e-6;
  c.body.prescribed = {{Dof::roll, 0.35, 0.5, 0.3}};
  expect_diverged(c, "pressure solve stopped");
}

TEST(Cascade, AbsurdTimeStepIsAnOutcomeThatKeepsHistoryAndCheckpoint) {
  Case c = barge(0.025);
  c.stages[0].end.duration = 40;
  c.time.dt = 2;
  c.body.free = {Dof::roll};
  c.body.angles = {2 * degree, 0, 0};
  expect_diverged(c, "t =");
}

TEST(Cascade, HullIsHeldUntilItsTimeHasCome) {
  const Keeper& k = unbroken();
  ASSERT_EQ(k.count("released"), 1);
  const std::size_t roll = k.channel("roll"), heave = k.channel("heave");
  for (const Sample& s : k.samples) {
    if (s.time < 0.04 + 1e-9) {
      EXPECT_EQ(s.values[roll], 10 * degree) << s.time;
      EXPECT_EQ(s.values[heave], 0) << s.time;
    }
  }
  EXPECT_LT(k.samples.back().values[roll], 9.9 * degree) << "it rolls back upright";
}

TEST(Cascade, HullInCalmWaterIsReleasedWhenTheWaterIsStill) {
  const TempFolder folder;
  Case c = barge(0.025);
  c.body.free = {Dof::heave};
  c.body.release = Body::Release::converged;
  c.stages[0].end.duration = 0.6;
  Keeper k;
  EXPECT_EQ(run(c, folder.path(), k).reason, StopReason::finished);
  ASSERT_EQ(k.count("released"), 1);
  const std::size_t heave = k.channel("heave");
  // Half the natural period first, even in still water; at its draft the barge then stays.
  EXPECT_EQ(k.samples[20].values[heave], 0);
  EXPECT_NEAR(k.samples.back().values[heave], 0, 1e-3);
}

TEST(Cascade, ARunThatEndsByItsRuleIsWhollyDone) {
  const TempFolder folder;
  Case c = barge(0.025);
  c.body.free = {Dof::roll};
  c.body.angles = {10 * degree, 0, 0};
  c.stages[0].end.kind = EndRule::Kind::converged;
  c.stages[0].end.tolerance = 1;  // as soon as there are enough periods to tell
  c.stages[0].end.min_periods = 1;
  Keeper k;
  EXPECT_EQ(run(c, folder.path(), k).reason, StopReason::finished);
  EXPECT_LT(k.samples.back().time, 5 * 0.93) << "sooner than the six periods that are expected";
  EXPECT_EQ(k.progress.fraction, 1);
  EXPECT_EQ(k.progress.remaining_s, 0);
}

TEST(Cascade, HullInWavesIsReleasedByItsLoadsOrAfterTheLongestWait) {
  const TempFolder folder;
  Case c = barge(0.00625);
  c.wave.kind = Wave::Kind::regular;
  c.wave.height = 0.05;
  c.wave.period = 0.8;
  c.zones.generation_length = 0.35;
  c.zones.absorption_length = 0.35;
  c.stages[0].mesh.surface = {{0.00625, 0.03}};
  c.body.free = {Dof::roll};
  c.body.release = Body::Release::converged;
  c.body.release_tolerance = 1e-6;  // never: the longest wait counts
  c.body.release_min_periods = 1;
  c.body.release_max_periods = 2;
  c.time.dt = 0.8 / 30;
  c.stages[0].end.duration = 1.8;
  Keeper k;
  EXPECT_EQ(run(c, folder.path(), k).reason, StopReason::finished);
  ASSERT_EQ(k.count("released"), 1);
  const std::size_t roll = k.channel("roll");
  for (const Sample& s : k.samples) {
    if (s.time < 1.6 + 1e-9) {
      EXPECT_EQ(s.values[roll], 0) << s.time;
    }
  }
  EXPECT_NE(k.samples.back().values[roll], 0);
}

TEST(Cascade, RefusesACaseThatTheCheckRefuses) {
  const TempFolder folder;
  Case c = two_stages();
  c.body.mass = -1;
  Keeper k;
  EXPECT_THROW(run(c, folder.path(), k), Error);
  EXPECT_TRUE(k.samples.empty());
}

}  // namespace
}  // namespace seaway::sim
