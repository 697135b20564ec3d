// SPDX-License-Identifier: GPL-3.0-or-later
// Priorities, labels, changes, retention, retries and envelopes in the SQLite store; its copies and upgrades.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "core/base/error.hpp"
#include "server/store/database.hpp"
#include "server/store/migrations.hpp"
#include "server/store/sqlite_store.hpp"
#include "server/store/verify.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::store {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class JobLife : public ::testing::Test {
 protected:
  static std::unique_ptr<JobStore> open(const std::string& folder) {
    SqliteOptions options;
    options.path = folder + "/jobs.db";
    options.commit_interval = std::chrono::milliseconds(5);
    return open_sqlite_store(options);
  }
  NewJob job(const std::string& uid, int priority = 0) {
    NewJob out{uid, "r-" + uid, "title", "digest", "1", "spec"};
    out.priority = priority;
    return out;
  }
  void end(const std::string& uid) { store_->move(uid, State::running, State::succeeded, Reason::none, ""); }
  void add(const std::string& uid, std::int64_t from, std::int64_t to) {
    std::vector<Sample> list;
    for (std::int64_t n = from; n <= to; ++n) list.push_back({n, 0, n, 0.1 * static_cast<double>(n), {value(n), -value(n)}});
    store_->add_samples(uid, std::move(list));
    store_->flush();
  }
  static double value(std::int64_t n) { return std::sin(0.37 * static_cast<double>(n)) + 1e-4 * static_cast<double>(n % 977); }

  seaway::testing::TempFolder folder_;
  std::unique_ptr<JobStore> store_ = open(folder_.path());
};

TEST_F(JobLife, LargerPrioritiesGoFirstAndEqualOnesInOrder) {
  for (const auto& [uid, priority] : {std::pair{"a", 0}, {"b", 5}, {"c", 5}, {"d", -1}, {"e", 0}}) store_->create(job(uid, priority));
  std::string order;
  while (const auto next = store_->take_next()) order += next->uid;
  EXPECT_EQ(order, "bcaed");
}

TEST_F(JobLife, ACaseIsStoredOnceAndGoesWithTheLastOfItsJobs) {
  const auto cases = [&] {
    Database db(folder_ / "jobs.db", Database::Role::reader);
    Statement query = db.prepare("SELECT count(*) FROM case_specs");
    query.step();
    return query.integer(0);
  };
  NewJob other = job("c");
  other.digest = "other digest";
  other.spec = "other spec";
  for (const NewJob& one : {job("a"), job("b"), other}) store_->create(one);
  EXPECT_EQ(cases(), 2);
  for (int i = 0; i < 3; ++i) end(store_->take_next()->uid);
  EXPECT_TRUE(store_->erase("a"));
  EXPECT_EQ(cases(), 2);
  EXPECT_EQ(store_->find("b")->spec, "spec");
  EXPECT_TRUE(store_->erase("b"));
  EXPECT_EQ(cases(), 1);
  EXPECT_EQ(store_->find("c")->spec, "other spec");
  EXPECT_TRUE(verify_database(folder_ / "jobs.db").problems.empty());
  Database(folder_ / "jobs.db", Database::Role::writer).execute("UPDATE case_uses SET jobs = 7");
  EXPECT_THAT(verify_database(folder_ / "jobs.db").problems, ElementsAre(HasSubstr("case_uses: the case of job c is counted 7 times")));
  Database(folder_ / "jobs.db", Database::Role::writer).execute("UPDATE case_uses SET jobs = 1; DELETE FROM case_specs");
  EXPECT_THAT(verify_database(folder_ / "jobs.db").problems, ElementsAre(HasSubstr("case_specs: the case of job c is missing")));
}

TEST_F(JobLife, NoJobStarvesHoweverManyImportantOnesCome) {
  store_->create(job("low", 0));
  for (int started = 0;; ++started) {
    ASSERT_LE(started, 32) << "ten jobs for each point of priority, and the one that was there";
    store_->create(job("high" + std::to_string(started), 3));
    if (store_->take_next()->uid == "low") break;
  }
}

TEST_F(JobLife, AHeldJobKeepsItsPlaceAndIsNotTaken) {
  store_->create(job("a"));
  store_->create(job("b"));
  store_->move("a", State::queued, State::held, Reason::user, "");
  EXPECT_EQ(store_->take_next()->uid, "b");
  EXPECT_FALSE(store_->take_next());
  store_->create(job("c"));
  store_->move("a", State::held, State::queued, Reason::user, "");
  EXPECT_EQ(store_->take_next()->uid, "a");
  NewJob held = job("d");
  held.held = true;
  EXPECT_EQ(store_->create(held).job.state, State::held);
}

