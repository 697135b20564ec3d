// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/queue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.hpp"
#include "server/convert/input_error.hpp"
#include "server/jobs/worker_pool.hpp"
#include "tests/support/fake_cascade.hpp"
#include "tests/support/service_jobs.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::jobs {
namespace {

using namespace seaway::testing;
using store::State;

class QueueTest : public ::testing::Test {
 protected:
  QueueTest() { fake_.allowed_steps = allowed_; }
  /// Workers whose runs wait before step `steps` until it is raised.
  void start(std::int64_t steps, int workers = 1) {
    *allowed_ = steps;
    PoolSettings settings;
    settings.workers = workers;
    pool_.reset();
    executor_ = make_thread_executor({}, fake_solver(fake_), workspace_, *store_, quiet_context().log);
    pool_ = std::make_unique<WorkerPool>(settings, *executor_, workspace_, *store_, quiet_context().log);
    pool_->start();
  }
  std::string submit(int id, const v1::Case& m = small_case()) { return queue_.submit(create_request(id, m)).job.uid; }
  std::string why_refused(const v1::CreateJobRequest& request) {
    try {
      queue_.submit(request);
    } catch (const convert::InputError& error) {
      return error.reason() + " " + error.what();
    }
    return "accepted";
  }

  TempFolder folder_;
  Workspace workspace_{folder_.path()};
  std::unique_ptr<store::JobStore> store_ = seaway::testing::open_store(folder_.path());
  std::shared_ptr<std::atomic<std::int64_t>> allowed_ = std::make_shared<std::atomic<std::int64_t>>(0);
  FakeOptions fake_;
  std::unique_ptr<Executor> executor_;
  std::unique_ptr<WorkerPool> pool_;
  Queue queue_{QueueLimits{3, 0}, fake_solver(), workspace_, *store_, [this] { if (pool_) pool_->wake(); },
               [this](const std::string& uid) { if (pool_) pool_->request_stop(uid); },
               [this](const std::string& uid) { if (pool_) pool_->request_kill(uid); }};
};

constexpr std::int64_t no_limit = 1'000'000'000;

TEST_F(QueueTest, RunsJobsToTheirEnd) {
  start(no_limit, 2);
  const std::string a = submit(1);
  const std::string b = submit(2);
  EXPECT_TRUE(wait_for_state(*store_, a, State::succeeded));
  EXPECT_TRUE(wait_for_state(*store_, b, State::succeeded));
  EXPECT_EQ(store_->find(b)->last_sequence, 150);
}

TEST_F(QueueTest, ATableOfElevationsTravelsWithItsCase) {
  v1::Case m = small_case();
  auto& series = *m.mutable_wave()->mutable_time_series();
  series.set_file("gauge.csv");
  series.set_lower_cutoff_hz(0.3);
  series.set_upper_cutoff_hz(2);
  auto request = create_request(1, m);
  EXPECT_THAT(why_refused(request), ::testing::HasSubstr("wave.time_series.file: 'gauge.csv' did not come with the case"));
  auto& file = *request.add_files();
  file.set_name("gauge.csv");
  file.set_content("0 0.01\n0.1 0.02\n");
  EXPECT_EQ(why_refused(request), "accepted");
  const sim::Case bound = bind_case(m, request.files(), workspace_);
  EXPECT_TRUE(std::filesystem::exists(bound.wave.file)) << "under the digest of its content, not under a name of the client";
  EXPECT_NE(std::filesystem::path(bound.wave.file).filename(), "gauge.csv");
}

TEST_F(QueueTest, RepeatedSubmitGivesTheSameJob) {
  const std::string a = submit(1);
  EXPECT_EQ(submit(1), a);
  EXPECT_NE(submit(2), a);
  v1::Case other = small_case();
  other.mutable_body()->set_mass_kg_per_m(16);
  other.mutable_cascade()->mutable_stages(1)->set_name("else");
  const std::string why = why_refused(create_request(1, other));
  EXPECT_THAT(why, ::testing::HasSubstr("REQUEST_ID_REUSED"));
  EXPECT_THAT(why, ::testing::HasSubstr("body.mass_kg_per_m: differs"));
  EXPECT_THAT(why, ::testing::HasSubstr("cascade.stages[1].name: differs"));
}

TEST_F(QueueTest, WrongCasesAreNotQueued) {
  v1::Case m = small_case();
  m.mutable_body()->set_mass_kg_per_m(-1);
  EXPECT_THAT(why_refused(create_request(1, m)), ::testing::HasSubstr("body.mass_kg_per_m: -1 is not allowed"));
  m = small_case();
  m.set_title("broken mesh");
  EXPECT_THAT(why_refused(create_request(1, m)), ::testing::HasSubstr("mesh.base_cell_m: 0.08 is too coarse"));
  auto request = create_request(1, small_case());
  request.set_request_id("not-a-uuid");
  EXPECT_THAT(why_refused(request), ::testing::HasSubstr("request_id: is not a UUID"));
  request = {};
  EXPECT_THAT(why_refused(request), ::testing::HasSubstr("case: is missing"));
  EXPECT_TRUE(store_->list({}).empty());
}

TEST_F(QueueTest, ValidateOnlyQueuesNothing) {
  auto request = create_request(1, small_case());
  request.set_validate_only(true);
  const Submitted result = queue_.submit(request);
  EXPECT_FALSE(result.has_job);
  EXPECT_TRUE(result.report.ok());
  EXPECT_EQ(result.report.stages_size(), 3);
  EXPECT_TRUE(store_->list({}).empty());
}

TEST_F(QueueTest, FilesComeWithTheCaseThatNamesThem) {
  v1::Case m = small_case();
  m.mutable_hull()->mutable_offsets_section()->set_file("hulls/../../etc/ship.csv");
  auto request = create_request(1, m);
  EXPECT_THAT(why_refused(request), ::testing::HasSubstr("hull.offsets_section.file"));
  auto& file = *request.add_files();
  file.set_name("hulls/../../etc/ship.csv");
  file.set_content("1,2\n");
  const sim::Case bound = bind_case(request.case_(), request.files(), workspace_);
  EXPECT_TRUE(bound.hull.offsets_file.starts_with(folder_.path() + "/files/"));
  EXPECT_EQ(why_refused(request), "accepted");
  auto& extra = *request.add_files();
  extra.set_name("other.csv");
  EXPECT_THAT(why_refused(request), ::testing::HasSubstr("named nowhere"));
}

TEST_F(QueueTest, TheSameCaseIsCheckedOnce) {
  int checks = 0;
  Solver counting = fake_solver();
  counting.check = [&checks, check = counting.check](const sim::Case& c) { ++checks; return check(c); };
  Queue queue(QueueLimits{}, counting, workspace_, *store_, [] {}, [](const auto&) {}, [](const auto&) {});
  const auto request = create_request(1, small_case());
  const v1::CaseReport first = queue.validate(request.case_(), request.files());
  EXPECT_EQ(queue.submit(request).report.SerializeAsString(), first.SerializeAsString());
  EXPECT_EQ(queue.submit(request).report.SerializeAsString(), first.SerializeAsString());
  EXPECT_EQ(checks, 1);
  queue.submit(create_request(2, small_case(0.7)));
  EXPECT_EQ(checks, 2) << "another case";
  auto twice = request;  // the digest of a case does not know of this
  for (int i = 0; i < 2; ++i) twice.add_files()->set_name("a");
  EXPECT_THROW(queue.submit(twice), convert::InputError);
  v1::Case broken = small_case();
  broken.set_title("broken");
  for (int i = 0; i < 2; ++i) EXPECT_THROW(queue.submit(create_request(3, broken)), convert::InputError) << "known to be wrong";
}

TEST_F(QueueTest, ForgetsTheCheckThatWasNotAskedForTheLongest) {
  ReportCache cache(2);
  v1::CaseReport report;
  for (const char* digest : {"a", "b"}) cache.keep(digest, report);
  EXPECT_TRUE(cache.find("a"));
  cache.keep("c", report);
  EXPECT_TRUE(cache.find("a"));
  EXPECT_FALSE(cache.find("b"));
  EXPECT_TRUE(cache.find("c"));
}

TEST_F(QueueTest, FilesOfRunningJobsAreNotSwept) {
  v1::Case m = small_case();
  m.mutable_hull()->mutable_offsets_section()->set_file("ship.csv");
  auto request = create_request(1, m);
  auto& file = *request.add_files();
  file.set_name("ship.csv");
  file.set_content("1,2\n");
  start(5);
  const std::string uid = queue_.submit(request).job.uid;
  ASSERT_TRUE(wait_for_job(*store_, uid, [](const store::Job& job) { return job.last_sequence > 0; })) << "it has read its file";
  const std::string path = workspace_.keep_file("1,2\n");
  std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
  EXPECT_EQ(queue_.sweep_files(std::chrono::hours(1)), 0);
  EXPECT_TRUE(std::filesystem::exists(path));
  *allowed_ = no_limit;
  ASSERT_TRUE(wait_for_state(*store_, uid, State::succeeded));
  EXPECT_EQ(queue_.sweep_files(std::chrono::hours(1)), 1);
}

TEST_F(QueueTest, IsLimited) {
  for (int i = 0; i < 3; ++i) submit(i);
  try {
    submit(4);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::resource_exhausted);
  }
}

