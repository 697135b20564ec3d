// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of the disk and of the files under the store, by their numbers in tests/fault/README.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "server/store/database.hpp"
#include "server/store/migrations.hpp"
#include "server/store/sqlite_store.hpp"
#include "server/store/verify.hpp"
#include "tests/simulation/sim_disk.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::store {
namespace {

using seaway::testing::read_text;
using seaway::testing::SimDisk;
using seaway::testing::TempFolder;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* file = "seaway.db";

NewJob job(const std::string& uid) {
  NewJob j;
  j.uid = uid;
  j.request_id = "request-" + uid;
  j.title = "a job";
  return j;
}

SqliteOptions on(const SimDisk& disk) {
  SqliteOptions options;
  options.path = file;
  options.vfs = disk.name();
  options.own_thread = false;
  options.readers = 1;
  options.now_ns = [] { return std::int64_t{1}; };
  return options;
}

/// A file of the schema before the last, with a job in it.
void make_old_file(SimDisk& disk) {
  Database db(file, Database::Role::writer, disk.name());
  migrate_to(db, schema_version() - 1);
  db.execute("INSERT INTO jobs (uid, request_id, title, state, digest, code_version, spec, created_ns, updated_ns) "
             "VALUES ('old', 'r', 't', 1, 'd', '0', x'00', 1, 1)");
}

TEST(F2, ACrashAtAnyWriteOfAMigrationLeavesTheOldFileOrTheNewOne) {
  int crashes = 0;
  for (const bool power : {false, true})
    for (int n = 1;; ++n) {
      SimDisk disk("migration" + std::to_string(n) + (power ? "p" : ""), static_cast<std::uint64_t>(n));
      make_old_file(disk);
      disk.fail_after(n);
      try {
        open_sqlite_store(on(disk));
      } catch (const Error&) {
      }
      const bool whole = !disk.is_dead();  // it did not take so many
      crashes += whole ? 0 : 1;
      disk.crash(power);
      const auto store = open_sqlite_store(on(disk));
      const auto taken = store->take_next();
      ASSERT_TRUE(taken.has_value()) << "crash at write " << n;
      EXPECT_EQ(taken->uid, "old");
      EXPECT_TRUE(verify_database(file, disk.name()).problems.empty()) << "crash at write " << n;
      if (whole) break;
    }
  EXPECT_GT(crashes, 8);
}

TEST(F6, AfterAFailedSyncNothingIsWrittenUntilTheNextStart) {
  bool all = false;
  int failed = 0;
  // The n-th operation fails and so do all after it: among them are writes, syncs and truncations.
  for (int n = 1; !all; ++n) {
    SimDisk disk("sync" + std::to_string(n), static_cast<std::uint64_t>(n));
    std::vector<std::string> acknowledged;
    {
      auto options = on(disk);
      int told = 0;
      options.sync_failed = [&] { ++told; };
      const auto store = open_sqlite_store(options);
      disk.fail_after(n);
      for (int i = 0; i < 5; ++i) {
        try {
          store->create(job("j" + std::to_string(i)));
          EXPECT_EQ(told, 0) << "acknowledged after a failed sync";
          acknowledged.push_back("j" + std::to_string(i));
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), ErrorCode::unavailable) << error.what();
        }
      }
      EXPECT_LE(told, 1) << "a sync was tried again";
      failed += told;
      all = !disk.is_dead();
      // Even a disk that claims to be well again is not believed.
      if (told > 0) {
        disk.fail_after(-1);
        EXPECT_THROW(store->create(job("later")), Error);
        EXPECT_TRUE(store->is_stuck());
      }
    }
    disk.crash(true);
    const auto store = open_sqlite_store(on(disk));
    for (const std::string& uid : acknowledged) EXPECT_TRUE(store->find(uid).has_value()) << uid << ", failure at " << n;
    EXPECT_NO_THROW(store->create(job("after")));
  }
  EXPECT_GT(failed, 0) << "no sync has failed";
}

