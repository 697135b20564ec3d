// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps and reports over the wire.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/constants.hpp"
#include "tests/support/test_service.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using client::JobClient;
using grpc::StatusCode;

class SweepService : public ::testing::Test {
 protected:
  v1::CreateSweepRequest request(int id) {
    v1::CreateSweepRequest r;
    r.set_request_id(request_id(id));
    auto& one = *r.add_cases();
    one.set_name("small");
    *one.mutable_case_() = small_case(10);
    r.add_periods_s(1.4);
    r.add_periods_s(2.8);
    return r;
  }
  void wait(const v1::Sweep& sweep) {
    for (const auto& p : sweep.points()) EXPECT_TRUE(wait_for_state(*service_.store, p.job().substr(5), store::State::succeeded));
  }
  TestService service_;
  JobClient client_{service_.server->address()};
};

TEST_F(SweepService, FromOneRequestToItsTransferFunctions) {
  const v1::Sweep made = client_.create_sweep(request(1)).sweep();
  ASSERT_EQ(made.points_size(), 2);
  EXPECT_EQ(client_.create_sweep(request(1)).sweep().name(), made.name()) << "the same request again";
  wait(made);
  const v1::Sweep ended = client_.sweep(made.name());
  EXPECT_TRUE(ended.ended());
  EXPECT_EQ(ended.state_counts(v1::Job::STATE_SUCCEEDED - 1), 2);
  EXPECT_EQ(ended.points(1).period_s(), 2.8);
  EXPECT_EQ(ended.points(1).state(), v1::Job::STATE_SUCCEEDED);
  EXPECT_EQ(client_.list_sweeps({}).sweeps(0).name(), made.name());
  EXPECT_EQ(client_.list_sweeps({}).sweeps(0).points_size(), 0);

  v1::GetRaoReportRequest rao;
  rao.set_sweep(made.name());
  const v1::RaoReport report = client_.rao(rao);
  ASSERT_EQ(report.points_size(), 2);
  // The stand-in heaves with 0.02 (1 + 0.1/3) m at 1.4 s in its last stage, whatever the wave: 0.015 m.
  EXPECT_EQ(report.points(0).case_name(), "small");
  EXPECT_NEAR(report.points(0).period_s(), 1.4, 1e-12);
  EXPECT_NEAR(report.points(0).motions(1).amplitude(), 0.02 * (1 + 0.1 / 3), 1e-5) << "but for its 0.1 mm of chaos";
  EXPECT_EQ(report.points(0).motions(1).channel(), "heave");
  EXPECT_NEAR(report.points(0).motions(1).rao(), 0.02 * (1 + 0.1 / 3) / 0.015, 1e-3);
  EXPECT_NEAR(report.points(0).motions(2).amplitude(), 0.15 * (1 + 0.1 / 3) / degree, 1e-3) << "degrees at the edge";
  EXPECT_NEAR(report.points(1).motions(1).amplitude(), 0, 2e-5) << "and not at 2.8 s";
}

TEST_F(SweepService, NumbersOfARunningJobSayThatItRuns) {
  FakeOptions fake;
  fake.allowed_steps = std::make_shared<std::atomic<std::int64_t>>(300);
  TestService slow(fake);
  JobClient client(slow.server->address());
  v1::GetRaoReportRequest rao;
  rao.add_jobs(client.create(create_request(7, small_case(10))).job().name());
  ASSERT_TRUE(wait_for_job(*slow.store, rao.jobs(0).substr(5), [](const auto& job) { return job.last_sequence >= 300; }));
  const v1::RaoReport report = client.rao(rao);
  EXPECT_GT(report.points(0).motions_size(), 0);
  EXPECT_THAT(report.points(0).message(), ::testing::HasSubstr("the job is RUNNING, in stage 1 of 3"));
  *fake.allowed_steps = 1'000'000;
}

TEST_F(SweepService, CancelAndErrors) {
  EXPECT_EQ(status_of([&] { client_.sweep("sweeps/nothing"); }), StatusCode::NOT_FOUND);
  EXPECT_EQ(status_of([&] { client_.sweep("jobs/nothing"); }), StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status_of([&] { client_.cancel_sweep("sweeps/nothing"); }), StatusCode::NOT_FOUND);
  auto held = request(2);
  held.set_start_held(true);
  const v1::Sweep made = client_.create_sweep(held).sweep();
  EXPECT_EQ(made.points(0).state(), v1::Job::STATE_HELD);
  EXPECT_FALSE(made.ended());
  EXPECT_TRUE(client_.cancel_sweep(made.name()).ended());
  v1::GetRaoReportRequest rao;
  EXPECT_EQ(status_of([&] { client_.rao(rao); }), StatusCode::INVALID_ARGUMENT) << "neither jobs nor sweep";
  rao.set_sweep(made.name());
  EXPECT_THAT(client_.rao(rao).points(0).message(), ::testing::HasSubstr("no samples yet"));
  v1::GetDecayReportRequest decay;
  decay.set_job("jobs/nothing");
  EXPECT_EQ(status_of([&] { client_.decay(decay); }), StatusCode::NOT_FOUND);
  decay.set_job(made.points(0).job());
  EXPECT_EQ(status_of([&] { client_.decay(decay); }), StatusCode::FAILED_PRECONDITION) << "no channel yet";
}

}  // namespace
}  // namespace seaway
