// SPDX-License-Identifier: GPL-3.0-or-later
// What every JobStore promises (there is one implementation so far), and what only the SQLite one does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <fstream>
#include <mutex>
#include <thread>

#include "core/base/error.hpp"
#include "server/store/chunk.hpp"
#include "server/store/database.hpp"
#include "server/store/migrations.hpp"
#include "server/store/sqlite_rows.hpp"
#include "server/store/sqlite_store.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::store {
namespace {

using seaway::testing::TempFolder;

struct Maker {
  const char* name;
  std::function<std::unique_ptr<JobStore>(const std::string& folder)> open;
};

std::unique_ptr<JobStore> open_sqlite(const std::string& folder) {
  SqliteOptions options;
  options.path = folder + "/jobs.db";
  options.commit_interval = std::chrono::milliseconds(5);
  return open_sqlite_store(options);
}

NewJob job(const std::string& uid, const std::string& request = "") {
  return {uid, request.empty() ? "r-" + uid : request, "title " + uid, "digest " + uid, "1.0", "spec " + uid};
}

Sample sample(std::int64_t n, double shift = 0) {
  return {n, static_cast<int>(n / 1000), 2 * n, 0.01 * static_cast<double>(n), {1.0 / static_cast<double>(n) + shift, 2.0}};
}

std::vector<Sample> samples(std::int64_t from, std::int64_t to, double shift = 0) {
  std::vector<Sample> out;
  for (std::int64_t n = from; n <= to; ++n) out.push_back(sample(n, shift));
  return out;
}

int count_events(const JobStore& store, const std::string& uid, const std::string& kind) {
  int n = 0;
  for (const Event& e : store.events(uid)) n += e.kind == kind ? 1 : 0;
  return n;
}

class JobStoreContract : public ::testing::TestWithParam<Maker> {
 protected:
  void reopen() {
    store_.reset();
    store_ = GetParam().open(folder_.path());
  }
  TempFolder folder_;
  std::unique_ptr<JobStore> store_ = GetParam().open(folder_.path());
};

TEST_P(JobStoreContract, RepeatedRequestIdCreatesOneJob) {
  const Created a = store_->create(job("a", "same"));
  const Created b = store_->create(job("b", "same"));
  EXPECT_FALSE(a.existed);
  EXPECT_TRUE(b.existed);
  EXPECT_EQ(b.job.uid, "a");
  EXPECT_EQ(b.job.spec, "spec a");
  EXPECT_EQ(store_->list({}).size(), 1u);
  reopen();
  EXPECT_TRUE(store_->create(job("c", "same")).existed);
}

TEST_P(JobStoreContract, ParallelSubmitsOfOneRequestCreateOneJob) {
  std::vector<std::jthread> threads;
  std::atomic<int> created{0};
  for (int i = 0; i < 16; ++i)
    threads.emplace_back([&, i] { created += store_->create(job("u" + std::to_string(i), "same")).existed ? 0 : 1; });
  threads.clear();
  EXPECT_EQ(created, 1);
}

TEST_P(JobStoreContract, QueueIsOldestFirstAndLimited) {
  for (const char* uid : {"a", "b", "c"}) store_->create(job(uid));
  EXPECT_THROW(store_->create_limited(job("d"), 3), Error);
  EXPECT_TRUE(store_->create_limited(job("x", "r-a"), 3).existed) << "a repeated submit is never refused";
  EXPECT_EQ(store_->take_next()->uid, "a");
  EXPECT_EQ(store_->take_next()->uid, "b");
  const auto c = store_->take_next();
  EXPECT_EQ(c->state, State::running);
  EXPECT_EQ(c->attempt, 1);
  EXPECT_FALSE(store_->take_next());
}

TEST_P(JobStoreContract, MovesAreGuarded) {
  store_->create(job("a"));
  EXPECT_FALSE(store_->move("a", State::running, State::succeeded, Reason::none, ""));
  EXPECT_THROW(store_->move("a", State::queued, State::succeeded, Reason::none, ""), Error);
  EXPECT_THROW(store_->move("nobody", State::queued, State::cancelled, Reason::user, ""), Error);
  EXPECT_TRUE(store_->move("a", State::queued, State::cancelled, Reason::user, "why"));
  const auto a = store_->find("a");
  EXPECT_EQ(a->state, State::cancelled);
  EXPECT_EQ(a->message, "why");
  EXPECT_GT(a->ended_ns, 0);
  EXPECT_FALSE(store_->take_next());
}

TEST_P(JobStoreContract, ListsByPagesInEveryPosition) {
  for (int i = 0; i < 25; ++i) store_->create(job("j" + std::to_string(i)));
  store_->take_next();
  std::vector<std::string> seen;
  ListQuery query;
  query.limit = 7;
  for (;;) {
    const auto page = store_->list(query);
    for (const Job& j : page) seen.push_back(j.uid);
    if (page.size() < 7) break;
    query.before_id = page.back().id;
    store_->create(job("late" + std::to_string(seen.size())));  // does not shift later pages
  }
  ASSERT_EQ(seen.size(), 25u);
  EXPECT_EQ(seen.front(), "j24");
  EXPECT_EQ(seen.back(), "j0");
  query = {};
  query.states = {State::running};
  EXPECT_EQ(store_->list(query).size(), 1u);
}

TEST_P(JobStoreContract, HistoryIsKeptAndReadFromAnyPlace) {
  store_->create(job("a"));
  store_->take_next();
  store_->set_channels("a", {{"heave", "m"}, {"roll", "rad"}});
  const std::int64_t n = 3 * chunk_samples + 77;
  for (std::int64_t at = 1; at <= n; at += 50) store_->add_samples("a", samples(at, std::min(n, at + 49)));
  store_->flush();
  reopen();
  EXPECT_EQ(store_->find("a")->last_sequence, n);
  EXPECT_EQ(store_->channels("a").size(), 2u);
  for (const std::int64_t after : {0L, 1L, 511L, 512L, 513L, 1024L, n - 1}) {
    const auto got = store_->samples("a", after, 600);
    ASSERT_EQ(static_cast<std::int64_t>(got.size()), std::min<std::int64_t>(600, n - after));
    for (std::size_t i = 0; i < got.size(); ++i)
      ASSERT_TRUE(same_bits(got[i], sample(after + 1 + static_cast<std::int64_t>(i))));
  }
  EXPECT_TRUE(store_->samples("a", n, 10).empty());
}

TEST_P(JobStoreContract, ReplayedSamplesChangeNothing) {
  store_->create(job("a"));
  store_->take_next();
  store_->add_samples("a", samples(1, 600));
  store_->add_samples("a", samples(300, 700));
  store_->flush();
  EXPECT_EQ(store_->samples("a", 0, 1000).size(), 700u);
  EXPECT_EQ(count_events(*store_, "a", "REPLAY_MISMATCH"), 0);
}

TEST_P(JobStoreContract, DifferentReplayIsRecordedOnce) {
  store_->create(job("a"));
  store_->take_next();
  store_->add_samples("a", samples(1, 20));
  store_->add_samples("a", samples(11, 15, 1e-12));
  store_->add_samples("a", samples(16, 25, 1e-12));
  store_->flush();
  EXPECT_EQ(count_events(*store_, "a", "REPLAY_MISMATCH"), 1);
  EXPECT_TRUE(same_bits(store_->samples("a", 11, 1).front(), sample(12))) << "the stored one stays";
  EXPECT_EQ(store_->find("a")->last_sequence, 25);
}

TEST_P(JobStoreContract, NoGapEntersTheHistory) {
  store_->create(job("a"));
  store_->take_next();
  store_->add_samples("a", samples(1, 5));
  store_->add_samples("a", samples(7, 9));
  store_->flush();
  EXPECT_EQ(store_->find("a")->last_sequence, 5);
}

TEST_P(JobStoreContract, RecoveryQueuesRunningJobsAgain) {
  for (const char* uid : {"run", "cancel", "wait"}) store_->create(job(uid));
  store_->take_next();
  store_->take_next();
  store_->move("cancel", State::running, State::cancelling, Reason::user, "");
  store_->add_samples("run", samples(1, 3));
  store_->flush();
  reopen();
  const Recovery r = store_->recover(3);
  EXPECT_THAT(r.requeued, ::testing::ElementsAre("run"));
  EXPECT_THAT(r.cancelled, ::testing::ElementsAre("cancel"));
  EXPECT_EQ(store_->find("run")->reason, Reason::server_restart);
  EXPECT_EQ(count_events(*store_, "run", "RECOVERED"), 1);
  const auto again = store_->take_next();
  EXPECT_EQ(again->uid, "run") << "older than what waits";
  EXPECT_EQ(again->attempt, 2);
  EXPECT_EQ(again->last_sequence, 3);
}

TEST_P(JobStoreContract, AttemptsWithoutProgressAreBounded) {
  store_->create(job("a"));
  store_->take_next();
  store_->add_samples("a", samples(1, 1));
  store_->flush();
  EXPECT_EQ(store_->recover(2).requeued.size(), 1u);  // got on: counts anew
  store_->take_next();
  EXPECT_EQ(store_->recover(2).requeued.size(), 1u);
  store_->take_next();
  EXPECT_EQ(store_->recover(2).failed.size(), 1u);
  EXPECT_EQ(store_->find("a")->reason, Reason::worker_crash);
}

TEST_P(JobStoreContract, FaultsOfTheWorkerAreRetriedUntilTheyAreTooMany) {
  store_->create(job("a"));
  store_->take_next();
  store_->add_samples("a", samples(1, 3));
  EXPECT_EQ(store_->end_by_fault("a", Reason::worker_crash, "SIGSEGV", 2)->state, State::queued) << "1st, with progress";
  EXPECT_FALSE(store_->end_by_fault("a", Reason::worker_crash, "late", 2)) << "it does not run";
  store_->take_next();
  store_->add_samples("a", samples(4, 4));
  EXPECT_EQ(store_->end_by_fault("a", Reason::memory, "", 2)->faults, 1) << "new samples begin the count anew";
  EXPECT_EQ(store_->take_next()->attempt, 3);
  const auto failed = store_->end_by_fault("a", Reason::memory, "no more", 2);
  EXPECT_EQ(failed->state, State::failed);
  EXPECT_EQ(failed->reason, Reason::memory);
  EXPECT_EQ(failed->message, "no more");
  store_->create(job("b"));
  store_->take_next();
  store_->add_run_time("b", 1500);
  store_->add_run_time("b", 20);
  store_->move("b", State::running, State::cancelling, Reason::user, "");
  const auto cancelled = store_->end_by_fault("b", Reason::worker_crash, "SIGSEGV", 2);
  EXPECT_EQ(cancelled->state, State::cancelled) << "its user did not want it any more";
  EXPECT_EQ(cancelled->run_ms, 1520);
}

TEST_P(JobStoreContract, KeepsStagesCheckpointsAndArtifacts) {
  store_->create(job("a"));
  store_->put_stage("a", {1, "one"});
  store_->put_stage("a", {0, "zero"});
  store_->put_stage("a", {1, std::string("new\0er", 6)});
  store_->add_checkpoint("a", {10, "/x/c1", 5, 6, 7});
  store_->add_checkpoint("a", {20, "/x/c2", 5, 6, ~std::uint64_t{0}});
  store_->add_artifact("a", {"s.json", "/x/s.json", "application/json", 12, 0});
  store_->set_progress("a", {1, 3, 2.5, 0.4, 12, true});
  store_->flush();
  reopen();
  ASSERT_EQ(store_->stages("a").size(), 2u);
  EXPECT_EQ(store_->stages("a")[1].report, std::string("new\0er", 6));
  EXPECT_EQ(store_->checkpoints("a").back().inode, ~std::uint64_t{0});
  EXPECT_EQ(store_->find("a")->checkpoint_sequence, 20);
  EXPECT_EQ(store_->artifacts("a").at(0).size, 12);
  EXPECT_EQ(store_->find("a")->progress.stage_count, 3);
  EXPECT_TRUE(store_->find("a")->progress.held);
}

TEST_P(JobStoreContract, EraseNeedsAnEndedJob) {
  store_->create(job("a"));
  store_->add_samples("a", samples(1, 5));
  EXPECT_FALSE(store_->erase("a"));
  store_->move("a", State::queued, State::cancelled, Reason::user, "");
  EXPECT_TRUE(store_->erase("a"));
  EXPECT_FALSE(store_->find("a"));
  EXPECT_THROW(store_->erase("a"), Error);
  EXPECT_THROW(store_->samples("a", 0, 1), Error);
}

TEST_P(JobStoreContract, ListenersHearOnlyOfWhatIsVisible) {
  store_->create(job("a"));
  std::mutex mutex;
  std::condition_variable wake;
  std::int64_t seen = 0;
  const auto unsubscribe = store_->subscribe([&](const std::set<std::string>& uids) {
    if (uids.count("a") == 0) return;
    const std::int64_t last = store_->find("a")->last_sequence;
    const std::lock_guard lock(mutex);
    seen = last;
    wake.notify_all();
  });
  store_->add_samples("a", samples(1, 9));
  std::unique_lock lock(mutex);
  EXPECT_TRUE(wake.wait_for(lock, std::chrono::seconds(10), [&] { return seen == 9; }));
  lock.unlock();
  unsubscribe();
}

TEST_P(JobStoreContract, EventsHaveGrowingRevisions) {
  store_->create(job("a"));
  store_->take_next();
  store_->add_event("a", "RELEASED", "the hull is free");
  store_->move("a", State::running, State::failed, Reason::diverged, "too fast");
  const auto events = store_->events("a");
  ASSERT_EQ(events.size(), 4u);
  for (std::size_t i = 1; i < events.size(); ++i) EXPECT_EQ(events[i].revision, events[i - 1].revision + 1);
  EXPECT_EQ(events[3].text, "FAILED DIVERGED: too fast");
}

INSTANTIATE_TEST_SUITE_P(Stores, JobStoreContract, ::testing::Values(Maker{"Sqlite", open_sqlite}),
                         [](const auto& tested) { return tested.param.name; });

TEST(SqliteStore, KeepsASecondServerOut) {
  TempFolder folder;
  const auto store = open_sqlite(folder.path());
  try {
    open_sqlite(folder.path());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::failed_precondition);
  }
}

