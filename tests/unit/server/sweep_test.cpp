// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps in queue and store: all jobs or none, one sweep for one request, and what is left when jobs go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "server/convert/input_error.hpp"
#include "server/jobs/queue.hpp"
#include "server/jobs/submission.hpp"
#include "tests/support/fake_cascade.hpp"
#include "tests/support/service_jobs.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::jobs {
namespace {

using namespace seaway::testing;
using store::State;
using ::testing::HasSubstr;

class SweepTest : public ::testing::Test {
 protected:
  static v1::CreateSweepRequest request(int id) {
    v1::CreateSweepRequest r;
    r.set_request_id(request_id(id));
    auto& one = *r.add_cases();
    one.set_name("intact");
    *one.mutable_case_() = small_case();
    r.add_periods_s(1.2);
    r.add_periods_s(1.4);
    return r;
  }
  std::string why_refused(const v1::CreateSweepRequest& r) {
    try {
      queue_.submit_sweep(r);
    } catch (const convert::InputError& error) {
      return error.reason() + " " + error.what();
    }
    return "accepted";
  }
  std::size_t n_jobs() {
    store::ListQuery all;
    all.limit = 1000;
    return store_->list(all).size();
  }
  TempFolder folder_;
  Workspace workspace_{folder_.path()};
  std::unique_ptr<store::JobStore> store_ = seaway::testing::open_store(folder_.path());
  int woken_ = 0;
  Queue queue_{QueueLimits{9, 0}, fake_solver(), workspace_, *store_, [this] { ++woken_; }, [](const std::string&) {}, [](const std::string&) {}};
};

TEST_F(SweepTest, MakesAJobForEachCombinationInOrder) {
  auto r = request(1);
  *r.add_cases() = r.cases(0);
  r.mutable_cases(1)->set_name("damaged");
  r.add_heights_m(0.02);
  r.add_heights_m(0.03);
  r.set_note("why");
  const auto made = queue_.submit_sweep(r);
  ASSERT_TRUE(made.has_sweep);
  ASSERT_EQ(made.sweep.members.size(), 8u);
  EXPECT_EQ(made.reports.size(), 8u);
  EXPECT_EQ(woken_, 1);
  const auto& last = made.sweep.members.back();
  EXPECT_EQ(last.point.case_name, "damaged");
  EXPECT_EQ(last.point.period_s, 1.4);
  EXPECT_EQ(last.point.height_m, 0.03);
  EXPECT_EQ(made.sweep.members[1].point.period_s, 1.4) << "the period goes fastest";
  EXPECT_EQ(made.sweep.members[1].point.height_m, 0.02);
  const auto job = store_->find(last.uid);
  ASSERT_TRUE(job.has_value());
  EXPECT_EQ(job->labels.at("sweep"), made.sweep.uid);
  EXPECT_EQ(job->note, "why");
  EXPECT_THAT(job->title, HasSubstr("(damaged, H 0.03 m, T 1.4 s)"));
  const auto wave = decode_spec(job->spec).case_().wave().regular();
  EXPECT_EQ(wave.period_s(), 1.4);
  EXPECT_EQ(wave.height_m(), 0.03);
}

TEST_F(SweepTest, ARepeatedRequestMakesOneSweepAndAnotherOneIsRefused) {
  const auto first = queue_.submit_sweep(request(1)), again = queue_.submit_sweep(request(1));
  EXPECT_EQ(again.sweep.uid, first.sweep.uid);
  EXPECT_EQ(n_jobs(), 2u);
  auto other = request(1);
  other.add_periods_s(1.6);
  EXPECT_THAT(why_refused(other), HasSubstr("REQUEST_ID_REUSED request_id: is in use by sweep " + first.sweep.uid));
  EXPECT_EQ(n_jobs(), 2u);
}

TEST_F(SweepTest, IsThereWholeOrNotAtAll) {
  auto r = request(1);
  for (int i = 0; i < 8; ++i) r.add_periods_s(2 + 0.1 * i);  // ten jobs, nine are allowed
  EXPECT_THROW(queue_.submit_sweep(r), Error);
  EXPECT_EQ(n_jobs(), 0u);
  EXPECT_TRUE(store_->list_sweeps(0, 10).empty());
  auto wrong = request(2);
  wrong.add_periods_s(-1);
  EXPECT_THAT(why_refused(wrong), HasSubstr("periods_s[2]: -1 is not allowed"));
  EXPECT_THAT(why_refused(wrong), HasSubstr("(T -1 s)"));
  EXPECT_EQ(n_jobs(), 0u);
}

TEST_F(SweepTest, RefusesWhatIsNoSweep) {
  v1::CreateSweepRequest r;
  EXPECT_THAT(why_refused(r), HasSubstr("request_id: is missing"));
  r.set_request_id(request_id(1));
  EXPECT_THAT(why_refused(r), HasSubstr("cases: is empty"));
  r = request(1);
  r.mutable_cases(0)->mutable_case_()->mutable_wave()->mutable_calm();
  EXPECT_THAT(why_refused(r), HasSubstr("no regular wave"));
  r = request(1);
  r.add_periods_s(1.2);
  EXPECT_THAT(why_refused(r), HasSubstr("periods_s[2]: 1.2 is there twice"));
  r = request(1);
  *r.add_cases() = r.cases(0);
  EXPECT_THAT(why_refused(r), HasSubstr("used twice"));
  r = request(1);
  (*r.mutable_labels())["sweep"] = "mine";
  EXPECT_THAT(why_refused(r), HasSubstr("labels.sweep"));
  r = request(1);
  for (int i = 0; i < 40; ++i) r.add_periods_s(3 + i), r.add_heights_m(0.001 + 0.001 * i);
  EXPECT_THAT(why_refused(r), HasSubstr("at most 1000"));
  r = request(1);
  r.set_validate_only(true);
  EXPECT_EQ(queue_.submit_sweep(r).reports.size(), 2u);
  EXPECT_EQ(n_jobs(), 0u);
}

TEST_F(SweepTest, CancelLeavesWhatHasEnded) {
  const auto made = queue_.submit_sweep(request(1));
  const std::string first = store_->take_next()->uid;
  store_->move(first, State::running, State::succeeded, store::Reason::none, "");
  const store::Sweep after = queue_.cancel_sweep(made.sweep.uid);
  EXPECT_EQ(after.members[0].state, State::succeeded);
  EXPECT_EQ(after.members[1].state, State::cancelled);
  EXPECT_EQ(queue_.cancel_sweep(made.sweep.uid).members[1].state, State::cancelled) << "again is fine";
  EXPECT_THROW(queue_.cancel_sweep("nothing"), Error);
}

TEST_F(SweepTest, SurvivesARestartAndGoesWithItsLastJob) {
  const auto made = queue_.submit_sweep(request(1));
  queue_.cancel_sweep(made.sweep.uid);
  store_->erase(made.sweep.members[0].uid);
  auto sweep = store_->find_sweep(made.sweep.uid);
  ASSERT_TRUE(sweep.has_value());
  EXPECT_FALSE(sweep->members[0].exists);
  EXPECT_TRUE(sweep->members[1].exists);
  store_->erase(made.sweep.members[1].uid);
  EXPECT_FALSE(store_->find_sweep(made.sweep.uid).has_value());
  EXPECT_THROW(queue_.submit_sweep(request(1)), Error) << "its jobs have been deleted; it is not made again";
  EXPECT_EQ(n_jobs(), 0u);
}

TEST_F(SweepTest, ListsByPagesNewestFirst) {
  for (int i = 1; i <= 4; ++i) queue_.submit_sweep(request(i));
  const auto page = store_->list_sweeps(0, 3);
  ASSERT_EQ(page.size(), 3u);
  EXPECT_EQ(page[0].request_id, request_id(4));
  const auto rest = store_->list_sweeps(page.back().id, 3);
  ASSERT_EQ(rest.size(), 1u);
  EXPECT_EQ(rest[0].request_id, request_id(1));
  EXPECT_EQ(rest[0].members.size(), 2u);
}

}  // namespace
}  // namespace seaway::jobs
