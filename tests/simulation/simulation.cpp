// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/simulation/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "core/base/error.hpp"
#include "core/base/run_context.hpp"
#include "server/jobs/queue.hpp"
#include "server/jobs/runner.hpp"
#include "server/jobs/store_observer.hpp"
#include "server/store/sqlite_store.hpp"
#include "server/store/verify.hpp"
#include "tests/simulation/sim_disk.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::testing {
namespace {

using store::State;

constexpr const char* database = "seaway.db";

/// The value that any right run gives for a sample.
double value_of(std::int64_t sequence) {
  std::uint64_t x = static_cast<std::uint64_t>(sequence) * 0x9e3779b97f4a7c15ull;
  x ^= x >> 29;
  x *= 0xbf58476d1ce4e5b9ull;
  return static_cast<double>(x >> 11);
}

/// What one client knows of its job; it survives every crash of the server.
struct Client {
  std::string request_id, uid;
  int length = 0;                    ///< samples of a whole run
  bool acknowledged = false, told_cancelled = false, told_deleted = false;
  std::int64_t seen = 0;             ///< samples received, 1 .. seen
  std::optional<State> last_state;   ///< shown by the stream
  bool woken = true;                 ///< a new stream reads at once
};

/// One attempt under way.
struct Attempt {
  std::string uid;
  int length = 0;
  std::int64_t at = 0;
  std::unique_ptr<jobs::StoreObserver> observer;
};

class Simulation {
 public:
  Simulation(std::uint64_t seed, bool bug)
      : random_(seed), bug_(bug), disk_("sim" + std::to_string(seed), seed ^ 0xabcdef) {}

  SimulationResult run() {
    open();  // the disk is sound until act() breaks it
    const int steps = 40 + static_cast<int>(random_() % 80);
    for (int i = 0; i < steps && out_.violations.empty(); ++i) guarded([&] { act(); });
    // No more trouble: everything must come to its end.
    calm_ = true;
    disk_.set_full(false);
    if (disk_.is_dead()) crash();
    disk_.fail_after(-1);
    for (int i = 0; i < 400 && out_.violations.empty() && !is_quiet(); ++i) guarded([&] { work(); });
    if (out_.violations.empty()) guarded([&] { check_end(); });
    store_.reset();
    if (out_.violations.empty())
      for (const std::string& problem : store::verify_database(database, disk_.name()).problems) violation(problem);
    out_.jobs = static_cast<int>(clients_.size());
    return out_;
  }

 private:
  void violation(const std::string& text) { out_.violations.push_back(text); }
  void note(std::uint64_t x) { out_.fingerprint = (out_.fingerprint ^ x) * 0x100000001b3ull; }
  std::uint64_t roll(std::uint64_t n) { return random_() % n; }

  /// Runs one step; a dead disk is a crash of the machine or of the process.
  template <class F>
  void guarded(F f) {
    try {
      f();
    } catch (const Error& error) {
      if (error.code() != ErrorCode::unavailable && error.code() != ErrorCode::resource_exhausted)
        violation(std::string("unexpected: ") + error.what());
    }
    if (disk_.is_dead()) crash();
  }

  void open() {
    store::SqliteOptions options;
    options.path = database;
    options.vfs = disk_.name();
    options.own_thread = false;
    options.readers = 1;
    options.publish_too_early = bug_;
    options.now_ns = [this] { return clock_ += static_cast<std::int64_t>(roll(1'000'000)) - (roll(50) == 0 ? 3'600'000'000'000 : 0); };
    store_ = store::open_sqlite_store(options);
    static_cast<void>(store_->subscribe([this](const std::set<std::string>& uids) {
      for (Client& c : clients_) c.woken = c.woken || uids.count(c.uid) > 0;
    }));
    const auto recovery = store_->recover(1000);
    for (const auto& job : store_->list({}))
      if (job.state == State::running || job.state == State::cancelling) violation("job " + job.uid + " runs after a start");
    queue_ = std::make_unique<jobs::Queue>(
        jobs::QueueLimits{}, jobs::Solver{{}, [](const sim::Case&) { return sim::CaseReport{}; }}, *workspace(), *store_, [] {},
        [this](const std::string& uid) { stop_.insert(uid); }, [](const std::string&) {}, [this] { return "j" + std::to_string(next_uid_++); });
  }

  /// The queue keeps files of cases there; these cases have none.
  static const jobs::Workspace* workspace() {
    static const TempFolder folder;
    static const jobs::Workspace shared(folder.path());
    return &shared;
  }

  void crash() {
    ++out_.crashes;
    note(0xc0ffee);
    attempts_.clear();
    stop_.clear();
    queue_.reset();
    store_.reset();
    disk_.crash(roll(2) == 0);
    for (Client& c : clients_) c.woken = true;
    for (int i = 0; store_ == nullptr; ++i) {
      if (!calm_ && i < 3 && roll(4) == 0) disk_.fail_after(1 + static_cast<int>(roll(30)));  // in the recovery too
      try {
        open();
      } catch (const Error& error) {
        queue_.reset();
        store_.reset();
        if (!disk_.is_dead()) {
          violation(std::string("it does not start: ") + error.what());
          return;
        }
        disk_.crash(roll(2) == 0);
      }
    }
    guarded_checks();
  }