TEST_F(QueueTest, CancelsAQueuedJobAtOnce) {
  const std::string a = submit(1);
  EXPECT_EQ(queue_.cancel(a).state, State::cancelled);
  EXPECT_EQ(queue_.cancel(a).state, State::cancelled) << "again is fine";
  EXPECT_THROW(queue_.cancel("nobody"), Error);
}

TEST_F(QueueTest, CancelsARunningJobAfterACheckpoint) {
  start(30);
  const std::string a = submit(1);
  ASSERT_TRUE(wait_for_job(*store_, a, [](const store::Job& j) { return j.last_sequence == 30; }));
  EXPECT_EQ(queue_.cancel(a).state, State::cancelling);
  EXPECT_TRUE(wait_for_state(*store_, a, State::cancelled));
  EXPECT_EQ(store_->find(a)->checkpoint_sequence, 30);
  EXPECT_EQ(store_->find(a)->reason, store::Reason::user);
}

TEST_F(QueueTest, AnEndedJobCannotBeCancelled) {
  start(no_limit);
  const std::string a = submit(1);
  ASSERT_TRUE(wait_for_state(*store_, a, State::succeeded));
  try {
    queue_.cancel(a);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::failed_precondition);
  }
}

TEST_F(QueueTest, DrainPutsRunningJobsBackAndTheyGoOn) {
  start(40);
  const std::string a = submit(1);
  ASSERT_TRUE(wait_for_job(*store_, a, [](const store::Job& j) { return j.last_sequence == 40; }));
  pool_->drain();
  const auto drained = store_->find(a);
  EXPECT_EQ(drained->state, State::queued);
  EXPECT_EQ(drained->reason, store::Reason::server_drain);
  EXPECT_EQ(drained->checkpoint_sequence, 40);
  start(no_limit);
  EXPECT_TRUE(wait_for_state(*store_, a, State::succeeded));
  EXPECT_EQ(store_->find(a)->attempt, 2);
  EXPECT_EQ(store_->find(a)->last_sequence, 150);
}

TEST_F(QueueTest, DivergedJobsFailWithTheirReason) {
  start(no_limit);
  v1::Case m = small_case();
  m.set_title("diverge");
  const std::string a = submit(1, m);
  EXPECT_TRUE(wait_for_state(*store_, a, State::failed));
  EXPECT_EQ(store_->find(a)->reason, store::Reason::diverged);
}

TEST_F(QueueTest, EraseRemovesTheFolder) {
  start(no_limit);
  const std::string a = submit(1);
  ASSERT_TRUE(wait_for_state(*store_, a, State::succeeded));
  queue_.erase(a);
  EXPECT_FALSE(store_->find(a));
  EXPECT_FALSE(std::filesystem::exists(workspace_.run_folder(a)));
}

TEST(Uid, IsPlain) {
  EXPECT_TRUE(is_uid(new_uid()));
  EXPECT_NE(new_uid(), new_uid());
  for (const char* bad : {"", "A", "a/b", "..", "a b"}) EXPECT_FALSE(is_uid(bad));
}

}  // namespace
}  // namespace seaway::jobs
