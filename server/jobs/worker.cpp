// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/worker.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <spdlog/sinks/base_sink.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>
#include <thread>

#include "core/base/version.hpp"
#include "seaway/worker/attempt.pb.h"
#include "server/convert/result.hpp"
#include "server/jobs/frames.hpp"
#include "server/jobs/runner.hpp"
#include "server/jobs/submission.hpp"
#include "server/jobs/workspace.hpp"

namespace seaway::jobs {
namespace {

[[noreturn]] void give_up(const char* why) {
  std::fprintf(stderr, "seaway-run attempt: %s\n", why);
  ::_exit(2);
}

/// Writes records. Without a reader the server is gone, and so is the reason to go on. Safe from any thread.
class RecordPipe {
 public:
  void send(const worker::Record& record) {
    const std::string frame = make_frame(record.SerializeAsString());
    const std::lock_guard lock(mutex_);
    for (std::size_t at = 0; at < frame.size();) {
      const ssize_t n = ::write(Worker::record_fd, frame.data() + at, frame.size() - at);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) ::_exit(3);
      at += static_cast<std::size_t>(n);
    }
  }

 private:
  std::mutex mutex_;
};

class PipeSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit PipeSink(RecordPipe& pipe) : pipe_(pipe) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    worker::Record record;
    record.mutable_log()->set_level(message.level);
    record.mutable_log()->set_text(message.payload.data(), std::min<std::size_t>(message.payload.size(), 4096));
    pipe_.send(record);
  }
  void flush_() override {}
  RecordPipe& pipe_;
};

class PipeObserver final : public sim::RunObserver {
 public:
  explicit PipeObserver(RecordPipe& pipe) : pipe_(pipe) {}

  void on_channels(const std::vector<sim::Channel>& channels) override {
    worker::Record record;
    auto& list = *record.mutable_channels();
    for (const sim::Channel& c : channels) {
      auto& m = *list.add_channels();
      m.set_name(c.name);
      m.set_unit(c.unit);
    }
    pipe_.send(record);
  }
  void on_stage_started(const sim::StageInfo& info) override { stage(convert::to_proto(info)); }
  void on_stage_finished(const sim::StageResult& result) override { stage(convert::to_proto(result)); }
  void on_sample(const sim::Sample& s) override {
    worker::Record record;
    auto& m = *record.mutable_sample();
    m.set_sequence(s.sequence);
    m.set_stage(s.stage);
    m.set_step(s.step);
    m.set_time_s(s.time);
    m.mutable_values()->Add(s.values.begin(), s.values.end());
    pipe_.send(record);
  }
  void on_progress(const sim::Progress& p) override {
    worker::Record record;
    auto& m = *record.mutable_progress();
    m.set_stage(p.stage);
    m.set_stage_count(p.stage_count);
    m.set_time_s(p.time);
    m.set_fraction(p.fraction);
    m.set_remaining_s(p.remaining_s);
    m.set_held(p.held);
    pipe_.send(record);
  }
  void on_checkpoint(const std::string& path, std::int64_t sequence, double write_s) override {
    const store::Checkpoint c = describe_checkpoint(path, sequence);
    worker::Record record;
    auto& m = *record.mutable_checkpoint();
    m.set_path(c.path);
    m.set_sequence(c.sequence);
    m.set_size(c.size);
    m.set_mtime_ns(c.mtime_ns);
    m.set_inode(c.inode);
    m.set_write_s(write_s);
    pipe_.send(record);
  }
  void on_artifact(const std::string& name, const std::string& path, const std::string& media_type) override {
    worker::Record record;
    auto& m = *record.mutable_artifact();
    m.set_name(name);
    m.set_path(path);
    m.set_media_type(media_type);
    pipe_.send(record);
  }
  void on_event(const std::string& kind, const std::string& text) override {
    worker::Record record;
    record.mutable_event()->set_kind(kind);
    record.mutable_event()->set_text(text);
    pipe_.send(record);
  }

 private:
  void stage(v1::StageReport report) {
    worker::Record record;
    *record.mutable_stage() = std::move(report);
    pipe_.send(record);
  }
  RecordPipe& pipe_;
};