  /// What was acknowledged or shown is there.
  void guarded_checks() {
    for (const Client& c : clients_) {
      if (!c.acknowledged || c.told_deleted) continue;
      const auto job = store_->find(c.uid);
      if (!job) {
        violation("job " + c.uid + " was acknowledged and is lost");
        continue;
      }
      if (job->last_sequence < c.seen) violation("job " + c.uid + ": samples that were shown are lost");
      if (c.told_cancelled && job->state != State::cancelled) violation("job " + c.uid + ": a cancellation is undone");
      if (c.last_state && store::is_terminal(*c.last_state) && job->state != *c.last_state)
        violation("job " + c.uid + ": an end that was shown is undone");
    }
  }

  void act() {
    if (roll(40) == 0) disk_.fail_after(1 + static_cast<int>(roll(12)));
    if (roll(40) == 0) disk_.set_full(true);
    if (disk_.full() && roll(4) == 0) disk_.set_full(false);
    switch (roll(10)) {
      case 0:
      case 1: submit(); break;
      case 2: cancel(); break;
      case 3: erase(); break;
      case 4: watch(); break;
      default: work(); break;
    }
  }

  static v1::CreateJobRequest request(const Client& c) {
    v1::CreateJobRequest out;
    out.set_request_id(c.request_id);
    v1::Case& m = *out.mutable_case_();
    m.set_title("length " + std::to_string(c.length));
    m.set_dimension(2);
    m.mutable_tank()->add_y_m(-1);
    m.mutable_tank()->add_y_m(1);
    m.mutable_tank()->add_z_m(-1);
    m.mutable_tank()->add_z_m(0.5);
    m.mutable_mesh()->set_base_cell_m(0.1);
    auto& stage = *m.mutable_cascade()->add_stages();
    stage.set_name("only");
    stage.mutable_end()->mutable_time()->set_duration_s(1);
    return out;
  }

  void submit() {
    const bool again = !clients_.empty() && roll(3) == 0;
    if (!again) {
      Client c;
      char id[40];
      std::snprintf(id, sizeof id, "00000000-0000-4000-8000-%012llx", static_cast<unsigned long long>(random_() & 0xffffffffffffull));
      c.request_id = id;
      c.length = 5 + static_cast<int>(roll(60));
      clients_.push_back(c);
    }
    Client& c = again ? clients_[roll(clients_.size())] : clients_.back();
    jobs::Submitted submitted;
    try {
      submitted = queue_->submit(request(c));
    } catch (const Error& error) {
      if (error.code() == ErrorCode::failed_precondition && c.told_deleted) return;  // it knows that the job is gone
      throw;
    }
    const store::Job& answer = submitted.job;
    note(static_cast<std::uint64_t>(answer.id));
    if (c.acknowledged && !c.told_deleted && c.uid != answer.uid) violation("one request became two jobs");
    if (c.told_deleted) return;  // it was deleted, so this is another job of nobody
    c.uid = answer.uid;
    c.acknowledged = true;
    c.woken = true;
  }

  Client* any() {
    std::vector<Client*> known;
    for (Client& c : clients_)
      if (c.acknowledged && !c.told_deleted) known.push_back(&c);
    return known.empty() ? nullptr : known[roll(known.size())];
  }

  void cancel() {
    Client* c = any();
    if (c == nullptr) return;
    try {
      if (queue_->cancel(c->uid).state == State::cancelled) c->told_cancelled = true;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::failed_precondition) throw;  // it has ended
    }
  }

  void erase() {
    Client* c = any();
    if (c == nullptr || roll(3) != 0) return;
    const auto job = store_->find(c->uid);
    if (!job || !store::is_terminal(job->state)) return;
    c->told_deleted = true;  // even a refused one may have happened
    store_->erase(c->uid);
  }

  /// As a stream of the service: told of a commit, it reads what is new.
  void watch() {
    for (Client& c : clients_) {
      if (!c.acknowledged || c.told_deleted || !c.woken) continue;
      c.woken = false;
      const auto job = store_->find(c.uid);
      if (!job) {
        violation("job " + c.uid + " was acknowledged and is not there");
        return;
      }
      for (const store::Sample& s : store_->samples(c.uid, c.seen, 1000)) {
        if (s.sequence != c.seen + 1) violation("job " + c.uid + ": a gap in the stream");
        if (s.values.size() != 1 || s.values[0] != value_of(s.sequence)) violation("job " + c.uid + ": a wrong sample");
        c.seen = s.sequence;
        ++out_.samples;
      }
      if (job->last_sequence > c.seen) violation("job " + c.uid + ": the stream lags behind the job");
      if (c.last_state && store::is_terminal(*c.last_state) && job->state != *c.last_state)
        violation("job " + c.uid + ": left an end");
      c.last_state = job->state;
      note(static_cast<std::uint64_t>(c.seen) * 8 + static_cast<std::uint64_t>(job->state));
    }
  }

