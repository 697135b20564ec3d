// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/store/sqlite_store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <iterator>
#include <map>
#include <mutex>

#include "core/base/error.hpp"
#include "server/store/migrations.hpp"
#include "server/store/sqlite_rows.hpp"
#include "server/store/writer.hpp"

namespace seaway::store {
namespace {

std::int64_t system_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Held as long as the object lives; the system frees it when the process dies, however it dies.
class LockFile {
 public:
  explicit LockFile(const std::string& path) : fd_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    if (fd_ < 0) fail(ErrorCode::unavailable, "{}: {}", path, std::strerror(errno));
    if (::flock(fd_, LOCK_EX | LOCK_NB) == 0) return;
    ::close(fd_);
    fail(ErrorCode::failed_precondition, "{} is locked: another server uses this data; stop it or choose another data_dir",
         path);
  }
  ~LockFile() { ::close(fd_); }
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

 private:
  int fd_;
};

class ReaderPool {
 public:
  ReaderPool(const std::string& path, int n) {
    for (int i = 0; i < n; ++i) free_.push_back(std::make_unique<Database>(path, Database::Role::reader));
  }
  template <class F>
  auto use(F f) {
    std::unique_ptr<Database> db;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return !free_.empty(); });
      db = std::move(free_.back());
      free_.pop_back();
    }
    struct Return {
      ReaderPool& pool;
      std::unique_ptr<Database>& db;
      ~Return() {
        const std::lock_guard lock(pool.mutex_);
        pool.free_.push_back(std::move(db));
        pool.wake_.notify_one();
      }
    } back{*this, db};
    return f(*db);
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<std::unique_ptr<Database>> free_;  // guarded by mutex_
};

constexpr std::string_view job_columns =
    "id, uid, request_id, title, state, reason, message, attempt, stalled_attempts, digest, code_version, "
    "created_ns, started_ns, ended_ns, updated_ns, stage, stage_count, time_s, fraction, remaining_s, held, "
    "last_sequence, checkpoint_sequence";

Job read_job(const Statement& row, bool with_spec) {
  Job j;
  j.id = row.integer(0);
  j.uid = row.text(1);
  j.request_id = row.text(2);
  j.title = row.text(3);
  j.state = static_cast<State>(row.integer(4));
  j.reason = static_cast<Reason>(row.integer(5));
  j.message = row.text(6);
  j.attempt = static_cast<int>(row.integer(7));
  j.stalled_attempts = static_cast<int>(row.integer(8));
  j.digest = row.text(9);
  j.code_version = row.text(10);
  j.created_ns = row.integer(11);
  j.started_ns = row.integer(12);
  j.ended_ns = row.integer(13);
  j.updated_ns = row.integer(14);
  j.progress = {static_cast<int>(row.integer(15)), static_cast<int>(row.integer(16)), row.real(17), row.real(18),
                row.real(19), row.integer(20) != 0};
  j.last_sequence = row.integer(21);
  j.checkpoint_sequence = row.integer(22);
  if (with_spec) j.spec = row.text(23);
  return j;
}

std::optional<Job> find_job(Database& db, std::string_view column, const std::string& value) {
  Statement query = db.prepare("SELECT " + std::string(job_columns) + ", spec FROM jobs WHERE " + std::string(column) + " = ?");
  if (!query.bind(value).step()) return std::nullopt;
  return read_job(query, true);
}

/// One guarded move with its event; false if the job was not in `from`.
bool apply_move(Database& db, const std::string& uid, State from, State to, Reason reason, const std::string& message,
                std::int64_t now) {
  if (!may_move(from, to))
    fail(ErrorCode::failed_precondition, "job {}: {} -> {} is no move", uid, to_string(from), to_string(to));
  db.prepare("UPDATE jobs SET state = ?, reason = ?, message = ?, updated_ns = ?, ended_ns = ? WHERE uid = ? AND state = ?")
      .bind(static_cast<int>(to), static_cast<int>(reason), message, now, is_terminal(to) ? now : std::int64_t{0}, uid,
            static_cast<int>(from))
      .run();
  if (db.changes() == 0) return false;
  if (from == State::running || from == State::cancelling)
    db.prepare("UPDATE attempts SET ended_ns = ?, outcome = ? WHERE (job, attempt) = (SELECT id, attempt FROM jobs WHERE uid = ?)")
        .bind(now, std::string(to_string(to)), uid)
        .run();
  std::string text(to_string(to));
  if (reason != Reason::none) text += " " + std::string(to_string(reason));
  if (!message.empty()) text += ": " + message;
  rows::add_event(db, uid, "STATE", text, now);
  return true;
}

