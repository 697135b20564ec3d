// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/queue.hpp"

#include <algorithm>
#include <future>
#include <memory>
#include <random>

#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "core/sim/checkpoint_name.hpp"
#include "server/convert/input_error.hpp"
#include "server/convert/result.hpp"
#include "server/jobs/requests.hpp"

namespace seaway::jobs {
namespace {

using store::Reason;
using store::State;

/// Throws for a request id that belongs to a job of another case.
void require_same(const store::Job& known, const store::NewJob& asked) {
  if (known.digest == asked.digest) return;
  std::vector<sim::Diagnostic> problems;
  for (const std::string& field : differing_fields(known.spec, asked.spec))
    problems.push_back({sim::Diagnostic::Severity::error, field, "differs from job " + known.uid,
                        "a request id belongs to one case: use a new one"});
  if (problems.empty()) problems.push_back({sim::Diagnostic::Severity::error, "request_id", "is in use by job " + known.uid, ""});
  throw convert::InputError("REQUEST_ID_REUSED", std::move(problems));
}

/// All of it but its uid.
store::NewJob new_job(const v1::CreateJobRequest& request) {
  store::NewJob job;
  job.spec = encode_spec(request.case_(), request.files());
  job.digest = sha256_hex(job.spec);
  job.request_id = lower(request.request_id());
  job.title = request.case_().title();
  job.code_version = code_version();
  job.priority = request.priority();
  job.labels = {request.labels().begin(), request.labels().end()};
  job.note = request.note();
  job.held = request.start_held();
  return job;
}

}  // namespace

std::string new_uid() {
  static constexpr std::string_view letters = "abcdefghijkmnpqrstuvwxyz23456789";  // 32, none alike
  static thread_local std::random_device random;  // opening it costs more than the letters
  std::string uid;
  for (int i = 0; i < 10; ++i) uid += letters[random() % letters.size()];
  return uid;
}

bool is_uid(const std::string& text) {
  return !text.empty() && text.size() <= 63 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

Queue::Queue(QueueLimits limits, Solver solver, const Workspace& workspace, store::JobStore& store,
             std::function<void()> wake, std::function<void(const std::string&)> stop, std::function<void(const std::string&)> kill,
             std::function<std::string()> make_uid)
    : limits_(limits), solver_(std::move(solver)), workspace_(workspace), store_(store), wake_(std::move(wake)),
      stop_(std::move(stop)), kill_(std::move(kill)), make_uid_(std::move(make_uid)) {}

Submitted Queue::submit(const v1::CreateJobRequest& request) {
  const auto submitted = std::make_shared<std::promise<Submitted>>();
  auto result = submitted->get_future();
  submit_later(request, [submitted](Submitted job, const std::exception_ptr& error) {
    if (error)
      submitted->set_exception(error);
    else
      submitted->set_value(std::move(job));
  });
  return result.get();
}

void Queue::submit_later(const v1::CreateJobRequest& request, SubmitDone done) {
  if (!request.has_case_()) refuse("INVALID_REQUEST", "case", "is missing", "send the case to run");
  if (!request.validate_only() && !is_uuid(request.request_id()))
    refuse("INVALID_REQUEST", "request_id", request.request_id().empty() ? "is missing" : "is not a UUID",
           "make a new UUID for each submit and send the same one again after a lost answer");
  check_traits("", request.priority(), {request.labels().begin(), request.labels().end()}, request.note());
  check_files(request.files());
  const auto job = std::make_shared<store::NewJob>(new_job(request));
  v1::CaseReport report = report_of(request.case_(), request.files(), job->digest);
  if (request.validate_only()) return done({false, {}, std::move(report)}, nullptr);
  require_runnable(report);
  job->uid = make_uid_();
  store_.create_later(job, limits_.queued_jobs,
                      [this, job, report = std::move(report), done = std::move(done)](store::Created created, std::exception_ptr error) {
    Submitted out{true, {}, report};
    try {
      if (error) std::rethrow_exception(error);
      if (created.existed) require_same(created.job, *job);
      if (!created.existed && !job->held) wake_();
      out.job = std::move(created.job);
    } catch (...) {
      error = std::current_exception();
    }
    done(std::move(out), error);
  });
}

void Queue::require_runnable(const v1::CaseReport& report) const {
  if (!report.ok()) {
    std::vector<sim::Diagnostic> problems;
    for (const v1::Diagnostic& d : report.diagnostics())
      if (d.severity() == v1::Diagnostic::SEVERITY_ERROR)
        problems.push_back({sim::Diagnostic::Severity::error, d.field(), d.message(), d.hint()});
    throw convert::InputError("INVALID_CASE", std::move(problems));
  }
  double cpu_s = 0;
  for (const v1::StageEstimate& stage : report.stages()) cpu_s += stage.cpu_s();
  if (limits_.job_cpu_s > 0 && cpu_s > limits_.job_cpu_s)
    fail(ErrorCode::resource_exhausted, "the case needs about {:.0f} CPU seconds, allowed are {:.0f}; use larger cells or fewer periods",
         cpu_s, limits_.job_cpu_s);
}

v1::CaseReport Queue::report_of(const v1::Case& message, const Files& files, const std::string& digest) {
  if (auto known = reports_.find(digest)) return std::move(*known);
  v1::CaseReport report = check_case(message, files, workspace_, solver_);
  reports_.keep(digest, report);
  return report;
}

v1::CaseReport Queue::validate(const v1::Case& message, const Files& files) {
  check_files(files);
  return report_of(message, files, sha256_hex(encode_spec(message, files)));
}

store::Job Queue::cancel(const std::string& uid) {
  for (;;) {
    const auto job = store_.find(uid);
    if (!job) fail(ErrorCode::not_found, "job {} does not exist; list the jobs to find its name", uid);
    switch (job->state) {
      case State::queued:
      case State::held:
        if (auto moved = store_.move(uid, job->state, State::cancelled, Reason::user, "")) return *moved;
        break;  // a worker was faster: look again
      case State::running:
        if (auto moved = store_.move(uid, State::running, State::cancelling, Reason::user, "")) {
          stop_(uid);
          return *moved;
        }
        break;
      case State::cancelling: stop_(uid); return *job;
      case State::cancelled: return *job;
      case State::succeeded:
      case State::failed:
        fail(ErrorCode::failed_precondition, "job {} has ended ({}); it cannot be cancelled any more; retry it for another run", uid,
             store::to_string(job->state));
    }
  }
}

store::Job Queue::kill(const std::string& uid) {
  store::Job job = cancel(uid);  // a worker that was asked to stop is killed all the same
  if (job.state == State::cancelling) kill_(uid);
  return job;
}

store::Job Queue::hold(const std::string& uid) {
  return shift(uid, State::queued, State::held, "held: only waiting jobs can be");
}

store::Job Queue::release(const std::string& uid) {
  store::Job job = shift(uid, State::held, State::queued, "released: only held jobs can be");
  wake_();
  return job;
}

store::Job Queue::shift(const std::string& uid, State from, State to, const std::string& what) {
  for (;;) {
    if (auto moved = store_.move(uid, from, to, Reason::user, "")) return *moved;
    const auto job = store_.find(uid);
    if (!job) fail(ErrorCode::not_found, "job {} does not exist; list the jobs to find its name", uid);
    if (job->state == to) return *job;
    if (job->state != from) fail(ErrorCode::failed_precondition, "job {} is {} and cannot be {}", uid, store::to_string(job->state), what);
  }
}

store::Job Queue::update(const std::string& uid, const store::JobUpdate& update) {
  check_traits("job.", update.priority.value_or(0), update.labels.value_or(store::Labels{}), update.note.value_or(""));
  return store_.update(uid, update);
}

/// The checkpoint that a retry begins with; none: from the start.
std::optional<store::Checkpoint> Queue::place_to_retry(const store::Job& base, RetryFrom from, int stage) const {
  if (from != RetryFrom::stage && stage != 0) refuse("INVALID_REQUEST", "stage", "is given", "ask for FROM_STAGE, or leave it out");
  if (from == RetryFrom::start) return std::nullopt;
  const std::vector<store::Checkpoint> known = store_.checkpoints(base.uid);
  if (from != RetryFrom::stage) {
    auto newest = workspace_.newest_checkpoint(known);
    if (!newest && from == RetryFrom::checkpoint)
      fail(ErrorCode::failed_precondition, "job {} has no checkpoint; retry it from the start", base.uid);
    return newest;
  }
  const int n = decode_spec(base.spec).case_().cascade().stages_size();
  if (stage < 1 || stage > n)
    refuse("INVALID_REQUEST", "stage", fmt::format("{} is not allowed", stage), fmt::format("must be 1 to {}", n));
  if (stage == 1) return std::nullopt;
  std::vector<store::Checkpoint> ends;
  for (const store::Checkpoint& c : known)
    if (sim::stage_ended_in(c.path) == stage - 2) ends.push_back(c);
  auto end = workspace_.newest_checkpoint(ends);
  if (!end)
    fail(ErrorCode::failed_precondition, "job {} has not kept an end of stage {}; retry it from an earlier stage", base.uid, stage - 1);
  return end;
}

store::Job Queue::retry(const std::string& uid, const std::string& request_id, RetryFrom from, int stage) {
  if (!is_uuid(request_id)) refuse("INVALID_REQUEST", "request_id", "is no UUID", "make a new UUID for each retry");
  const auto base = store_.find(uid);
  if (!base) fail(ErrorCode::not_found, "job {} does not exist; list the jobs to find its name", uid);
  if (!store::is_terminal(base->state)) fail(ErrorCode::failed_precondition, "job {} has not ended; cancel it first", uid);
  const std::optional<store::Checkpoint> checkpoint = place_to_retry(*base, from, stage);
  store::NewJob job;
  job.uid = make_uid_();
  job.request_id = lower(request_id);
  job.title = base->title;
  job.spec = base->spec;
  job.digest = base->digest;
  job.code_version = code_version();
  job.priority = base->priority;
  job.labels = base->labels;
  job.note = base->note;
  job.base_uid = uid;
  job.held = checkpoint.has_value();  // until its files are there
  store::Created created = store_.create_limited(job, limits_.queued_jobs);
  if (created.existed && created.job.base_uid != uid)
    refuse("REQUEST_ID_REUSED", "request_id", "is in use by job " + created.job.uid, "use a new one");
  store::Job out = std::move(created.job);
  // Also when a crash came between: the same request goes on where that one ended.
  if (checkpoint && out.state == State::held && out.last_sequence == 0 && out.attempt == 0)
    out = store_.adopt_history(out.uid, uid, workspace_.copy_checkpoint(*checkpoint, out.uid));
  wake_();
  return out;
}

int Queue::expire(std::int64_t ended_before_ns) {
  int n = 0;
  for (const std::string& uid : store_.ended_before(ended_before_ns, 100)) {
    erase(uid);
    ++n;
  }
  return n;
}

int Queue::sweep_files(std::chrono::seconds unused_for) {
  std::set<std::string> used;
  store::ListQuery running;
  running.states = {State::running, State::cancelling};
  running.limit = 1000;  // there are at most as many as workers
  for (const store::Job& row : store_.list(running)) {
    const auto job = store_.find(row.uid);
    if (!job) continue;
    const v1::CreateJobRequest spec = decode_spec(job->spec);
    for (const v1::CaseFile& file : spec.files()) used.insert(sha256_hex(file.content()));
  }
  return workspace_.sweep_files(unused_for, used);
}

void Queue::erase(const std::string& uid) {
  if (!store_.erase(uid)) fail(ErrorCode::failed_precondition, "job {} has not ended; cancel it first", uid);
  workspace_.remove_run(uid);
}

}  // namespace seaway::jobs
