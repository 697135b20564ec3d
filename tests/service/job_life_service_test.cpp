// SPDX-License-Identifier: GPL-3.0-or-later
// The life of a job as clients see it: hold, release, kill, retry, priorities, labels, changes, envelopes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "tests/support/test_service.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using client::JobClient;
using grpc::StatusCode;

class JobLifeService : public ::testing::Test {
 protected:
  JobLifeService() { fake_.allowed_steps = std::make_shared<std::atomic<std::int64_t>>(1'000'000); }
  void start() {
    service_ = std::make_unique<TestService>(fake_);
    client_ = std::make_unique<JobClient>(service_->server->address());
  }
  std::string submit(int id, const v1::Case& m = small_case()) { return client_->create(create_request(id, m)).job().name(); }
  bool reaches(const std::string& name, store::State state) { return wait_for_state(*service_->store, name.substr(5), state); }
  bool has_samples(const std::string& name, std::int64_t n) {
    return wait_for_job(*service_->store, name.substr(5), [n](const auto& j) { return j.last_sequence >= n; });
  }
  v1::Job retry(const std::string& name, int id, v1::RetryJobRequest::From from = v1::RetryJobRequest::FROM_UNSPECIFIED) {
    v1::RetryJobRequest request;
    request.set_name(name);
    request.set_request_id(request_id(id));
    request.set_from(from);
    return client_->retry(request);
  }
  FakeOptions fake_;
  std::unique_ptr<TestService> service_;
  std::unique_ptr<JobClient> client_;
};

