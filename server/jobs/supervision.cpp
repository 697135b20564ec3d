// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/supervision.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "server/jobs/core_slots.hpp"
#include "server/jobs/worker.hpp"

namespace seaway::jobs {
namespace {

constexpr std::chrono::milliseconds tick{100};
constexpr std::chrono::seconds disk_interval{2};
constexpr std::size_t longest_words = 2000;

/// Wakes the supervisor from any thread.
class Wake {
 public:
  Wake() : fd_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (fd_.get() < 0) fail(ErrorCode::unavailable, "no descriptor for a worker: {}", std::strerror(errno));
  }
  void operator()() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto n = ::write(fd_.get(), &one, sizeof one);
  }
  int fd() const { return fd_.get(); }

 private:
  Descriptor fd_;
};

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f) c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.size() > 300 ? "... " + text.substr(text.size() - 300) : text;
}

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

Supervision::Supervision(const ProcessSettings& settings, const Workspace& workspace, store::JobStore& store,
                         std::shared_ptr<spdlog::logger> log, const store::Job& job, const std::vector<int>& cpus)
    : settings_(settings), workspace_(workspace), store_(store), log_(std::move(log)), job_(job), cpus_(cpus),
      observer_(job.uid, job.last_sequence, workspace.run_folder(job.uid), store, log_, settings.run.metrics) {}

std::string Supervision::order() const {
  worker::Order order;
  order.set_code_version(std::string(code_version()));
  order.set_uid(job_.uid);
  order.set_data_dir(workspace_.data_dir());
  order.set_spec(job_.spec);
  order.set_digest(job_.digest);
  order.set_threads(settings_.run.threads);
  order.set_checkpoint_interval_s(settings_.run.checkpoint_interval_s);
  order.set_memory_bytes(settings_.limits.memory_bytes);
  order.set_file_bytes(settings_.limits.disk_bytes);
  order.set_parent_pid(::getpid());
  order.set_heartbeat_ms(static_cast<int>(std::clamp<std::int64_t>(settings_.lease.count() / 10, 10, 1000)));
  return order.SerializeAsString();
}

RunResult Supervision::run(const AttemptControl& control) {
  const Descriptor lease = take_lease(workspace_.lease_path(job_.uid));
  for (const std::string& name :
       workspace_.prepare_run(job_.uid, store_.checkpoints(job_.uid), store_.artifacts(job_.uid)))
    log_->warn("job={} event=removed_unrecorded file={}", job_.uid, name);
  const Wake wake;
  const std::stop_callback on_stop(control.stop, [&] { wake(); });
  const std::stop_callback on_kill(control.kill, [&] { wake(); });
  start_child(lease);
  begun_ = alive_ = news_ = accounted_ = disk_checked_ = Clock::now();
  while (!records_ended_ || !child_->status()) {
    wait_for_news(wake.fd());
    read_errors();
    if (store_.is_stuck())
      alive_ = news_ = Clock::now();  // what waits for the disk is enough: the pipe fills, and the run waits
    else
      read_records();
    if (control.kill.stop_requested()) kill(Verdict::kill);
    if (control.stop.stop_requested()) ask(Verdict::stop);
    watch(Clock::now());
  }
  read_errors();
  observer_.finish();
  account(Clock::now());
  return result();
}

void Supervision::start_child(const Descriptor& lease) {
  const KeepToCpus keep(cpus_);  // the child inherits them, with all threads that it makes
  if (!keep.is_kept()) log_->warn("job={} event=cores text=\"the system does not give it CPUs of its own: {}\"", job_.uid, std::strerror(errno));
  child_.emplace(settings_.program, order(), lease);
}

void Supervision::wait_for_news(int wake) {
  // An end that has come already would be reported again and again.
  std::array<pollfd, 3> fds{{{wake, POLLIN, 0},
                             {records_ended_ ? -1 : child_->records(), POLLIN, 0},
                             {errors_ended_ ? -1 : child_->errors(), POLLIN, 0}}};
  ::poll(fds.data(), fds.size(), static_cast<int>(tick.count()));
  std::uint64_t count = 0;
  [[maybe_unused]] const auto n = ::read(wake, &count, sizeof count);
}