class F8 : public ::testing::Test {
 protected:
  SqliteOptions options() {
    SqliteOptions out;
    out.path = folder_ / "jobs.db";
    out.commit_interval = std::chrono::milliseconds(5);
    return out;
  }
  /// A database as a killed server leaves it: file, log and index of the log, with 20 jobs and a history.
  void leave() {
    auto store = open_sqlite_store(options());
    for (int i = 0; i < 20; ++i) store->create(job("j" + std::to_string(i)));
    store->flush();
    for (const char* end : {"", "-wal", "-shm"}) fs::copy_file(folder_ / ("jobs.db" + std::string(end)), folder_ / ("kept" + std::string(end)));
    store.reset();
    for (const char* end : {"", "-wal", "-shm"}) {
      fs::remove(folder_ / ("jobs.db" + std::string(end)));
      fs::rename(folder_ / ("kept" + std::string(end)), folder_ / ("jobs.db" + std::string(end)));
    }
  }
  std::size_t jobs(JobStore& store) {
    ListQuery all;
    all.limit = 1000;
    return store.list(all).size();
  }
  TempFolder folder_;
};

TEST_F(F8, WithoutTheIndexOfTheLogNothingIsLost) {
  leave();
  fs::remove(folder_ / "jobs.db-shm");
  EXPECT_EQ(jobs(*open_sqlite_store(options())), 20u);
}

TEST_F(F8, ACutLogGivesTheJobsUpToTheCutAndStaysSound) {
  leave();
  const auto whole = fs::file_size(folder_ / "jobs.db-wal");
  ASSERT_GT(whole, 20'000u);
  std::size_t before = 20;
  for (const double part : {0.9, 0.6, 0.3, 0.0}) {
    const TempFolder other;
    for (const char* end : {"", "-wal"}) fs::copy_file(folder_ / ("jobs.db" + std::string(end)), other / ("jobs.db" + std::string(end)));
    fs::resize_file(other / "jobs.db-wal", static_cast<std::uintmax_t>(part * static_cast<double>(whole)));
    auto cut = options();
    cut.path = other / "jobs.db";
    const auto store = open_sqlite_store(cut);
    const std::size_t now = jobs(*store);
    EXPECT_LE(now, before);
    before = now;
    EXPECT_TRUE(verify_database(cut.path).problems.empty());
    EXPECT_NO_THROW(store->create(job("new")));
  }
  EXPECT_LT(before, 20u);
}

TEST_F(F8, AFlippedBitIsFoundByVerifyAndNamed) {
  {
    auto store = open_sqlite_store(options());
    for (int i = 0; i < 200; ++i) store->create(job("j" + std::to_string(i)));
  }
  const std::string sound = read_text(folder_ / "jobs.db");
  ASSERT_TRUE(verify_database(folder_ / "jobs.db").problems.empty());
  int found = 0;
  for (std::size_t page = 1; page < sound.size() / 4096; ++page) {
    std::string damaged = sound;
    damaged[page * 4096 + 3] = static_cast<char>(damaged[page * 4096 + 3] ^ 0x55);  // how many cells the page has
    std::ofstream(folder_ / "damaged.db", std::ios::binary) << damaged;
    try {
      const auto problems = verify_database(folder_ / "damaged.db").problems;
      found += problems.empty() ? 0 : 1;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::data_loss) << error.what();
      ++found;
    }
  }
  // Pages of empty tables and of the free list have no cells to miss.
  EXPECT_GT(found, static_cast<int>(sound.size() / 4096 / 2));
}

TEST_F(F8, AFileThatMayNotBeWrittenStopsTheStartWithItsName) {
  leave();
  const std::string before = read_text(folder_ / "jobs.db");
  for (const char* end : {"", "-wal", "-shm", ".lock"})
    fs::permissions(folder_ / ("jobs.db" + std::string(end)), fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
  fs::permissions(folder_.path(), fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
  const bool root = ::geteuid() == 0;
  if (root) {
    ASSERT_EQ(::seteuid(65534), 0);  // nobody: root may write everything
  }
  std::string why;
  try {
    open_sqlite_store(options());
  } catch (const Error& error) {
    why = error.what();
    EXPECT_EQ(error.code(), ErrorCode::unavailable);
  }
  if (root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_THAT(why, HasSubstr("jobs.db"));
  EXPECT_EQ(read_text(folder_ / "jobs.db"), before);
}

}  // namespace
}  // namespace seaway::store