TEST_F(JobLifeService, HeldJobsWaitUntilTheyAreReleased) {
  *fake_.allowed_steps = 5;
  start();
  const std::string running = submit(1), queued = submit(2);
  ASSERT_TRUE(has_samples(running, 5));
  EXPECT_EQ(client_->hold(queued).state(), v1::Job::STATE_HELD);
  EXPECT_EQ(client_->hold(queued).state(), v1::Job::STATE_HELD) << "again is fine";
  EXPECT_EQ(status_of([&] { client_->hold(running); }), StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(status_of([&] { client_->release(running); }), StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(status_of([&] { client_->release("jobs/nobody"); }), StatusCode::NOT_FOUND);
  *fake_.allowed_steps = 1'000'000;
  ASSERT_TRUE(reaches(running, store::State::succeeded));
  auto held = create_request(3, small_case());
  held.set_start_held(true);
  const std::string third = client_->create(held).job().name();
  EXPECT_EQ(client_->get(queued).state(), v1::Job::STATE_HELD);
  client_->release(queued);
  EXPECT_TRUE(reaches(queued, store::State::succeeded));
  EXPECT_EQ(client_->get(third).state(), v1::Job::STATE_HELD);
  EXPECT_EQ(client_->cancel(third).state(), v1::Job::STATE_CANCELLED);
}

TEST_F(JobLifeService, RetryGoesOnFromTheLastCheckpointToTheSameEnd) {
  *fake_.allowed_steps = 70;
  start();
  const std::string whole = submit(1);
  ASSERT_TRUE(has_samples(whole, 70));
  EXPECT_EQ(status_of([&] { retry(whole, 7); }), StatusCode::FAILED_PRECONDITION) << "it has not ended";
  client_->cancel(whole);
  ASSERT_TRUE(reaches(whole, store::State::cancelled));
  *fake_.allowed_steps = 1'000'000;
  const v1::Job again = retry(whole, 8);
  EXPECT_EQ(again.base_job(), whole);
  EXPECT_EQ(again.latest_sequence(), 70);
  EXPECT_EQ(retry(whole, 8).name(), again.name()) << "the same request is the same job";
  ASSERT_TRUE(reaches(again.name(), store::State::succeeded));
  const std::string fresh = submit(2);
  ASSERT_TRUE(reaches(fresh, store::State::succeeded));
  const auto left = service_->store->samples(again.uid(), 0, 1000), right = service_->store->samples(fresh.substr(5), 0, 1000);
  ASSERT_EQ(left.size(), 150u);
  for (std::size_t i = 0; i < left.size(); ++i) EXPECT_TRUE(store::same_bits(left[i], right[i])) << i;
  const v1::Job job = client_->get(again.name(), v1::JOB_VIEW_FULL);
  EXPECT_TRUE(std::any_of(job.events().begin(), job.events().end(), [](const auto& e) { return e.text() == "after sample 70"; }));
  const v1::Job from_start = retry(whole, 9, v1::RetryJobRequest::FROM_START);
  EXPECT_EQ(from_start.latest_sequence(), 0);
  EXPECT_TRUE(reaches(from_start.name(), store::State::succeeded));
  client_->erase(whole);
  EXPECT_EQ(client_->get(again.name()).state(), v1::Job::STATE_SUCCEEDED) << "it does not need the old one";
}

TEST_F(JobLifeService, RetryFromAStageMakesWhatFollowsAgain) {
  start();
  const std::string whole = submit(1);  // three stages of 50 samples
  ASSERT_TRUE(reaches(whole, store::State::succeeded));
  v1::RetryJobRequest request;
  request.set_name(whole);
  request.set_request_id(request_id(8));
  request.set_from(v1::RetryJobRequest::FROM_STAGE);
  request.set_stage(2);
  *fake_.allowed_steps = 50;  // it does not begin yet
  const v1::Job again = client_->retry(request);
  EXPECT_EQ(again.base_job(), whole);
  EXPECT_EQ(again.latest_sequence(), 50);
  EXPECT_LE(client_->stages(again.name()).stages_size(), 2) << "of the third there is nothing to say yet";
  *fake_.allowed_steps = 1'000'000;
  ASSERT_TRUE(reaches(again.name(), store::State::succeeded));
  const auto left = service_->store->samples(again.uid(), 0, 1000), right = service_->store->samples(whole.substr(5), 0, 1000);
  ASSERT_EQ(left.size(), 150u);
  for (std::size_t i = 0; i < left.size(); ++i) EXPECT_TRUE(store::same_bits(left[i], right[i])) << i;
  EXPECT_EQ(client_->stages(again.name()).stages_size(), 3);
  const v1::Job job = client_->get(again.name(), v1::JOB_VIEW_FULL);
  EXPECT_TRUE(std::any_of(job.events().begin(), job.events().end(), [](const auto& e) { return e.text() == "after sample 50"; }));
  // Of this one the end of the first stage alone came along; it has made the end of the second itself.
  request.set_name(again.name());
  request.set_request_id(request_id(9));
  request.set_stage(3);
  EXPECT_EQ(client_->retry(request).latest_sequence(), 100);
  request.set_request_id(request_id(10));
  request.set_stage(1);
  EXPECT_EQ(client_->retry(request).latest_sequence(), 0);
}

TEST_F(JobLifeService, PriorityLabelsAndNoteTravelWithTheJob) {
  *fake_.allowed_steps = 5;
  start();
  const std::string running = submit(1);
  ASSERT_TRUE(has_samples(running, 5));
  auto request = create_request(2, small_case());
  (*request.mutable_labels())["ship"] = "dtmb";
  request.set_note("to be checked");
  const std::string low = client_->create(request).job().name();
  const std::string high = submit(3);
  v1::UpdateJobRequest update;
  update.mutable_job()->set_name(high);
  update.mutable_job()->set_priority(10);
  EXPECT_EQ(status_of([&] { client_->update(update); }), StatusCode::INVALID_ARGUMENT) << "no mask";
  update.mutable_update_mask()->add_paths("priority");
  EXPECT_EQ(client_->update(update).priority(), 10);
  v1::ListJobsRequest list;
  (*list.mutable_labels())["ship"] = "dtmb";
  const auto found = client_->list(list);
  ASSERT_EQ(found.jobs_size(), 1);
  EXPECT_EQ(found.jobs(0).note(), "to be checked");
  update.mutable_update_mask()->add_paths("state");
  EXPECT_EQ(status_of([&] { client_->update(update); }), StatusCode::INVALID_ARGUMENT);
  (*request.mutable_labels())["Bad Key"] = "x";
  request.set_request_id(request_id(4));
  EXPECT_EQ(status_of([&] { client_->create(request); }), StatusCode::INVALID_ARGUMENT);
  request = create_request(5, small_case());
  request.set_priority(101);
  EXPECT_EQ(status_of([&] { client_->create(request); }), StatusCode::INVALID_ARGUMENT);
  *fake_.allowed_steps = 1'000'000;
  ASSERT_TRUE(reaches(low, store::State::succeeded));
  const auto first = service_->store->find(high.substr(5))->started_ns, second = service_->store->find(low.substr(5))->started_ns;
  EXPECT_LT(first, second) << "the later one was more important";
}

TEST_F(JobLifeService, WatchJobsGivesEveryChangeOnceAlsoOverBreaks) {
  start();
  std::vector<std::int64_t> seen;
  std::vector<std::string> kinds;
  const std::string a = submit(1);
  ASSERT_TRUE(reaches(a, store::State::succeeded));
  std::atomic<bool> deleted{false};
  std::jthread changer([&] {
    JobClient other(service_->server->address());
    for (int i = 2; i < 12; ++i) ASSERT_TRUE(reaches(other.create(create_request(i, small_case())).job().name(), store::State::succeeded));
    other.erase(a);
  });
  while (!deleted) {
    int left = 4;  // leave the stream often
    client_->watch_jobs(seen.empty() ? 0 : seen.back(), [&](const v1::WatchJobsResponse& m) {
      if (!m.has_change()) return true;
      seen.push_back(m.change().revision());
      kinds.push_back(m.change().kind());
      if (m.change().kind() == "DELETED") {
        deleted = true;
        EXPECT_EQ(m.change().name(), a);
        EXPECT_FALSE(m.change().has_job());
      }
      return !deleted && --left > 0;
    });
  }
  changer.join();
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], static_cast<std::int64_t>(i) + 1);
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), "CREATED"), 11);
  EXPECT_EQ(client_->watch_jobs(1'000'000, [](const auto&) { return true; }).error_code(), StatusCode::OUT_OF_RANGE);
  EXPECT_EQ(client_->watch_jobs(-1, [](const auto&) { return true; }).error_code(), StatusCode::INVALID_ARGUMENT);
  service_->store->prune(3, 0);
  EXPECT_EQ(client_->watch_jobs(1, [](const auto&) { return true; }).error_code(), StatusCode::OUT_OF_RANGE) << "never a silent gap";
}