class SqliteStore final : public JobStore {
 public:
  explicit SqliteStore(SqliteOptions o)
      : now_ns_(o.now_ns ? o.now_ns : system_now_ns),
        warn_(o.warn ? o.warn : [](const std::string&) {}),
        lock_(o.path + ".lock"),
        prepared_(prepare_file(o.path)),
        readers_(o.path, std::max(1, o.readers)),
        writer_(o.path, o.commit_interval, [this](const auto& uids) { publish(uids); }, warn_) {}

  Created create(const NewJob& job) override { return create_limited(job, 0); }

  Created create_limited(const NewJob& job, int limit) override {
    Created out;
    writer_.call([&](Database& db, std::set<std::string>& touched) {
      if (auto known = find_job(db, "request_id", job.request_id)) {
        out = {std::move(*known), true};
        return;
      }
      if (limit > 0) {
        Statement query = db.prepare("SELECT count(*) FROM (SELECT 1 FROM jobs WHERE state = 1 LIMIT ?)");
        query.bind(limit);
        if (query.step() && query.integer(0) >= limit)
          fail(ErrorCode::resource_exhausted, "{} jobs are waiting, which is the limit; submit again later", limit);
      }
      const std::int64_t now = now_ns_();
      db.prepare("INSERT INTO jobs (uid, request_id, title, state, digest, code_version, spec, created_ns, updated_ns) "
                 "VALUES (?, ?, ?, 1, ?, ?, ?, ?, ?)")
          .bind(job.uid, job.request_id, job.title, job.digest, job.code_version, Statement::Blob{job.spec}, now, now)
          .run();
      rows::add_event(db, job.uid, "STATE", "QUEUED", now);
      out = {*find_job(db, "uid", job.uid), false};
      touched.insert(job.uid);
    });
    return out;
  }

  std::optional<Job> find(const std::string& uid) const override {
    return readers_.use([&](Database& db) { return find_job(db, "uid", uid); });
  }

  std::vector<Job> list(const ListQuery& query) const override {
    std::string sql = "SELECT " + std::string(job_columns) + " FROM jobs WHERE id < ?";
    std::vector<State> states = query.states;
    std::sort(states.begin(), states.end());
    states.erase(std::unique(states.begin(), states.end()), states.end());
    for (std::size_t i = 0; i < states.size(); ++i) {
      sql += i == 0 ? " AND state IN (" : ", ";
      sql += std::to_string(static_cast<int>(states[i]));
    }
    if (!states.empty()) sql += ")";
    sql += " ORDER BY id DESC LIMIT ?";
    return readers_.use([&](Database& db) {
      std::vector<Job> out;
      Statement rows = db.prepare(sql);
      rows.bind(query.before_id > 0 ? query.before_id : std::int64_t{1} << 62, query.limit);
      while (rows.step()) out.push_back(read_job(rows, false));
      return out;
    });
  }

  std::optional<Job> take_next() override {
    std::optional<Job> out;
    writer_.call([&](Database& db, std::set<std::string>& touched) {
      out.reset();
      std::string uid;
      {
        Statement query = db.prepare("SELECT uid FROM jobs WHERE state = 1 ORDER BY id LIMIT 1");
        if (!query.step()) return;
        uid = query.text(0);
      }
      const std::int64_t now = now_ns_();
      db.prepare("UPDATE jobs SET attempt = attempt + 1, attempt_sequence = last_sequence, started_ns = "
                 "CASE started_ns WHEN 0 THEN ? ELSE started_ns END WHERE uid = ?")
          .bind(now, uid)
          .run();
      db.prepare("INSERT INTO attempts (job, attempt, first_sequence, started_ns) "
                 "SELECT id, attempt, last_sequence + 1, ? FROM jobs WHERE uid = ?")
          .bind(now, uid)
          .run();
      apply_move(db, uid, State::queued, State::running, Reason::none, "", now);
      out = find_job(db, "uid", uid);
      touched.insert(uid);
    });
    return out;
  }