TEST_F(JobLife, LabelsNotesAndPriorityCanBeChangedAndAskedFor) {
  NewJob a = job("a");
  a.labels = {{"ship", "dtmb"}, {"sweep", "7"}};
  a.note = "first";
  store_->create(a);
  store_->create(job("b"));
  EXPECT_EQ(store_->find("a")->labels, a.labels);
  JobUpdate update;
  update.labels = Labels{{"ship", "wigley"}};
  update.priority = 9;
  const Job changed = store_->update("a", update);
  EXPECT_EQ(changed.labels, *update.labels);
  EXPECT_EQ(changed.note, "first") << "what is not named stays";
  ListQuery query;
  query.labels = {{"ship", "wigley"}};
  ASSERT_EQ(store_->list(query).size(), 1u);
  query.labels["sweep"] = "7";
  EXPECT_TRUE(store_->list(query).empty());
  EXPECT_THROW(store_->update("nobody", update), Error);
}

TEST_F(JobLife, ChangesHaveNoGapsAlsoOverDeletesRefusalsAndRestarts) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const std::string uid = "j" + std::to_string(i);
    store_->create(job(uid));
    try {
      store_->move(uid, State::queued, State::succeeded, Reason::none, "");  // no such move: undone
    } catch (const Error&) {
    }
    if (random() % 3 == 0) store_->move(uid, State::queued, State::cancelled, Reason::user, "");
    if (random() % 2 == 0 && store_->erase(uid)) {
      EXPECT_FALSE(store_->find(uid));
    }
    if (i == 100) {
      store_.reset();
      store_ = open(folder_.path());
    }
  }
  const ChangeRange range = store_->change_range();
  EXPECT_EQ(range.first, 1);
  std::int64_t next = 1;
  for (const Change& c : store_->changes(0, 10000)) EXPECT_EQ(c.revision, next++);
  EXPECT_EQ(next, range.latest + 1);
  store_->prune(50, 0);
  EXPECT_EQ(store_->change_range().first, range.latest - 49);
  EXPECT_EQ(store_->change_range().latest, range.latest);
}

TEST_F(JobLife, ADeletedRequestIsRemembered) {
  store_->create(job("a"));
  store_->move("a", State::queued, State::cancelled, Reason::user, "");
  EXPECT_TRUE(store_->erase("a"));
  try {
    store_->create(job("a"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::failed_precondition);
    EXPECT_THAT(error.what(), HasSubstr("has been deleted"));
  }
  store_->prune(1000, std::int64_t{1} << 62);
  EXPECT_FALSE(store_->create(job("a")).existed) << "but not for ever";
}

TEST_F(JobLife, EndedJobsAreFoundByAge) {
  for (const char* uid : {"a", "b"}) store_->create(job(uid));
  store_->take_next();
  end("a");
  EXPECT_THAT(store_->ended_before(std::int64_t{1} << 62, 10), ElementsAre("a"));
  EXPECT_TRUE(store_->ended_before(1, 10).empty());
}

TEST_F(JobLife, ARetryHasTheHistoryUpToItsCheckpoint) {
  store_->create(job("a"));
  store_->take_next();
  store_->set_channels("a", {{"heave", "m"}, {"roll", "rad"}});
  add("a", 1, 1300);
  store_->put_stage("a", {0, "report"});
  store_->move("a", State::running, State::failed, Reason::diverged, "");
  NewJob again = job("b");
  again.base_uid = "a";
  again.held = true;
  store_->create(again);
  const Job ready = store_->adopt_history("b", "a", {1111, "/b/c", 1, 1, 1});
  EXPECT_EQ(ready.state, State::queued);
  EXPECT_EQ(ready.last_sequence, 1111);
  EXPECT_EQ(ready.checkpoint_sequence, 1111);
  EXPECT_EQ(ready.base_uid, "a");
  const auto left = store_->samples("a", 0, 1111), right = store_->samples("b", 0, 5000);
  ASSERT_EQ(right.size(), 1111u);
  for (std::size_t i = 0; i < right.size(); ++i) EXPECT_TRUE(same_bits(left[i], right[i]));
  EXPECT_EQ(store_->stages("b").size(), 1u);
  EXPECT_THROW(store_->adopt_history("b", "a", {1, "/b/d", 1, 1, 1}), Error) << "only once";
  store_.reset();
  EXPECT_THAT(verify_database(folder_ / "jobs.db").problems, ElementsAre());
}

TEST_F(JobLife, EnvelopesHoldTheSmallestAndLargestValueOfEveryPart) {
  store_->create(job("a"));
  store_->take_next();
  constexpr std::int64_t n = 20'000;
  for (std::int64_t at = 1; at <= n; at += 900) add("a", at, std::min(at + 899, n));
  std::mt19937 random(3);
  for (int trial = 0; trial < 60; ++trial) {
    const std::int64_t after = trial < 5 ? 0 : static_cast<std::int64_t>(random() % n);
    const std::int64_t until = trial < 5 ? n : after + 1 + static_cast<std::int64_t>(random() % (n - after));
    const int most = std::array{2, 10, 100, 1000, 10'000}[static_cast<std::size_t>(trial % 5)];
    const auto points = store_->envelope("a", after, until, most);
    ASSERT_FALSE(points.empty());
    ASSERT_LE(points.size(), static_cast<std::size_t>(most));
    EXPECT_EQ(points.front().first, after + 1);
    EXPECT_EQ(points.back().last, until);
    std::int64_t next = after + 1;
    for (const EnvelopePoint& p : points) {
      ASSERT_EQ(p.first, next);
      double low = value(p.first), high = low;
      for (std::int64_t s = p.first; s <= p.last; ++s) low = std::min(low, value(s)), high = std::max(high, value(s));
      ASSERT_EQ(p.minimum[0], low);
      ASSERT_EQ(p.maximum[0], high);
      ASSERT_EQ(p.maximum[1], -low);
      ASSERT_EQ(p.time, 0.1 * static_cast<double>(p.first));
      next = p.last + 1;
    }
    EXPECT_GE(static_cast<double>(points.size()), std::min<double>(static_cast<double>(until - after), most) / 32) << "not too few";
  }
  EXPECT_TRUE(store_->envelope("a", n, 0, 10).empty());
}

TEST_F(JobLife, BackupIsTheWholeDatabaseWhileItIsInUse) {
  store_->create(job("a"));
  store_->take_next();
  add("a", 1, 700);
  backup_database(folder_ / "jobs.db", folder_ / "copy.db");
  const Verification copy = verify_database(folder_ / "copy.db");
  EXPECT_EQ(copy.jobs, 1);
  EXPECT_EQ(copy.samples, 700);
  EXPECT_TRUE(copy.problems.empty());
  EXPECT_THROW(backup_database(folder_ / "jobs.db", folder_ / "copy.db"), Error) << "never over another file";
  add("a", 701, 702);
  EXPECT_EQ(store_->find("a")->last_sequence, 702);
}

TEST_F(JobLife, VerifyNamesTableAndJobOfADamage) {
  store_->create(job("a"));
  store_->take_next();
  add("a", 1, 700);
  store_.reset();
  {
    Database db(folder_ / "jobs.db", Database::Role::writer);
    db.execute("UPDATE sample_chunks SET crc = crc + 1 WHERE first_sequence = 513");
    db.execute("UPDATE jobs SET checkpoint_sequence = 900");
  }
  const auto problems = verify_database(folder_ / "jobs.db").problems;
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0], HasSubstr("sample_chunks: job a: a chunk of samples is damaged"));
  EXPECT_THAT(problems[1], HasSubstr("the checkpoint after 900 is ahead of the history"));
}