TEST_F(JobLifeService, EnvelopeIsThatOfTheHistory) {
  start();
  const std::string name = submit(1, small_case(20));
  ASSERT_TRUE(reaches(name, store::State::succeeded));
  v1::ReadEnvelopeRequest request;
  request.set_job(name);
  request.set_max_points(50);
  const auto points = client_->envelope(request);
  EXPECT_LE(points.times_s_size(), 50);
  EXPECT_EQ(points.last_sequence(), 6000);
  double low = 1e9, high = -1e9;
  client_->history(name, [&](const v1::ReadSamplesResponse& page) {
    if (page.chunk().columns_size() == 0) return;
    for (const double v : page.chunk().columns(1).values()) low = std::min(low, v), high = std::max(high, v);  // roll, degrees
  });
  const auto& roll = points.columns(1);
  EXPECT_EQ(*std::min_element(roll.minimum().begin(), roll.minimum().end()), low);
  EXPECT_EQ(*std::max_element(roll.maximum().begin(), roll.maximum().end()), high);
  request.set_max_points(1);
  EXPECT_EQ(status_of([&] { client_->envelope(request); }), StatusCode::INVALID_ARGUMENT);
}

TEST_F(JobLifeService, OldJobsAreDeletedWithTheirData) {
  start();
  const std::string a = submit(1), b = submit(2);
  ASSERT_TRUE(reaches(a, store::State::succeeded));
  ASSERT_TRUE(reaches(b, store::State::succeeded));
  const auto end_of_a = service_->store->find(a.substr(5))->ended_ns;
  EXPECT_EQ(service_->queue->expire(end_of_a + 1), 1);
  EXPECT_EQ(status_of([&] { client_->get(a); }), StatusCode::NOT_FOUND);
  EXPECT_EQ(client_->get(b).state(), v1::Job::STATE_SUCCEEDED);
  EXPECT_FALSE(std::filesystem::exists(service_->workspace.run_folder(a.substr(5))));
  EXPECT_EQ(status_of([&] { submit(1); }), StatusCode::FAILED_PRECONDITION) << "a late repetition of its submit";
}

TEST_F(JobLifeService, ServerTellsWhatItIs) {
  start();
  const std::string a = submit(1);
  ASSERT_TRUE(reaches(a, store::State::succeeded));
  const v1::ServerInfo info = client_->info();
  EXPECT_TRUE(info.storage_ok());
  ASSERT_EQ(info.job_counts_size(), 7);
  EXPECT_EQ(info.job_counts(v1::Job::STATE_SUCCEEDED - 1), 1);
  EXPECT_EQ(status_of([&] { client_->set_log_level("loud"); }), StatusCode::INVALID_ARGUMENT);
}

}  // namespace
}  // namespace seaway
