// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/runner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "core/base/error.hpp"
#include "server/jobs/submission.hpp"
#include "server/jobs/workspace.hpp"
#include "tests/support/fake_cascade.hpp"
#include "tests/support/service_jobs.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::jobs {
namespace {

using seaway::testing::FakeOptions;
using seaway::testing::fake_solver;
using seaway::testing::small_case;
using store::State;

class Runner : public ::testing::Test {
 protected:
  void create(const std::string& uid, const v1::Case& m) {
    const std::string spec = encode_spec(m, {});
    store_->create({uid, "r-" + uid, m.title(), sha256_hex(spec), "1", spec});
  }
  RunResult attempt(const Solver& solver, std::stop_token stop = {}) {
    const auto job = store_->take_next();
    const RunResult result = run_job(*job, solver, workspace_, *store_, {}, std::move(stop), quiet_context().log);
    store_->flush();
    return result;
  }
  void requeue(const std::string& uid) { store_->move(uid, State::running, State::queued, store::Reason::server_drain, ""); }
  std::vector<store::Sample> history(const std::string& uid) { return store_->samples(uid, 0, 1'000'000); }
  int events(const std::string& uid, const std::string& kind) {
    int n = 0;
    for (const auto& e : store_->events(uid)) n += e.kind == kind ? 1 : 0;
    return n;
  }