  std::optional<Job> move(const std::string& uid, State from, State to, Reason reason,
                          const std::string& message) override {
    std::optional<Job> out;
    writer_.call([&](Database& db, std::set<std::string>& touched) {
      out.reset();
      rows::job_id(db, uid);
      if (!apply_move(db, uid, from, to, reason, message, now_ns_())) return;
      out = find_job(db, "uid", uid);
      touched.insert(uid);
    });
    return out;
  }

  Recovery recover(int max_stalled) override {
    Recovery out;
    writer_.call([&](Database& db, std::set<std::string>& touched) {
      out = {};
      struct Row {
        std::string uid;
        State state;
        bool stalled;
        int count;
      };
      std::vector<Row> found;
      {
        Statement query = db.prepare(
            "SELECT uid, state, last_sequence <= attempt_sequence, stalled_attempts FROM jobs WHERE state IN (3, 4) ORDER BY id");
        while (query.step())
          found.push_back({query.text(0), static_cast<State>(query.integer(1)), query.integer(2) != 0,
                           static_cast<int>(query.integer(3))});
      }
      const std::int64_t now = now_ns_();
      for (const Row& row : found) {
        touched.insert(row.uid);
        const int stalled = row.stalled ? row.count + 1 : 0;
        db.prepare("UPDATE jobs SET stalled_attempts = ? WHERE uid = ?").bind(stalled, row.uid).run();
        if (row.state == State::cancelling) {
          apply_move(db, row.uid, row.state, State::cancelled, Reason::user, "the server stopped while cancelling", now);
          out.cancelled.push_back(row.uid);
        } else if (stalled >= max_stalled) {
          apply_move(db, row.uid, row.state, State::failed, Reason::worker_crash,
                     "the server ended " + std::to_string(stalled) + " times in a row without a new sample of this job", now);
          out.failed.push_back(row.uid);
        } else {
          rows::add_event(db, row.uid, "RECOVERED", "the server had ended during this attempt", now);
          apply_move(db, row.uid, row.state, State::queued, Reason::server_restart, "", now);
          out.requeued.push_back(row.uid);
        }
      }
    });
    return out;
  }

  bool erase(const std::string& uid) override {
    bool erased = false;
    writer_.call([&](Database& db, std::set<std::string>& touched) {
      rows::job_id(db, uid);
      db.prepare("DELETE FROM jobs WHERE uid = ? AND state IN (5, 6, 7)").bind(uid).run();
      erased = db.changes() > 0;
      touched.insert(uid);
    });
    return erased;
  }

  void set_channels(const std::string& uid, std::vector<Channel> channels) override {
    post(uid, [channels = std::move(channels)](Database& db, const std::string& job, std::int64_t) {
      rows::set_channels(db, job, channels);
    });
  }
  /// Samples come one by one and often: those of a commit interval are written together. What was handed over
  /// later than them still comes after them.
  void add_samples(const std::string& uid, std::vector<Sample> samples) override {
    std::shared_ptr<std::vector<Sample>> fresh;
    {
      const std::lock_guard lock(waiting_mutex_);
      auto& waiting = waiting_[uid];
      if (waiting == nullptr) waiting = fresh = std::make_shared<std::vector<Sample>>();
      waiting->insert(waiting->end(), std::make_move_iterator(samples.begin()), std::make_move_iterator(samples.end()));
    }
    if (fresh == nullptr) return;
    post(uid, [this, fresh](Database& db, const std::string& job, std::int64_t now) {
      {
        const std::lock_guard lock(waiting_mutex_);  // from here on nobody adds to it
        if (const auto waiting = waiting_.find(job); waiting != waiting_.end() && waiting->second == fresh)
          waiting_.erase(waiting);
      }
      rows::add_samples(db, job, *fresh, now);
    });
  }
  void set_progress(const std::string& uid, const Progress& progress) override {
    post(uid, [progress](Database& db, const std::string& job, std::int64_t now) {
      rows::set_progress(db, job, progress, now);
    });
  }
  void put_stage(const std::string& uid, StageRow stage) override {
    post(uid, [stage = std::move(stage)](Database& db, const std::string& job, std::int64_t) {
      rows::put_stage(db, job, stage);
    });
  }
  void add_checkpoint(const std::string& uid, Checkpoint checkpoint) override {
    post(uid, [checkpoint = std::move(checkpoint)](Database& db, const std::string& job, std::int64_t now) {
      rows::add_checkpoint(db, job, checkpoint, now);
    });
  }
  void add_artifact(const std::string& uid, Artifact artifact) override {
    post(uid, [artifact = std::move(artifact)](Database& db, const std::string& job, std::int64_t now) {
      rows::add_artifact(db, job, artifact, now);
    });
  }
  void add_event(const std::string& uid, const std::string& kind, const std::string& text) override {
    post(uid, [kind, text](Database& db, const std::string& job, std::int64_t now) {
      rows::add_event(db, job, kind, text, now);
    });
  }
  void flush() override { writer_.flush(); }

