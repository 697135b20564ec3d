// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/services.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "server/jobs/requests.hpp"
#include "server/jobs/submission.hpp"
#include "server/rpc/answer.hpp"
#include "server/rpc/download.hpp"
#include "server/rpc/messages.hpp"
#include "server/rpc/watch.hpp"
#include "server/rpc/watch_jobs.hpp"

namespace seaway::rpc {
namespace {

void fill_header(const store::Job& job, const std::vector<store::Channel>& channels, v1::StreamHeader& header) {
  header.set_first_available(1);
  header.set_latest(job.last_sequence);
  header.set_attempt(job.attempt);
  *header.mutable_channels() = to_proto(channels);
}

/// Admits a stream or answers at once that it is not allowed, or that there are too many.
template <class Call, class... Args>
auto open_stream(const Backend& b, grpc::CallbackServerContext* context, const char* method, const std::string& target,
                 Args&&... args) {
  auto call = std::make_shared<Call>(context, b.registry, b.work, b.streams, std::forward<Args>(args)...);
  auto* reactor = call.get();
  try {
    const std::string who = b.access.check(*context, Role::viewer, method, target);
    reactor->admit(b.seats.take(b.access.asks() ? who : context->peer()));
  } catch (...) {
    reactor->refuse(to_status(std::current_exception()));
  }
  call->start();
  return reactor;
}

}  // namespace

grpc::ServerUnaryReactor* JobsService::CreateJob(grpc::CallbackServerContext* context,
                                                 const v1::CreateJobRequest* request, v1::CreateJobResponse* response) {
  return answer_later(b_, context, {Role::submitter, "CreateJob"}, "cases/" + request->case_().title(), [b = b_, request, response](Finish finish) {
    b.queue.submit_later(*request, [response, finish = std::move(finish)](jobs::Submitted submitted, const std::exception_ptr& error) {
      *response->mutable_report() = std::move(submitted.report);
      if (submitted.has_job) *response->mutable_job() = to_proto(submitted.job);
      finish(error);
    });
  });
}

grpc::ServerUnaryReactor* JobsService::GetJob(grpc::CallbackServerContext* context, const v1::GetJobRequest* request,
                                              v1::Job* response) {
  return answer(b_, context, {Role::viewer, "GetJob"}, request->name(), [b = b_, request, response] {
    if (!v1::JobView_IsValid(request->view())) refuse_field("view", fmt::format("{} is unknown", static_cast<int>(request->view())), "see JobView");
    const store::Job job = find_job(b, request->name(), "name");
    *response = to_proto(job);
    if (request->view() == v1::JOB_VIEW_BASIC) return;
    *response->mutable_case_() = std::move(*jobs::decode_spec(job.spec).mutable_case_());
    for (const store::Event& event : b.store.events(job.uid)) *response->add_events() = to_proto(event);
  });
}

grpc::ServerUnaryReactor* JobsService::ListJobs(grpc::CallbackServerContext* context,
                                                const v1::ListJobsRequest* request, v1::ListJobsResponse* response) {
  return answer(b_, context, {Role::viewer, "ListJobs"}, "jobs", [b = b_, request, response] {
    store::ListQuery query;
    query.limit = page_size(request->page_size(), 50, 1000);
    for (int i = 0; i < request->states_size(); ++i) {
      if (request->states(i) < v1::Job::STATE_QUEUED || request->states(i) > v1::Job::STATE_CANCELLED)
        refuse_field(fmt::format("states[{}]", i), "is no state", "see Job.State");
      query.states.push_back(static_cast<store::State>(request->states(i)));
    }
    query.labels = {request->labels().begin(), request->labels().end()};
    jobs::check_labels("labels", query.labels);
    query.before_id = parse_page_token(request->page_token(), query);
    const auto jobs = b.store.list(query);
    for (const store::Job& job : jobs) *response->add_jobs() = to_proto(job);
    if (static_cast<int>(jobs.size()) == query.limit)
      response->set_next_page_token(make_page_token(jobs.back().id, query));
  });
}

grpc::ServerUnaryReactor* JobsService::CancelJob(grpc::CallbackServerContext* context,
                                                 const v1::CancelJobRequest* request, v1::Job* response) {
  return answer(b_, context, {Role::submitter, "CancelJob"}, request->name(), [b = b_, request, response] {
    *response = to_proto(b.queue.cancel(parse_job_name(request->name(), "name")));
  });
}

grpc::ServerUnaryReactor* JobsService::KillJob(grpc::CallbackServerContext* context, const v1::KillJobRequest* request,
                                               v1::Job* response) {
  return answer(b_, context, {Role::submitter, "KillJob"}, request->name(), [b = b_, request, response] {
    *response = to_proto(b.queue.kill(parse_job_name(request->name(), "name")));
  });
}

grpc::ServerUnaryReactor* JobsService::HoldJob(grpc::CallbackServerContext* context, const v1::HoldJobRequest* request,
                                               v1::Job* response) {
  return answer(b_, context, {Role::submitter, "HoldJob"}, request->name(), [b = b_, request, response] {
    *response = to_proto(b.queue.hold(parse_job_name(request->name(), "name")));
  });
}

grpc::ServerUnaryReactor* JobsService::ReleaseJob(grpc::CallbackServerContext* context,
                                                  const v1::ReleaseJobRequest* request, v1::Job* response) {
  return answer(b_, context, {Role::submitter, "ReleaseJob"}, request->name(), [b = b_, request, response] {
    *response = to_proto(b.queue.release(parse_job_name(request->name(), "name")));
  });
}

grpc::ServerUnaryReactor* JobsService::RetryJob(grpc::CallbackServerContext* context,
                                                const v1::RetryJobRequest* request, v1::Job* response) {
  return answer(b_, context, {Role::submitter, "RetryJob"}, request->name(), [b = b_, request, response] {
    auto from = jobs::RetryFrom::any;
    switch (request->from()) {
      case v1::RetryJobRequest::FROM_UNSPECIFIED: break;
      case v1::RetryJobRequest::FROM_START: from = jobs::RetryFrom::start; break;
      case v1::RetryJobRequest::FROM_LAST_CHECKPOINT: from = jobs::RetryFrom::checkpoint; break;
      case v1::RetryJobRequest::FROM_STAGE: from = jobs::RetryFrom::stage; break;
      default: refuse_field("from", "is unknown", "see RetryJobRequest.From");
    }
    *response = to_proto(b.queue.retry(parse_job_name(request->name(), "name"), request->request_id(), from, request->stage()));
  });
}

grpc::ServerUnaryReactor* JobsService::UpdateJob(grpc::CallbackServerContext* context,
                                                 const v1::UpdateJobRequest* request, v1::Job* response) {
  return answer(b_, context, {Role::submitter, "UpdateJob"}, request->job().name(), [b = b_, request, response] {
    store::JobUpdate update;
    const v1::Job& job = request->job();
    for (const std::string& path : request->update_mask().paths()) {
      if (path == "priority")
        update.priority = job.priority();
      else if (path == "note")
        update.note = job.note();
      else if (path == "labels")
        update.labels = store::Labels(job.labels().begin(), job.labels().end());
      else
        refuse_field("update_mask", "'" + path + "' cannot be changed", "allowed are priority, labels, note");
    }
    if (request->update_mask().paths_size() == 0) refuse_field("update_mask", "is missing", "name what shall change");
    *response = to_proto(b.queue.update(parse_job_name(job.name(), "job.name"), update));
  });
}

grpc::ServerUnaryReactor* JobsService::DeleteJob(grpc::CallbackServerContext* context,
                                                 const v1::DeleteJobRequest* request, v1::DeleteJobResponse*) {
  return answer(b_, context, {Role::admin, "DeleteJob"}, request->name(), [b = b_, request] { b.queue.erase(parse_job_name(request->name(), "name")); });
}

grpc::ServerWriteReactor<v1::WatchSamplesResponse>* TelemetryService::WatchSamples(
    grpc::CallbackServerContext* context, const v1::WatchSamplesRequest* request) {
  return open_stream<WatchCall>(b_, context, "WatchSamples", request->job(), b_.feeds, *request);
}

grpc::ServerWriteReactor<v1::WatchJobsResponse>* TelemetryService::WatchJobs(grpc::CallbackServerContext* context,
                                                                             const v1::WatchJobsRequest* request) {
  return open_stream<WatchJobsCall>(b_, context, "WatchJobs", "jobs", b_.feeds, b_.store, *request);
}

grpc::ServerUnaryReactor* TelemetryService::ReadEnvelope(grpc::CallbackServerContext* context,
                                                         const v1::ReadEnvelopeRequest* request,
                                                         v1::ReadEnvelopeResponse* response) {
  return answer(b_, context, {Role::viewer, "ReadEnvelope"}, request->job(), [b = b_, request, response] {
    const int most = request->max_points() == 0 ? 1000 : request->max_points();
    if (most < 2 || most > 10'000) refuse_field("max_points", fmt::format("{} is not allowed", most), "must be 2 to 10000");
    if (request->after_sequence() < 0) refuse_field("after_sequence", "is negative", "0 starts at the first sample");
    if (request->until_sequence() < 0) refuse_field("until_sequence", "is negative", "0 goes to the last sample");
    if (request->until_sequence() > 0 && request->until_sequence() <= request->after_sequence())
      refuse_field("until_sequence", fmt::format("{} leaves nothing", request->until_sequence()), "must be above after_sequence, or 0");
    const store::Job job = find_job(b, request->job(), "job");
    const auto channels = b.store.channels(job.uid);
    to_proto(b.store.envelope(job.uid, request->after_sequence(), request->until_sequence(), most), channels, *response);
    fill_header(job, channels, *response->mutable_header());
  });
}

grpc::ServerUnaryReactor* TelemetryService::ReadSamples(grpc::CallbackServerContext* context,
                                                        const v1::ReadSamplesRequest* request,
                                                        v1::ReadSamplesResponse* response) {
  return answer(b_, context, {Role::viewer, "ReadSamples"}, request->job(), [b = b_, request, response] {
    const int limit = page_size(request->page_size(), 1000, 5000);
    if (request->after_sequence() < 0) refuse_field("after_sequence", "is negative", "0 starts at the first sample");
    const store::Job job = find_job(b, request->job(), "job");
    const auto channels = b.store.channels(job.uid);
    const auto samples = b.store.samples(job.uid, request->after_sequence(), limit);
    fill_header(job, channels, *response->mutable_header());
    if (!samples.empty()) response->mutable_header()->set_latest(std::max(job.last_sequence, samples.back().sequence));
    if (!samples.empty()) *response->mutable_chunk() = to_proto(samples, channels);
  });
}

grpc::ServerUnaryReactor* StagesService::ListStages(grpc::CallbackServerContext* context,
                                                    const v1::ListStagesRequest* request,
                                                    v1::ListStagesResponse* response) {
  return answer(b_, context, {Role::viewer, "ListStages"}, request->job(), [b = b_, request, response] {
    const std::string uid = parse_job_name(request->job(), "job");
    for (const store::StageRow& row : b.store.stages(uid))
      if (!response->add_stages()->ParseFromString(row.report))
        fail(ErrorCode::data_loss, "job {}: the report of stage {} cannot be read", uid, row.stage);
  });
}

grpc::ServerUnaryReactor* ArtifactsService::ListArtifacts(grpc::CallbackServerContext* context,
                                                          const v1::ListArtifactsRequest* request,
                                                          v1::ListArtifactsResponse* response) {
  return answer(b_, context, {Role::viewer, "ListArtifacts"}, request->job(), [b = b_, request, response] {
    for (const store::Artifact& a : b.store.artifacts(parse_job_name(request->job(), "job")))
      *response->add_artifacts() = to_proto(a);
  });
}

grpc::ServerWriteReactor<v1::DownloadArtifactResponse>* ArtifactsService::DownloadArtifact(
    grpc::CallbackServerContext* context, const v1::DownloadArtifactRequest* request) {
  return open_stream<DownloadCall>(b_, context, "DownloadArtifact", request->job(), b_.store, *request);
}

grpc::ServerUnaryReactor* AdminService::GetServerInfo(grpc::CallbackServerContext* context,
                                                      const v1::GetServerInfoRequest*, v1::ServerInfo* response) {
  return answer(b_, context, {Role::viewer, "GetServerInfo"}, "server", [b = b_, response] {
    response->set_version(std::string(code_version()));
    response->set_executor(b.facts.executor);
    response->set_worker_count(b.facts.workers);
    response->set_log_level(b.facts.log_level());
    response->set_storage_ok(!b.store.is_stuck());
    const auto counts = b.store.counts();
    for (int state = v1::Job::STATE_QUEUED; state <= v1::Job::STATE_CANCELLED; ++state) {
      const auto found = counts.find(static_cast<store::State>(state));
      response->add_job_counts(found == counts.end() ? 0 : found->second);
    }
  });
}

grpc::ServerUnaryReactor* AdminService::SetLogLevel(grpc::CallbackServerContext* context,
                                                    const v1::SetLogLevelRequest* request, v1::SetLogLevelResponse*) {
  return answer(b_, context, {Role::admin, "SetLogLevel"}, "server", [b = b_, request] {
    if (!b.facts.set_log_level(request->level()))
      refuse_field("level", "'" + request->level() + "' is unknown", "allowed are trace, debug, info, warn, error");
  });
}

grpc::ServerUnaryReactor* CasesService::ValidateCase(grpc::CallbackServerContext* context,
                                                     const v1::ValidateCaseRequest* request, v1::CaseReport* response) {
  return answer(b_, context, {Role::viewer, "ValidateCase"}, "cases", [b = b_, request, response] {
    if (!request->has_case_()) refuse_field("case", "is missing", "send the case to check");
    *response = b.queue.validate(request->case_(), request->files());
  });
}

}  // namespace seaway::rpc