void Supervision::read_records() {
  // A bounded number of them, so that stop, kill and limits are looked at in between.
  for (int round = 0; round < 16 && !records_ended_; ++round) {
    char bytes[65536];
    const ssize_t n = ::read(child_->records(), bytes, sizeof bytes);
    if (n < 0) return;
    if (n == 0) records_ended_ = true;
    if (verdict_ == Verdict::damaged || n == 0) continue;  // nothing after a damaged record can be trusted
    try {
      frames_.feed({bytes, static_cast<std::size_t>(n)});
      while (const auto content = frames_.next()) {
        worker::Record record;
        if (!record.ParseFromString(*content)) fail(ErrorCode::data_loss, "a record of the worker cannot be read");
        take(record);
      }
    } catch (const Error& error) {
      refused_ = error.what();
      refused_reason_ = error.code() == ErrorCode::data_loss ? store::Reason::checkpoint_lost : store::Reason::internal;
      kill(Verdict::damaged);
    }
  }
}

void Supervision::read_errors() {
  for (int round = 0; round < 16 && !errors_ended_; ++round) {
    char bytes[4096];
    const ssize_t n = ::read(child_->errors(), bytes, sizeof bytes);
    if (n < 0) return;
    if (n == 0) errors_ended_ = true;
    last_words_.append(bytes, static_cast<std::size_t>(n));
    if (last_words_.size() > longest_words) last_words_.erase(0, last_words_.size() - longest_words);
  }
}

void Supervision::take(const worker::Record& r) {
  using worker::Record;
  alive_ = Clock::now();
  if (r.what_case() != Record::kHeartbeat && r.what_case() != Record::kLog) news_ = alive_;
  switch (r.what_case()) {
    case Record::kChannels: {
      std::vector<sim::Channel> channels;
      for (const auto& c : r.channels().channels()) channels.push_back({c.name(), c.unit()});
      observer_.on_channels(channels);
      break;
    }
    case Record::kStage: observer_.put_stage(r.stage()); break;
    case Record::kSample:
      observer_.on_sample({r.sample().sequence(), r.sample().stage(), r.sample().step(), r.sample().time_s(),
                           {r.sample().values().begin(), r.sample().values().end()}});
      break;
    case Record::kProgress:
      observer_.on_progress({r.progress().stage(), r.progress().stage_count(), r.progress().time_s(),
                             r.progress().fraction(), r.progress().remaining_s(), r.progress().held()});
      break;
    case Record::kCheckpoint:
      observer_.put_checkpoint({r.checkpoint().sequence(), r.checkpoint().path(), r.checkpoint().size(),
                                r.checkpoint().mtime_ns(), r.checkpoint().inode()}, r.checkpoint().write_s());
      break;
    case Record::kArtifact:
      observer_.on_artifact(r.artifact().name(), r.artifact().path(), r.artifact().media_type());
      break;
    case Record::kEvent: observer_.on_event(r.event().kind(), r.event().text()); break;
    case Record::kLog:
      log_->log(static_cast<spdlog::level::level_enum>(std::clamp(r.log().level(), 0, 5)), "job={} {}", job_.uid,
                one_line(r.log().text()));
      break;
    case Record::kOutcome: outcome_ = r.outcome(); break;
    case Record::kHeartbeat:
    case Record::WHAT_NOT_SET: break;
  }
}

void Supervision::watch(Clock::time_point now) {
  if (now - accounted_ > std::chrono::seconds(5)) account(now);
  if (asked_ != Clock::time_point{} && now - asked_ > settings_.stop_grace) child_->signal(SIGKILL);
  if (records_ended_ || outcome_) {
    // What is left is the end of the process.
    if (now - alive_ > settings_.lease) child_->signal(SIGKILL);
    return;
  }
  const AttemptLimits& limits = settings_.limits;
  if (limits.wall.count() > 0 && std::chrono::milliseconds(job_.run_ms) + (now - begun_) > limits.wall) ask(Verdict::wall);
  if (now - alive_ > settings_.lease) kill(Verdict::lease);
  if (now - news_ > settings_.stall) kill(Verdict::stall);
  if (now - disk_checked_ < disk_interval) return;
  disk_checked_ = now;
  if (limits.disk_bytes > 0 && workspace_.run_bytes(job_.uid) > limits.disk_bytes) kill(Verdict::disk);
  if (limits.memory_bytes > 0 && child_->memory() > limits.memory_bytes) kill(Verdict::memory);
}

void Supervision::account(Clock::time_point now) {
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now - accounted_);
  store_.add_run_time(job_.uid, ms.count());
  accounted_ += ms;
}