  std::vector<Channel> channels(const std::string& uid) const override {
    return readers_.use([&](Database& db) { return rows::channels(db, uid); });
  }
  std::vector<Sample> samples(const std::string& uid, std::int64_t after, int limit) const override {
    return readers_.use([&](Database& db) { return rows::samples(db, uid, after, limit); });
  }
  std::vector<StageRow> stages(const std::string& uid) const override {
    return readers_.use([&](Database& db) { return rows::stages(db, uid); });
  }
  std::vector<Checkpoint> checkpoints(const std::string& uid) const override {
    return readers_.use([&](Database& db) { return rows::checkpoints(db, uid); });
  }
  std::vector<Artifact> artifacts(const std::string& uid) const override {
    return readers_.use([&](Database& db) { return rows::artifacts(db, uid); });
  }
  std::vector<Event> events(const std::string& uid) const override {
    return readers_.use([&](Database& db) { return rows::events(db, uid); });
  }

  std::function<void()> subscribe(Listener listener) override {
    const std::lock_guard lock(listeners_mutex_);
    const int key = next_listener_++;
    listeners_.emplace(key, std::move(listener));
    return [this, key] {
      const std::lock_guard inner(listeners_mutex_);
      listeners_.erase(key);
    };
  }

 private:
  /// Migrates and checks the file before any other connection opens it.
  static bool prepare_file(const std::string& path) {
    struct stat info {};
    const bool unclean = ::stat((path + "-wal").c_str(), &info) == 0 && info.st_size > 0;
    Database db(path, Database::Role::writer);
    if (unclean) {
      Statement check = db.prepare("PRAGMA quick_check(1)");
      if (!check.step() || check.text(0) != "ok")
        fail(ErrorCode::data_loss, "{} is damaged: {}; restore a copy", path, check.text(0));
    }
    migrate(db);
    return true;
  }

  template <class F>
  void post(const std::string& uid, F f) {
    writer_.post([this, uid, f = std::move(f)](Database& db, std::set<std::string>& touched) {
      f(db, uid, now_ns_());
      touched.insert(uid);
    });
  }

  void publish(const std::set<std::string>& uids) {
    if (uids.empty()) return;
    const std::lock_guard lock(listeners_mutex_);
    for (const auto& [key, listener] : listeners_) listener(uids);
  }

  const std::function<std::int64_t()> now_ns_;
  const std::function<void(const std::string&)> warn_;
  const LockFile lock_;
  const bool prepared_;
  mutable ReaderPool readers_;
  std::mutex waiting_mutex_;
  std::map<std::string, std::shared_ptr<std::vector<Sample>>> waiting_;  // guarded by waiting_mutex_
  std::mutex listeners_mutex_;
  std::map<int, Listener> listeners_;  // guarded by listeners_mutex_
  int next_listener_ = 1;              // guarded by listeners_mutex_
  Writer writer_;                      // last: its thread calls publish()
};

}  // namespace

std::unique_ptr<JobStore> open_sqlite_store(SqliteOptions options) {
  return std::make_unique<SqliteStore>(std::move(options));
}

}  // namespace seaway::store