std::vector<std::string> schema_of(const std::string& path) {
  Database db(path, Database::Role::reader);
  std::vector<std::string> out;
  Statement query = db.prepare("SELECT name, tbl_name, type FROM sqlite_schema WHERE name NOT LIKE 'sqlite_%' ORDER BY name");
  while (query.step()) out.push_back(query.text(0) + " " + query.text(1) + " " + query.text(2));
  Statement columns = db.prepare("SELECT m.name, c.name, c.type, c.dflt_value FROM sqlite_schema m, pragma_table_info(m.name) c "
                                 "WHERE m.type = 'table' ORDER BY 1, 2");
  while (columns.step()) out.push_back(columns.text(0) + "." + columns.text(1) + " " + columns.text(2) + " " + columns.text(3));
  return out;
}

TEST(Migrations, EveryOlderFileBecomesLikeANewOneAndIsCopiedFirst) {
  seaway::testing::TempFolder folder;
  SqliteOptions fresh;
  fresh.path = folder / "fresh.db";
  open_sqlite_store(fresh);
  for (int version = 1; version < schema_version(); ++version) {
    SqliteOptions old;
    old.path = folder / ("old" + std::to_string(version) + ".db");
    {
      Database db(old.path, Database::Role::writer);
      migrate_to(db, version);
      db.execute("INSERT INTO jobs (uid, request_id, title, state, digest, code_version, spec, created_ns, updated_ns) "
                 "VALUES ('old', 'r', 't', 1, 'd', '0', x'00', 1, 1), ('same case', 's', 't', 1, 'd', '0', x'00', 2, 2), "
                 "('other case', 'o', 't', 1, 'e', '0', x'0102', 3, 3)");
    }
    {
      const auto store = open_sqlite_store(old);
      const auto taken = store->take_next();
      EXPECT_EQ(taken->uid, "old");
      EXPECT_EQ(taken->spec, std::string(1, '\0'));
      EXPECT_EQ(store->find("same case")->spec, std::string(1, '\0'));
      EXPECT_EQ(store->find("other case")->spec, "\1\2");
      EXPECT_THAT(verify_database(old.path).problems, IsEmpty()) << "from schema " << version;
      for (const char* uid : {"same case", "other case"}) {
        store->move(uid, State::queued, State::cancelled, Reason::user, "");
        EXPECT_TRUE(store->erase(uid));
      }
      EXPECT_EQ(store->find("old")->spec, std::string(1, '\0')) << "the case went with one of its jobs";
    }
    EXPECT_EQ(schema_of(old.path), schema_of(fresh.path));
    Database copy(old.path + ".schema" + std::to_string(version), Database::Role::reader);
    EXPECT_EQ(version_of(copy), version);
  }
}

}  // namespace
}  // namespace seaway::store