  void work() {
    if (attempts_.size() < 2 && roll(2) == 0) begin();
    if (!attempts_.empty()) step(roll(attempts_.size()));
    if (roll(3) == 0) store_->flush();  // the commit interval
    if (roll(2) == 0 || calm_) watch();
  }

  void begin() {
    const auto job = store_->take_next();
    if (!job) return;
    for (const Attempt& a : attempts_)
      if (a.uid == job->uid) violation("job " + job->uid + " runs twice");
    Attempt a;
    a.uid = job->uid;
    a.length = std::atoi(job->title.c_str() + 7);
    a.observer = std::make_unique<jobs::StoreObserver>(job->uid, job->last_sequence, "/run/" + job->uid, *store_, quiet_context().log, nullptr,
                                                       [this] { return steady_ += std::chrono::milliseconds(60); });
    // The newest checkpoint that the store knows and that is still whole.
    for (const auto& c : store_->checkpoints(job->uid)) {
      if (c.sequence > job->last_sequence) violation("job " + job->uid + ": a checkpoint ahead of the history");
      if (roll(8) != 0) a.at = std::max(a.at, c.sequence);
    }
    a.observer->on_channels({{"value", "1"}});
    attempts_.push_back(std::move(a));
  }

  void step(std::size_t index) {
    Attempt& a = attempts_[index];
    using End = jobs::RunResult::End;
    std::optional<jobs::RunResult> end;
    if (a.at >= a.length) {
      end = {End::finished, store::Reason::none, ""};
    } else if (stop_.count(a.uid) > 0) {
      checkpoint(a);
      end = {End::stopped, store::Reason::none, ""};
    } else if (!calm_ && roll(30) == 0) {
      end = {End::fault, store::Reason::worker_crash, "SIGSEGV"};
    } else {
      for (std::uint64_t n = 1 + roll(8); n > 0 && a.at < a.length; --n) {
        ++a.at;
        a.observer->on_sample({a.at, 0, a.at, 0.1 * static_cast<double>(a.at), {value_of(a.at)}});
      }
      a.observer->on_progress({0, 1, 0.1 * static_cast<double>(a.at), static_cast<double>(a.at) / a.length, -1, false});
      if (roll(4) == 0) checkpoint(a);
    }
    if (!end) return;
    a.observer->finish();
    // Until the disk takes it, as the pool does; a crash leaves it to the recovery.
    if (!jobs::end_attempt(*store_, a.uid, *end, 1000)) violation("job " + a.uid + " did not run any more");
    stop_.erase(a.uid);
    attempts_.erase(attempts_.begin() + static_cast<std::ptrdiff_t>(index));
  }

  void checkpoint(Attempt& a) { a.observer->put_checkpoint({a.at, "/run/" + a.uid + "/c" + std::to_string(a.at), 1, 1, 1}, 0); }

  bool is_quiet() {
    if (!attempts_.empty()) return false;
    store::ListQuery query;
    query.limit = 1000;
    for (const auto& job : store_->list(query))
      if (!store::is_terminal(job.state)) return false;
    return true;
  }

  void check_end() {
    store_->flush();
    watch();
    guarded_checks();
    if (!is_quiet()) violation("work is left at the end");
    std::set<std::string> uids;
    for (const Client& c : clients_) {
      if (!c.acknowledged || c.told_deleted) continue;
      uids.insert(c.uid);
      const auto job = store_->find(c.uid);
      const bool whole = job->state == State::succeeded;
      if (whole && c.seen != c.length) violation("job " + c.uid + " has ended and its client has not seen all of it");
      if (job->state == State::failed) violation("job " + c.uid + " failed: " + job->message);
      std::int64_t revision = 0;
      for (const auto& event : store_->events(c.uid)) {
        if (event.revision <= revision) violation("job " + c.uid + ": events out of order");
        if (event.kind == "REPLAY_MISMATCH" || event.kind == "HISTORY_GAP") violation("job " + c.uid + ": " + event.kind);
        revision = event.revision;
      }
    }
  }

  std::mt19937_64 random_;
  const bool bug_;
  SimDisk disk_;
  jobs::StoreObserver::Clock::time_point steady_{};  ///< of the progress: every fourth or fifth is sent
  std::int64_t clock_ = 1'700'000'000'000'000'000;
  int next_uid_ = 1;
  bool calm_ = false;
  std::vector<Client> clients_;
  std::vector<Attempt> attempts_;
  std::set<std::string> stop_;
  std::unique_ptr<store::JobStore> store_;
  std::unique_ptr<jobs::Queue> queue_;
  SimulationResult out_;
};

}  // namespace

SimulationResult simulate(std::uint64_t seed, bool planted_bug) { return Simulation(seed, planted_bug).run(); }

}  // namespace seaway::testing
