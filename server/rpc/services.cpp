// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/services.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "server/jobs/submission.hpp"
#include "server/rpc/download.hpp"
#include "server/rpc/messages.hpp"
#include "server/rpc/unary.hpp"
#include "server/rpc/watch.hpp"

namespace seaway::rpc {
namespace {

template <class Work>
grpc::ServerUnaryReactor* answer(const Backend& b, grpc::CallbackServerContext* context, Work work) {
  return run_unary(context, b.registry, b.work, std::move(work));
}

store::Job find_job(const Backend& b, const std::string& name, const std::string& field) {
  const std::string uid = parse_job_name(name, field);
  auto job = b.store.find(uid);
  if (!job) fail(ErrorCode::not_found, "job {} does not exist", uid);
  return std::move(*job);
}

int page_size(int wanted, int normal, int largest) {
  if (wanted < 0 || wanted > largest)
    refuse_field("page_size", fmt::format("{} is not allowed", wanted), fmt::format("must be 0 to {}", largest));
  return wanted == 0 ? normal : wanted;
}

/// Admits a stream or answers at once that there are too many.
template <class Call, class... Args>
auto open_stream(const Backend& b, grpc::CallbackServerContext* context, Args&&... args) {
  auto call = std::make_shared<Call>(context, b.registry, b.work, b.streams, std::forward<Args>(args)...);
  auto* reactor = call.get();
  if (b.registry.size() >= static_cast<std::size_t>(b.max_calls)) reactor->refuse_too_many();
  call->start();
  return reactor;
}

}  // namespace

grpc::ServerUnaryReactor* JobsService::CreateJob(grpc::CallbackServerContext* context,
                                                 const v1::CreateJobRequest* request, v1::CreateJobResponse* response) {
  return answer(b_, context, [b = b_, request, response] {
    jobs::Submitted submitted = b.queue.submit(*request);
    *response->mutable_report() = std::move(submitted.report);
    if (submitted.has_job) *response->mutable_job() = to_proto(submitted.job);
  });
}

grpc::ServerUnaryReactor* JobsService::GetJob(grpc::CallbackServerContext* context, const v1::GetJobRequest* request,
                                              v1::Job* response) {
  return answer(b_, context, [b = b_, request, response] {
    const store::Job job = find_job(b, request->name(), "name");
    *response = to_proto(job);
    if (request->view() == v1::JOB_VIEW_BASIC) return;
    *response->mutable_case_() = std::move(*jobs::decode_spec(job.spec).mutable_case_());
    for (const store::Event& event : b.store.events(job.uid)) *response->add_events() = to_proto(event);
  });
}

grpc::ServerUnaryReactor* JobsService::ListJobs(grpc::CallbackServerContext* context,
                                                const v1::ListJobsRequest* request, v1::ListJobsResponse* response) {
  return answer(b_, context, [b = b_, request, response] {
    store::ListQuery query;
    query.limit = page_size(request->page_size(), 50, 1000);
    for (int i = 0; i < request->states_size(); ++i) {
      if (request->states(i) < v1::Job::STATE_QUEUED || request->states(i) > v1::Job::STATE_CANCELLED)
        refuse_field(fmt::format("states[{}]", i), "is no state", "see Job.State");
      query.states.push_back(static_cast<store::State>(request->states(i)));
    }
    query.before_id = parse_page_token(request->page_token(), query.states);
    const auto jobs = b.store.list(query);
    for (const store::Job& job : jobs) *response->add_jobs() = to_proto(job);
    if (static_cast<int>(jobs.size()) == query.limit)
      response->set_next_page_token(make_page_token(jobs.back().id, query.states));
  });
}

grpc::ServerUnaryReactor* JobsService::CancelJob(grpc::CallbackServerContext* context,
                                                 const v1::CancelJobRequest* request, v1::Job* response) {
  return answer(b_, context, [b = b_, request, response] {
    *response = to_proto(b.queue.cancel(parse_job_name(request->name(), "name")));
  });
}

grpc::ServerUnaryReactor* JobsService::DeleteJob(grpc::CallbackServerContext* context,
                                                 const v1::DeleteJobRequest* request, v1::DeleteJobResponse*) {
  return answer(b_, context, [b = b_, request] { b.queue.erase(parse_job_name(request->name(), "name")); });
}

grpc::ServerWriteReactor<v1::WatchSamplesResponse>* TelemetryService::WatchSamples(
    grpc::CallbackServerContext* context, const v1::WatchSamplesRequest* request) {
  return open_stream<WatchCall>(b_, context, b_.feeds, *request);
}

grpc::ServerUnaryReactor* TelemetryService::ReadSamples(grpc::CallbackServerContext* context,
                                                        const v1::ReadSamplesRequest* request,
                                                        v1::ReadSamplesResponse* response) {
  return answer(b_, context, [b = b_, request, response] {
    const int limit = page_size(request->page_size(), 1000, 5000);
    if (request->after_sequence() < 0) refuse_field("after_sequence", "is negative", "0 starts at the first sample");
    const store::Job job = find_job(b, request->job(), "job");
    const auto channels = b.store.channels(job.uid);
    const auto samples = b.store.samples(job.uid, request->after_sequence(), limit);
    v1::StreamHeader& header = *response->mutable_header();
    header.set_first_available(1);
    header.set_latest(std::max(job.last_sequence, samples.empty() ? 0 : samples.back().sequence));
    header.set_attempt(job.attempt);
    *header.mutable_channels() = to_proto(channels);
    if (!samples.empty()) *response->mutable_chunk() = to_proto(samples, channels);
  });
}

grpc::ServerUnaryReactor* StagesService::ListStages(grpc::CallbackServerContext* context,
                                                    const v1::ListStagesRequest* request,
                                                    v1::ListStagesResponse* response) {
  return answer(b_, context, [b = b_, request, response] {
    const std::string uid = parse_job_name(request->job(), "job");
    for (const store::StageRow& row : b.store.stages(uid))
      if (!response->add_stages()->ParseFromString(row.report))
        fail(ErrorCode::data_loss, "job {}: the report of stage {} cannot be read", uid, row.stage);
  });
}

grpc::ServerUnaryReactor* ArtifactsService::ListArtifacts(grpc::CallbackServerContext* context,
                                                          const v1::ListArtifactsRequest* request,
                                                          v1::ListArtifactsResponse* response) {
  return answer(b_, context, [b = b_, request, response] {
    for (const store::Artifact& a : b.store.artifacts(parse_job_name(request->job(), "job")))
      *response->add_artifacts() = to_proto(a);
  });
}

grpc::ServerWriteReactor<v1::DownloadArtifactResponse>* ArtifactsService::DownloadArtifact(
    grpc::CallbackServerContext* context, const v1::DownloadArtifactRequest* request) {
  return open_stream<DownloadCall>(b_, context, b_.store, *request);
}

grpc::ServerUnaryReactor* CasesService::ValidateCase(grpc::CallbackServerContext* context,
                                                     const v1::ValidateCaseRequest* request, v1::CaseReport* response) {
  return answer(b_, context, [b = b_, request, response] {
    if (!request->has_case_()) refuse_field("case", "is missing", "send the case to check");
    *response = b.queue.validate(request->case_(), request->files());
  });
}

}  // namespace seaway::rpc