worker::Order read_order() {
  std::string bytes;
  char part[65536];
  for (;;) {
    const ssize_t n = ::read(Worker::order_fd, part, sizeof part);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    bytes.append(part, static_cast<std::size_t>(n));
  }
  worker::Order order;
  if (bytes.empty() || !order.ParseFromString(bytes) || ::fcntl(Worker::record_fd, F_GETFD) < 0)
    give_up("this is how seawayd starts its workers; use seaway-run CASE");
  if (order.code_version() != code_version()) ::_exit(Worker::exit_other_version);
  return order;
}

void limit(int resource, std::int64_t bytes) {
  if (bytes <= 0) return;
  const rlimit value{static_cast<rlim_t>(bytes), static_cast<rlim_t>(bytes)};
  if (::setrlimit(static_cast<__rlimit_resource>(resource), &value) != 0) give_up("a limit cannot be set");
}

void write_lease() {
  const std::string pid = std::to_string(::getpid()) + "\n";
  if (::ftruncate(Worker::lease_fd, 0) != 0 ||
      ::pwrite(Worker::lease_fd, pid.data(), pid.size(), 0) != static_cast<ssize_t>(pid.size()))
    ::_exit(Worker::exit_no_disk);
}

}  // namespace

struct Worker::State {
  worker::Order order;
  RecordPipe pipe;
};

bool Worker::is_asked_for(int argc, char** argv) { return argc == 2 && std::strcmp(argv[1], "attempt") == 0; }

Worker::Worker() : state_(std::make_unique<State>()) {
  state_->order = read_order();
  const worker::Order& order = state_->order;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != order.parent_pid()) give_up("the server is gone");
  write_lease();
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // Private memory, not addresses: libraries and the arenas of malloc reserve far more than they use.
  limit(RLIMIT_DATA, order.memory_bytes());
  limit(RLIMIT_FSIZE, order.file_bytes());
  ::signal(SIGXFSZ, SIG_IGN);  // the write fails instead
  ::signal(SIGPIPE, SIG_IGN);
  std::set_new_handler([] { ::_exit(exit_no_memory); });
  sigset_t set;
  sigemptyset(&set);
  for (const int s : {SIGTERM, SIGINT}) sigaddset(&set, s);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

Worker::~Worker() = default;

int Worker::run(const Solver& solver) {
  const worker::Order& order = state_->order;
  RecordPipe& pipe = state_->pipe;
  std::stop_source stop;
  std::jthread pulse([&](const std::stop_token& end) {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGTERM);
    const int ms = std::max(1, order.heartbeat_ms());
    const timespec tick{ms / 1000, (ms % 1000) * 1'000'000L};
    worker::Record beat;
    beat.mutable_heartbeat();
    while (!end.stop_requested()) {
      pipe.send(beat);
      if (::sigtimedwait(&set, nullptr, &tick) == SIGTERM) stop.request_stop();
    }
  });
  const RunResult result = guarded([&] {
    const Workspace workspace(order.data_dir());
    const v1::CreateJobRequest spec = decode_spec(order.spec());
    const sim::Case core = bind_case(spec.case_(), spec.files(), workspace);
    PipeObserver observer(pipe);
    sim::RunOptions options;
    options.folder = workspace.run_folder(order.uid());
    options.checkpoint_interval = order.checkpoint_interval_s();
    options.case_digest = order.digest();
    const auto log = std::make_shared<spdlog::logger>("worker", std::make_shared<PipeSink>(pipe));
    return solver.run(core, options, observer, RunContext{log, stop.get_token(), order.threads()});
  });
  worker::Record last;
  auto& outcome = *last.mutable_outcome();
  switch (result.end) {
    case RunResult::End::finished: outcome.set_end(worker::Record::Outcome::END_FINISHED); break;
    case RunResult::End::stopped: outcome.set_end(worker::Record::Outcome::END_STOPPED); break;
    case RunResult::End::fault: outcome.set_end(worker::Record::Outcome::END_FAULT); break;
    case RunResult::End::failed: outcome.set_end(worker::Record::Outcome::END_FAILED); break;
  }
  outcome.set_reason(static_cast<int>(result.reason));
  outcome.set_message(result.message);
  pipe.send(last);
  pulse.request_stop();
  ::pthread_kill(pulse.native_handle(), SIGTERM);  // it waits for that signal
  return 0;
}

}  // namespace seaway::jobs