TEST(SqliteStore, RefusesANewerSchema) {
  TempFolder folder;
  open_sqlite(folder.path());
  {
    Database db(folder / "jobs.db", Database::Role::writer);
    db.execute("PRAGMA user_version=" + std::to_string(schema_version() + 1));
  }
  EXPECT_THROW(open_sqlite(folder.path()), Error);
}

TEST(SqliteStore, RefusesAFileThatIsNoDatabase) {
  TempFolder folder;
  std::ofstream(folder / "jobs.db") << std::string(5000, 'x');
  EXPECT_THROW(open_sqlite(folder.path()), Error);
}

TEST(SqliteStore, OnlyTheWriterMayCheckpointAndReadersMayNotWrite) {
  TempFolder folder;
  const auto store = open_sqlite(folder.path());
  Database reader(folder / "jobs.db", Database::Role::reader);
  EXPECT_THROW(reader.execute("DELETE FROM jobs"), Error);
  Statement query = reader.prepare("PRAGMA wal_autocheckpoint");
  ASSERT_TRUE(query.step());
  EXPECT_EQ(query.integer(0), 0);
}

TEST(JobStates, OnlyTheMovesOfTheTableExist) {
  int moves = 0;
  for (int a = 1; a <= 7; ++a)
    for (int b = 1; b <= 7; ++b) moves += may_move(static_cast<State>(a), static_cast<State>(b)) ? 1 : 0;
  EXPECT_EQ(moves, 12);
  for (const State s : {State::succeeded, State::failed, State::cancelled})
    for (int b = 1; b <= 7; ++b) EXPECT_FALSE(may_move(s, static_cast<State>(b)));
}

TEST(SqliteMemory, ManyFiltersKeepNoStatements) {
  TempFolder folder;
  Database db(folder / "jobs.db", Database::Role::writer);
  migrate(db);
  rows::list(db, {});
  const std::size_t before = db.kept();
  for (int n = 1; n <= 64; ++n) {
    ListQuery query;
    for (int i = 0; i < n; ++i) query.labels["k" + std::to_string(i)] = "v";
    if (n % 2 == 0) query.states = {State::held, State::queued};
    EXPECT_TRUE(rows::list(db, query).empty());
  }
  EXPECT_EQ(db.kept(), before);
}

}  // namespace
}  // namespace seaway::store