  seaway::testing::TempFolder folder_;
  Workspace workspace_{folder_.path()};
  std::unique_ptr<store::JobStore> store_ = seaway::testing::open_store(folder_.path());
};

TEST_F(Runner, StoresWhatARunReports) {
  create("a", small_case());
  EXPECT_EQ(attempt(fake_solver()).end, RunResult::End::finished);
  EXPECT_EQ(history("a").size(), 150u);
  EXPECT_EQ(store_->channels("a").at(1).name, "roll");
  EXPECT_EQ(store_->channels("a").at(1).unit, "rad") << "the store keeps core units";
  const auto stages = store_->stages("a");
  ASSERT_EQ(stages.size(), 3u);
  v1::StageReport report;
  ASSERT_TRUE(report.ParseFromString(stages[2].report));
  EXPECT_TRUE(report.finished());
  EXPECT_EQ(report.motions(0).unit(), "deg");
  EXPECT_EQ(report.phases_size(), 9);
  EXPECT_EQ(store_->artifacts("a").size(), 3u);
  EXPECT_EQ(store_->find("a")->checkpoint_sequence, 150);
}

TEST_F(Runner, InterruptedRunEndsWithTheSameBits) {
  create("whole", small_case());
  attempt(fake_solver());
  create("broken", small_case());
  for (const std::int64_t steps : {30, 31, 90, 149}) {
    auto allowed = std::make_shared<std::atomic<std::int64_t>>(steps);
    FakeOptions options;
    options.allowed_steps = allowed;
    std::stop_source stop;
    std::jthread stopper([&] {
      seaway::testing::wait_for_job(*store_, "broken", [&](const store::Job& j) { return j.last_sequence >= steps; });
      stop.request_stop();
    });
    EXPECT_EQ(attempt(fake_solver(options), stop.get_token()).end, RunResult::End::stopped);
    requeue("broken");
  }
  EXPECT_EQ(attempt(fake_solver()).end, RunResult::End::finished);
  const auto a = history("whole");
  const auto b = history("broken");
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_TRUE(store::same_bits(a[i], b[i])) << i;
  EXPECT_EQ(events("broken", "RESUMED"), 4);
  EXPECT_EQ(events("broken", "REPLAY_MISMATCH"), 0);
}

TEST_F(Runner, CheckpointWithoutItsRecordIsNotUsed) {
  create("a", small_case());
  FakeOptions options;
  options.allowed_steps = std::make_shared<std::atomic<std::int64_t>>(40);
  std::stop_source stop;
  {
    std::jthread stopper([&] {
      seaway::testing::wait_for_job(*store_, "a", [](const store::Job& j) { return j.last_sequence >= 40; });
      stop.request_stop();
    });
    attempt(fake_solver(options), stop.get_token());
  }
  requeue("a");
  // As if the process had died between writing a later checkpoint and its commit: same content, not recorded.
  const std::string recorded = store_->checkpoints("a").back().path;
  std::filesystem::copy_file(recorded, workspace_.run_folder("a") + "/unrecorded.checkpoint");
  EXPECT_EQ(attempt(fake_solver()).end, RunResult::End::finished);
  EXPECT_FALSE(std::filesystem::exists(workspace_.run_folder("a") + "/unrecorded.checkpoint"));
  EXPECT_EQ(history("a").size(), 150u);
}

TEST_F(Runner, ReplayWithOtherBitsIsRecorded) {
  create("a", small_case());
  FakeOptions first;
  first.allowed_steps = std::make_shared<std::atomic<std::int64_t>>(20);
  std::stop_source stop;
  {
    std::jthread stopper([&] {
      seaway::testing::wait_for_job(*store_, "a", [](const store::Job& j) { return j.last_sequence >= 20; });
      stop.request_stop();
    });
    attempt(fake_solver(first), stop.get_token());
  }
  requeue("a");
  for (const auto& c : store_->checkpoints("a")) std::filesystem::remove(c.path);  // begin anew
  FakeOptions other;
  other.perturbation = 1e-9;
  EXPECT_EQ(attempt(fake_solver(other)).end, RunResult::End::finished);
  EXPECT_EQ(events("a", "REPLAY_MISMATCH"), 1);
  EXPECT_EQ(history("a").size(), 150u);
}

TEST_F(Runner, BlowUpKeepsHistoryAndCheckpoint) {
  v1::Case m = small_case();
  m.set_title("this will diverge");
  create("a", m);
  const RunResult result = attempt(fake_solver());
  EXPECT_EQ(result.end, RunResult::End::failed);
  EXPECT_EQ(result.reason, store::Reason::diverged);
  EXPECT_THAT(result.message, ::testing::HasSubstr("smaller time step"));
  EXPECT_EQ(history("a").size(), 126u);
  EXPECT_EQ(store_->find("a")->checkpoint_sequence, 100);
  EXPECT_TRUE(std::filesystem::exists(store_->checkpoints("a").back().path));
}

TEST_F(Runner, ExceptionsBecomeReasons) {
  create("a", small_case());
  create("b", small_case());
  create("c", small_case());
  const auto throwing = [](auto thrower) {
    return Solver{[thrower](const sim::Case&, const sim::RunOptions&, sim::RunObserver&, const RunContext&) -> sim::RunOutcome {
                    thrower();
                    return {};
                  },
                  {}};
  };
  EXPECT_EQ(attempt(throwing([] { throw std::bad_alloc(); })).reason, store::Reason::memory);
  EXPECT_EQ(attempt(throwing([] { throw std::runtime_error("?"); })).reason, store::Reason::internal);
  EXPECT_EQ(attempt(throwing([] { fail(ErrorCode::invalid_argument, "no"); })).reason, store::Reason::invalid_input);
}

TEST_F(Runner, RefusesAGapAndForeignArtifacts) {
  create("a", small_case());
  create("b", small_case());
  const Solver gap{[](const sim::Case&, const sim::RunOptions&, sim::RunObserver& o, const RunContext&) -> sim::RunOutcome {
                     o.on_channels({{"heave", "m"}});
                     o.on_sample({5, 0, 5, 0.5, {1}});
                     return {};
                   },
                   {}};
  EXPECT_EQ(attempt(gap).reason, store::Reason::checkpoint_lost);
  const Solver foreign{[](const sim::Case&, const sim::RunOptions&, sim::RunObserver& o, const RunContext&) -> sim::RunOutcome {
                         o.on_artifact("passwd", "/etc/passwd", "text/plain");
                         return {};
                       },
                       {}};
  EXPECT_EQ(attempt(foreign).end, RunResult::End::failed);
  EXPECT_TRUE(store_->artifacts("b").empty());
}

}  // namespace
}  // namespace seaway::jobs
