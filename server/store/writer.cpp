// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/store/writer.hpp"

#include <future>
#include <memory>
#include <utility>

#include "core/base/error.hpp"

namespace seaway::store {
namespace {

// Pages that are written often go into the file once for many times into the log: a longer log means less to write.
constexpr int passive_pages = 4000;   // 16 MiB of log: move it into the file as readers allow
constexpr int truncate_pages = 8000;  // 32 MiB: wait for readers and start the log anew

}  // namespace

Writer::Writer(const Options& o, Committed committed, Warn warn)
    : db_(o.path, Database::Role::writer, o.vfs),
      interval_(o.interval),
      own_thread_(o.own_thread),
      publish_too_early_(o.publish_too_early),
      committed_(std::move(committed)),
      warn_(std::move(warn)),
      timed_(o.timed),
      sync_failed_(o.sync_failed) {
  if (own_thread_) thread_ = std::thread([this] { loop(); });
}

Writer::~Writer() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (own_thread_) checkpoint(true);
}

void Writer::checkpoint(bool truncate) {
  if (broken_) return;
  try {
    db_.checkpoint(truncate);
  } catch (const SyncFailed& error) {
    give_up(error.what());
  }
}

void Writer::give_up(const std::string& why) {
  stuck_ = broken_ = true;
  warn_(why);
  if (sync_failed_) sync_failed_();
}

void Writer::call(Change change) {
  const auto durable = std::make_shared<std::promise<void>>();  // the writer may still touch it when the future is ready
  auto result = durable->get_future();
  call_later(std::move(change), [durable](const std::exception_ptr& error) {
    if (error)
      durable->set_exception(error);
    else
      durable->set_value();
  });
  result.get();
}

void Writer::call_later(Change change, Done done) {
  bool first = false;
  {
    const std::lock_guard lock(mutex_);
    first = !std::exchange(hurry_, true);
    tasks_.push_back({std::move(change), std::move(done)});
  }
  if (first) wake_.notify_one();  // it has been told already otherwise
  if (!own_thread_) commit(tasks_);
}

void Writer::post(Change change) {
  bool first = false;
  {
    const std::lock_guard lock(mutex_);
    first = tasks_.empty();
    if (first) oldest_ = std::chrono::steady_clock::now();
    tasks_.push_back({std::move(change), nullptr});
  }
  if (first) wake_.notify_one();
}

void Writer::flush() {
  call([](Database&, std::set<std::string>&) {});
}

void Writer::loop() {
  std::deque<Task> batch;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stopping_ || !tasks_.empty() || !batch.empty(); });
      if (batch.empty())
        wake_.wait_until(lock, oldest_ + interval_, [&] { return stopping_ || hurry_; });
      hurry_ = false;
      for (Task& task : tasks_) batch.push_back(std::move(task));
      tasks_.clear();
      if (batch.empty()) return;  // stopping
    }
    if (commit(batch)) continue;
    // The disk refused. Whoever waits has been told; the posted changes wait for better times.
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, std::chrono::seconds(1), [&] { return stopping_ || hurry_; });
    if (stopping_) return;
  }
}

void Writer::publish(std::deque<Task>& batch, const std::set<std::string>& touched,
                     const std::vector<std::exception_ptr>& failures) {
  // Listeners hear of it before the caller of call() goes on, so that they never lag behind an answer.
  committed_(touched);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (batch[i].done) batch[i].done(failures[i]);
  }
}

bool Writer::commit(std::deque<Task>& batch) {
  bool published = false;
  const auto began = std::chrono::steady_clock::now();
  std::set<std::string> touched;
  std::vector<std::exception_ptr> failures(batch.size());
  const auto keep_posted = [&](const std::exception_ptr& why) {
    std::deque<Task> posted;
    for (Task& task : batch) {
      if (task.done)
        task.done(why);
      else
        posted.push_back(std::move(task));
    }
    batch = std::move(posted);
  };
  try {
    if (broken_) fail(ErrorCode::unavailable, "the disk has lost data; the server must be started again");
    db_.prepare("BEGIN IMMEDIATE").run();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      std::set<std::string> changed;
      db_.prepare("SAVEPOINT task").run();
      try {
        batch[i].change(db_, changed);
        db_.prepare("RELEASE task").run();
        touched.merge(changed);
      } catch (const Error& error) {
        if (error.code() == ErrorCode::unavailable) throw;  // the disk, not the change
        failures[i] = std::current_exception();
        db_.execute("ROLLBACK TO task");
        db_.execute("RELEASE task");
        if (!batch[i].done) warn_(std::string("a write was dropped: ") + error.what());
      }
    }
    if (publish_too_early_) {
      published = true;
      publish(batch, touched, failures);
    }
    db_.prepare("COMMIT").run();
  } catch (const std::exception& error) {
    const auto why = std::current_exception();
    try {
      db_.execute("ROLLBACK");
    } catch (const std::exception&) {
      // SQLite has rolled back by itself.
    }
    warn_(std::string("commit refused: ") + error.what());
    if (dynamic_cast<const SyncFailed*>(&error) != nullptr) give_up(error.what());
    if (published) {
      batch.clear();
      return true;
    }
    stuck_ = true;
    keep_posted(why);
    return batch.empty();
  }
  stuck_ = false;
  if (timed_) timed_(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  if (!published) publish(batch, touched, failures);
  batch.clear();
  if (db_.wal_pages() > passive_pages) checkpoint(db_.wal_pages() > truncate_pages);
  return true;
}

}  // namespace seaway::store
