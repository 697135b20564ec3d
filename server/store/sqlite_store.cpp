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
  ReaderPool(const std::string& path, const std::string& vfs, int n) {
    for (int i = 0; i < n; ++i) free_.push_back(std::make_unique<Database>(path, Database::Role::reader, vfs));
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

class SqliteStore final : public JobStore {
 public:
  explicit SqliteStore(SqliteOptions o)
      : now_ns_(o.now_ns ? o.now_ns : system_now_ns),
        warn_(o.warn ? o.warn : [](const std::string&) {}),
        lock_(o.vfs.empty() ? std::make_unique<LockFile>(o.path + ".lock") : nullptr),
        prepared_(prepare_file(o.path, o.vfs)),
        readers_(o.path, o.vfs, std::max(1, o.readers)),
        writer_({o.path, o.vfs, o.commit_interval, o.own_thread, o.publish_too_early, o.committed, o.sync_failed}, [this](const auto& uids) { publish(uids); }, warn_) {}

  Created create(const NewJob& job) override { return create_limited(job, 0); }

  Created create_limited(const NewJob& job, int limit) override {
    Created out;
    change(creation(job, limit, out));
    return out;
  }

  void create_later(std::shared_ptr<const NewJob> job, int limit, CreateDone done) override {
    const auto created = std::make_shared<Created>();
    writer_.call_later(creation(*job, limit, *created), [job, created, done = std::move(done)](const std::exception_ptr& error) {
      done(std::move(*created), error);
    });
  }

  std::optional<Job> find(const std::string& uid) const override {
    return readers_.use([&](Database& db) { return rows::find(db, uid); });
  }
  std::vector<Job> list(const ListQuery& query) const override {
    return readers_.use([&](Database& db) { return rows::list(db, query); });
  }
  std::optional<Job> take_next() override {
    return moved([&](Database& db) { return rows::take_next(db, now_ns_()); });
  }
  std::optional<Job> move(const std::string& uid, State from, State to, Reason reason,
                          const std::string& message) override {
    return moved([&](Database& db) { return rows::move(db, uid, from, to, reason, message, now_ns_()); });
  }
  std::optional<Job> end_by_fault(const std::string& uid, Reason reason, const std::string& message,
                                  int max_faults) override {
    return moved([&](Database& db) { return rows::end_by_fault(db, uid, reason, message, max_faults, now_ns_()); });
  }
  Recovery recover(int max_stalled) override {
    Recovery out;
    change([&](Database& db, std::set<std::string>& touched) {
      out = rows::recover(db, max_stalled, now_ns_());
      for (const auto* list : {&out.requeued, &out.cancelled, &out.failed}) touched.insert(list->begin(), list->end());
    });
    return out;
  }
  Job update(const std::string& uid, const JobUpdate& what) override {
    return *moved([&](Database& db) { return std::optional(rows::update(db, uid, what, now_ns_())); });
  }
  Job adopt_history(const std::string& uid, const std::string& from, const Checkpoint& checkpoint) override {
    return *moved([&](Database& db) { return std::optional(rows::adopt_history(db, uid, from, checkpoint, now_ns_())); });
  }
  std::vector<std::string> ended_before(std::int64_t time_ns, int limit) const override {
    return readers_.use([&](Database& db) { return rows::ended_before(db, time_ns, limit); });
  }
  void prune(std::int64_t keep, std::int64_t deleted_before_ns) override {
    change([&](Database& db, std::set<std::string>&) { rows::prune(db, keep, deleted_before_ns); });
  }
  std::vector<Change> changes(std::int64_t after, int limit) const override {
    return readers_.use([&](Database& db) { return rows::changes(db, after, limit); });
  }
  ChangeRange change_range() const override {
    return readers_.use([&](Database& db) { return rows::change_range(db); });
  }
  std::map<State, std::int64_t> counts() const override {
    return readers_.use([&](Database& db) { return rows::counts(db); });
  }
  void add_audit(AuditRow row) override {
    writer_.post([this, row = std::move(row)](Database& db, std::set<std::string>&) { rows::add_audit(db, row, now_ns_()); });
  }
  std::vector<AuditRow> audit(int limit) const override {
    return readers_.use([&](Database& db) { return rows::audit(db, limit); });
  }
  bool erase(const std::string& uid) override {
    bool erased = false;
    change([&](Database& db, std::set<std::string>& touched) {
      erased = rows::erase(db, uid, now_ns_());
      touched.insert(uid);
    });
    return erased;
  }

  CreatedSweep create_sweep(const NewSweep& sweep, int limit) override {
    CreatedSweep out;
    change([&](Database& db, std::set<std::string>& touched) {
      out = rows::create_sweep(db, sweep, limit, now_ns_());
      if (!out.existed)
        for (const NewJob& job : sweep.jobs) touched.insert(job.uid);
    });
    return out;
  }
  std::optional<Sweep> find_sweep(const std::string& uid) const override {
    return readers_.use([&](Database& db) { return rows::find_sweep(db, uid); });
  }
  std::vector<Sweep> list_sweeps(std::int64_t before_id, int limit) const override {
    return readers_.use([&](Database& db) { return rows::list_sweeps(db, before_id, limit); });
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
  void add_run_time(const std::string& uid, std::int64_t ms) override {
    post(uid, [ms](Database& db, const std::string& job, std::int64_t) { rows::add_run_time(db, job, ms); });
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
  bool is_stuck() const override { return writer_.is_stuck(); }

  std::vector<Channel> channels(const std::string& uid) const override {
    return readers_.use([&](Database& db) { return rows::channels(db, uid); });
  }
  std::vector<Sample> samples(const std::string& uid, std::int64_t after, int limit) const override {
    return readers_.use([&](Database& db) { return rows::samples(db, uid, after, limit); });
  }
  std::vector<EnvelopePoint> envelope(const std::string& uid, std::int64_t after, std::int64_t until,
                                      int max_points) const override {
    return readers_.use([&](Database& db) { return rows::envelope(db, uid, after, until, max_points); });
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
  static bool prepare_file(const std::string& path, const std::string& vfs) {
    struct stat info {};
    const bool unclean = ::stat((path + "-wal").c_str(), &info) == 0 && info.st_size > 0;
    Database db(path, Database::Role::writer, vfs);
    if (unclean) {
      Statement check = db.prepare("PRAGMA quick_check(1)");
      if (!check.step() || check.text(0) != "ok")
        fail(ErrorCode::data_loss, "{} is damaged: {}; restore a copy", path, check.text(0));
    }
    // Before anything of an older file is changed there is a copy of it.
    if (const int version = version_of(db); version > 0 && version < schema_version() && vfs.empty()) {
      const std::string copy = path + ".schema" + std::to_string(version);
      if (::stat(copy.c_str(), &info) != 0) {
        db.copy_to(copy + ".part");
        if (std::rename((copy + ".part").c_str(), copy.c_str()) != 0)
          fail(ErrorCode::unavailable, "{}: {}", copy, std::strerror(errno));
      }
    }
    migrate(db);
    return true;
  }

  template <class F>
  void change(F f) {
    writer_.call(std::move(f));
  }
  /// The change that makes a job; `job` and `out` must live until it is done.
  Writer::Change creation(const NewJob& job, int limit, Created& out) {
    return [this, &job, limit, &out](Database& db, std::set<std::string>& touched) {
      out = rows::create(db, job, limit, now_ns_());
      if (!out.existed) touched.insert(job.uid);
    };
  }
  /// A change of one job; what it returns is the job as it is then, if it changed.
  template <class F>
  std::optional<Job> moved(F f) {
    std::optional<Job> out;
    change([&](Database& db, std::set<std::string>& touched) {
      out = f(db);
      if (out) touched.insert(out->uid);
    });
    return out;
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
  const std::unique_ptr<LockFile> lock_;
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