void Supervision::ask(Verdict why) {
  if (verdict_ != Verdict::none) return;
  verdict_ = why;
  asked_ = Clock::now();
  child_->signal(SIGTERM);
}

void Supervision::kill(Verdict why) {
  // A request to stop gives way; of two reasons to kill the first one counts.
  if (verdict_ == Verdict::none || verdict_ == Verdict::stop || verdict_ == Verdict::wall) verdict_ = why;
  child_->signal(SIGKILL);
}

RunResult Supervision::fault(store::Reason reason, const std::string& what) const {
  const std::string words = one_line(last_words_);
  return {RunResult::End::fault, reason, words.empty() ? what : what + "; it said: " + words};
}

RunResult Supervision::result() {
  using End = RunResult::End;
  using store::Reason;
  const int status = *child_->status();
  switch (verdict_) {
    case Verdict::kill: return {End::stopped, Reason::none, "killed"};
    case Verdict::damaged:
      return {refused_reason_ == Reason::checkpoint_lost ? End::fault : End::failed, refused_reason_, refused_};
    case Verdict::disk:
      return {End::failed, Reason::disk_full,
              fmt::format("the files of the run exceed {} bytes; raise workers.disk_mb or ask for fewer snapshots",
                          settings_.limits.disk_bytes)};
    case Verdict::memory:
      return fault(Reason::memory, fmt::format("the run took more than {} bytes of memory; raise workers.memory_mb or use "
                                               "larger cells", settings_.limits.memory_bytes));
    case Verdict::lease:
      return fault(Reason::executor_lost, fmt::format("the worker gave no sign of life for {:.0f} s and was killed",
                                                      seconds(settings_.lease)));
    case Verdict::stall:
      return fault(Reason::stalled, fmt::format("the solver gave no result for {:.0f} s and was killed; raise "
                                                "workers.stall_timeout_s if a step may take longer", seconds(settings_.stall)));
    case Verdict::none:
    case Verdict::stop:
    case Verdict::wall: break;
  }
  if (outcome_) {
    using Outcome = worker::Record::Outcome;
    const auto reason = static_cast<Reason>(outcome_->reason());
    if (outcome_->end() == Outcome::END_FINISHED) return {End::finished, Reason::none, outcome_->message()};
    if (outcome_->end() == Outcome::END_FAILED) return {End::failed, reason, outcome_->message()};
    if (outcome_->end() == Outcome::END_FAULT) return {End::fault, reason, outcome_->message()};
    if (verdict_ == Verdict::stop) return {End::stopped, Reason::none, outcome_->message()};
  }
  if (outcome_ && verdict_ == Verdict::none)
    return fault(Reason::executor_lost, "the worker was stopped from outside, after a checkpoint");
  if (verdict_ == Verdict::wall)
    return {End::failed, Reason::time_limit, fmt::format("the job computed for {:.0f} s, which is the limit; its last "
                                                         "checkpoint is kept", seconds(settings_.limits.wall))};
  const bool killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  if (verdict_ == Verdict::stop && killed) return {End::stopped, Reason::none, "it did not stop in time and was killed"};
  if (verdict_ == Verdict::stop && WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM)
    return {End::stopped, Reason::none, "it was stopped without a checkpoint"};
  if (WIFEXITED(status) && WEXITSTATUS(status) == Worker::exit_no_memory)
    return fault(Reason::memory, "the worker got no more memory; use larger cells or raise workers.memory_mb");
  if (WIFEXITED(status) && WEXITSTATUS(status) == Worker::exit_no_disk)
    return fault(Reason::disk_full, "the lease cannot be written");
  if (WIFEXITED(status) && WEXITSTATUS(status) == Worker::exit_other_version)
    return {End::fault, Reason::executor_lost, settings_.program + " is of another version than this server; restart the server", true};
  if (killed) return fault(Reason::worker_crash, "the worker was killed (SIGKILL), perhaps by the system for lack of memory");
  if (WIFSIGNALED(status))
    return fault(Reason::worker_crash, fmt::format("the worker ended by SIG{} ({})", ::sigabbrev_np(WTERMSIG(status)),
                                                   ::sigdescr_np(WTERMSIG(status))));
  return fault(Reason::worker_crash, fmt::format("the worker ended with code {} and without a result", WEXITSTATUS(status)));
}

}  // namespace seaway::jobs
