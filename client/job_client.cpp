// SPDX-License-Identifier: GPL-3.0-or-later
#include "client/job_client.hpp"

#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace seaway::client {
namespace {

ExitCode exit_code(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::OUT_OF_RANGE:
    case grpc::StatusCode::FAILED_PRECONDITION: return exit_usage;
    case grpc::StatusCode::NOT_FOUND: return exit_not_found;
    case grpc::StatusCode::UNAUTHENTICATED:
    case grpc::StatusCode::PERMISSION_DENIED: return exit_denied;
    case grpc::StatusCode::UNAVAILABLE:
    case grpc::StatusCode::DEADLINE_EXCEEDED: return exit_unreachable;
    default: return exit_failed;
  }
}

std::string text_of(const grpc::Status& status) {
  if (status.error_code() == grpc::StatusCode::UNAVAILABLE && status.error_details().empty())
    return "the server cannot be reached (" + status.error_message() + "); is seawayd running there? See --server";
  return status.error_message();
}

void check(const grpc::Status& status) {
  if (!status.ok()) throw RpcError(status);
}

void authorize(grpc::ClientContext& context, const std::string& authorization) {
  if (!authorization.empty()) context.AddMetadata("authorization", authorization);
}

std::string read_pem(const std::string& file) {
  if (file.empty()) return {};
  std::ifstream in(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  if (text.find("-----BEGIN") == text.npos) throw ClientError(exit_usage, file + " cannot be read or is no PEM file");
  return text;
}

void set_deadline(grpc::ClientContext& context, int seconds) {
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(seconds));
}

/// As JobClient::pause(). gRPC notices what became of a connection only while somebody waits for it, or every five seconds.
void pause(grpc::Channel& channel, std::chrono::milliseconds time) {
  const auto until = std::chrono::system_clock::now() + time;
  if (channel.GetState(true) != GRPC_CHANNEL_READY) channel.WaitForConnected(until);
  else std::this_thread::sleep_until(until);
}

/// The request that has but the name of what it is about.
template <class Request>
Request of(const std::string& name) {
  Request request;
  request.set_name(name);
  return request;
}

/// All calls of the service can be repeated, so a connection that breaks (a restart of the server) is tried again.
template <class Response, class Call>
Response unary(const Link& link, Call call, int seconds = 10) {
  for (int attempt = 1;; ++attempt) {
    grpc::ClientContext context;
    authorize(context, link.authorization);
    set_deadline(context, seconds);
    Response response;
    const grpc::Status status = call(&context, &response);
    if (status.ok()) return response;
    if (status.error_code() != grpc::StatusCode::UNAVAILABLE || attempt == 5) throw RpcError(status);
    pause(*link.channel, std::chrono::milliseconds(100 * attempt));
  }
}

}  // namespace

RpcError::RpcError(const grpc::Status& status)
    : ClientError(exit_code(status.error_code()), text_of(status)), status_(status.error_code()) {
  google::rpc::Status details;
  if (!details.ParseFromString(status.error_details())) return;
  google::rpc::BadRequest bad;
  for (const auto& any : details.details()) {
    if (!any.UnpackTo(&bad)) continue;
    for (const auto& v : bad.field_violations()) violations_.emplace_back(v.field(), v.description());
  }
}

namespace {

std::shared_ptr<grpc::Channel> open_channel(const std::string& server, const Credentials& credentials) {
  grpc::ChannelArguments arguments;
  // As the server expects it: pings every 30 s find a vanished peer.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 30'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 400);  // unary() gives up after a second
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 200);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 2'000);  // also the time that a connection may take
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  arguments.SetMaxReceiveMessageSize(64 << 20);
  const auto how = credentials.ca.empty()
                       ? grpc::InsecureChannelCredentials()
                       : grpc::SslCredentials({read_pem(credentials.ca), read_pem(credentials.key), read_pem(credentials.certificate)});
  return grpc::CreateCustomChannel(server, how, arguments);
}

}  // namespace

JobClient::JobClient(const std::string& server, const Credentials& credentials)
    : JobClient(open_channel(server, credentials), credentials.token) {}

JobClient::JobClient(std::shared_ptr<grpc::Channel> channel, std::string token)
    : link_{std::move(channel), token.empty() ? "" : "Bearer " + token},
      jobs_(v1::Jobs::NewStub(link_.channel)),
      telemetry_(v1::Telemetry::NewStub(link_.channel)),
      stages_(v1::Stages::NewStub(link_.channel)),
      artifacts_(v1::Artifacts::NewStub(link_.channel)),
      reports_(v1::Reports::NewStub(link_.channel)),
      sweeps_(v1::Sweeps::NewStub(link_.channel)),
      admin_(v1::Admin::NewStub(link_.channel)),
      cases_(v1::Cases::NewStub(link_.channel)) {}

v1::CreateJobResponse JobClient::create(const v1::CreateJobRequest& request) {
  return unary<v1::CreateJobResponse>(link_, [&](auto* c, auto* r) { return jobs_->CreateJob(c, request, r); }, 60);
}

v1::Job JobClient::get(const std::string& name, v1::JobView view) {
  v1::GetJobRequest request;
  request.set_name(name);
  request.set_view(view);
  return unary<v1::Job>(link_, [&](auto* c, auto* r) { return jobs_->GetJob(c, request, r); });
}

v1::ListJobsResponse JobClient::list(const v1::ListJobsRequest& request) {
  return unary<v1::ListJobsResponse>(link_, [&](auto* c, auto* r) { return jobs_->ListJobs(c, request, r); });
}

v1::Job JobClient::cancel(const std::string& name) {
  return unary<v1::Job>(link_, [&](auto* c, auto* r) { return jobs_->CancelJob(c, of<v1::CancelJobRequest>(name), r); });
}

v1::Job JobClient::kill(const std::string& name) {
  return unary<v1::Job>(link_, [&](auto* c, auto* r) { return jobs_->KillJob(c, of<v1::KillJobRequest>(name), r); });
}

v1::Job JobClient::hold(const std::string& name) {
  return unary<v1::Job>(link_, [&](auto* c, auto* r) { return jobs_->HoldJob(c, of<v1::HoldJobRequest>(name), r); });
}

v1::Job JobClient::release(const std::string& name) {
  return unary<v1::Job>(link_, [&](auto* c, auto* r) { return jobs_->ReleaseJob(c, of<v1::ReleaseJobRequest>(name), r); });
}

v1::Job JobClient::retry(const v1::RetryJobRequest& request) {
  return unary<v1::Job>(link_, [&](auto* c, auto* r) { return jobs_->RetryJob(c, request, r); }, 60);
}

v1::Job JobClient::update(const v1::UpdateJobRequest& request) {
  return unary<v1::Job>(link_, [&](auto* c, auto* r) { return jobs_->UpdateJob(c, request, r); });
}

v1::ServerInfo JobClient::info() {
  return unary<v1::ServerInfo>(link_, [&](auto* c, auto* r) { return admin_->GetServerInfo(c, {}, r); });
}

void JobClient::set_log_level(const std::string& level) {
  v1::SetLogLevelRequest request;
  request.set_level(level);
  unary<v1::SetLogLevelResponse>(link_, [&](auto* c, auto* r) { return admin_->SetLogLevel(c, request, r); });
}

v1::DecayReport JobClient::decay(const v1::GetDecayReportRequest& request) {
  return unary<v1::DecayReport>(link_, [&](auto* c, auto* r) { return reports_->GetDecayReport(c, request, r); }, 60);
}

v1::RaoReport JobClient::rao(const v1::GetRaoReportRequest& request) {
  return unary<v1::RaoReport>(link_, [&](auto* c, auto* r) { return reports_->GetRaoReport(c, request, r); }, 300);
}

v1::CreateSweepResponse JobClient::create_sweep(const v1::CreateSweepRequest& request) {
  return unary<v1::CreateSweepResponse>(link_, [&](auto* c, auto* r) { return sweeps_->CreateSweep(c, request, r); }, 300);
}

v1::Sweep JobClient::sweep(const std::string& name) {
  return unary<v1::Sweep>(link_, [&](auto* c, auto* r) { return sweeps_->GetSweep(c, of<v1::GetSweepRequest>(name), r); });
}

v1::ListSweepsResponse JobClient::list_sweeps(const v1::ListSweepsRequest& request) {
  return unary<v1::ListSweepsResponse>(link_, [&](auto* c, auto* r) { return sweeps_->ListSweeps(c, request, r); });
}

v1::Sweep JobClient::cancel_sweep(const std::string& name) {
  return unary<v1::Sweep>(
      link_, [&](auto* c, auto* r) { return sweeps_->CancelSweep(c, of<v1::CancelSweepRequest>(name), r); }, 60);
}

v1::ReadEnvelopeResponse JobClient::envelope(const v1::ReadEnvelopeRequest& request) {
  return unary<v1::ReadEnvelopeResponse>(link_, [&](auto* c, auto* r) { return telemetry_->ReadEnvelope(c, request, r); }, 30);
}

grpc::Status JobClient::watch_jobs(std::int64_t after, const std::function<bool(const v1::WatchJobsResponse&)>& message) {
  v1::WatchJobsRequest request;
  request.set_after_revision(after);
  grpc::ClientContext context;
  authorize(context, link_.authorization);
  const auto reader = telemetry_->WatchJobs(&context, request);
  v1::WatchJobsResponse response;
  while (reader->Read(&response)) {
    if (message(response)) continue;
    context.TryCancel();
    reader->Finish();
    return grpc::Status::OK;
  }
  return reader->Finish();
}

void JobClient::erase(const std::string& name) {
  unary<v1::DeleteJobResponse>(link_, [&](auto* c, auto* r) { return jobs_->DeleteJob(c, of<v1::DeleteJobRequest>(name), r); });
}

v1::CaseReport JobClient::validate(const v1::ValidateCaseRequest& request) {
  return unary<v1::CaseReport>(link_, [&](auto* c, auto* r) { return cases_->ValidateCase(c, request, r); }, 60);
}

v1::ListStagesResponse JobClient::stages(const std::string& name) {
  v1::ListStagesRequest request;
  request.set_job(name);
  return unary<v1::ListStagesResponse>(link_, [&](auto* c, auto* r) { return stages_->ListStages(c, request, r); });
}

v1::ListArtifactsResponse JobClient::artifacts(const std::string& name) {
  v1::ListArtifactsRequest request;
  request.set_job(name);
  return unary<v1::ListArtifactsResponse>(link_, [&](auto* c, auto* r) { return artifacts_->ListArtifacts(c, request, r); });
}

void JobClient::history(const std::string& name, const std::function<void(const v1::ReadSamplesResponse&)>& page) {
  v1::ReadSamplesRequest request;
  request.set_job(name);
  request.set_page_size(5000);
  for (;;) {
    const auto response =
        unary<v1::ReadSamplesResponse>(link_, [&](auto* c, auto* r) { return telemetry_->ReadSamples(c, request, r); }, 30);
    page(response);
    if (response.chunk().times_s_size() == 0) return;
    request.set_after_sequence(response.chunk().first_sequence() + response.chunk().times_s_size() - 1);
  }
}

void JobClient::download(const std::string& name, const std::string& artifact,
                         const std::function<void(const std::string&)>& piece) {
  v1::DownloadArtifactRequest request;
  request.set_job(name);
  request.set_artifact(artifact);
  for (int failures = 0;;) {
    grpc::ClientContext context;
    authorize(context, link_.authorization);
    set_deadline(context, 600);
    const auto reader = artifacts_->DownloadArtifact(&context, request);
    v1::DownloadArtifactResponse response;
    while (reader->Read(&response)) {
      piece(response.data());
      request.set_offset(request.offset() + static_cast<std::int64_t>(response.data().size()));
      failures = 0;
    }
    const grpc::Status status = reader->Finish();
    if (status.ok()) return;
    if (status.error_code() != grpc::StatusCode::UNAVAILABLE || ++failures > 10) check(status);
    pause(std::chrono::milliseconds(200 * failures));
  }
}

void JobClient::pause(std::chrono::milliseconds time) { client::pause(*link_.channel, time); }

grpc::Status JobClient::watch(const std::string& name, std::int64_t after,
                              const std::function<bool(const v1::WatchSamplesResponse&)>& message) {
  v1::WatchSamplesRequest request;
  request.set_job(name);
  request.set_after_sequence(after);
  grpc::ClientContext context;
  authorize(context, link_.authorization);
  const auto reader = telemetry_->WatchSamples(&context, request);
  v1::WatchSamplesResponse response;
  while (reader->Read(&response)) {
    if (message(response)) continue;
    context.TryCancel();
    reader->Finish();
    return grpc::Status::OK;
  }
  return reader->Finish();
}

std::string JobClient::resolve(const std::string& job) {
  if (job.starts_with("jobs/")) return job;
  if (job != "latest") return "jobs/" + job;
  v1::ListJobsRequest request;
  request.set_page_size(1);
  const auto jobs = list(request);
  if (jobs.jobs_size() == 0) throw ClientError(exit_not_found, "there is no job yet; submit one");
  return jobs.jobs(0).name();
}

std::string JobClient::resolve_sweep(const std::string& sweep) {
  if (sweep.starts_with("sweeps/")) return sweep;
  if (sweep != "latest") return "sweeps/" + sweep;
  v1::ListSweepsRequest request;
  request.set_page_size(1);
  const auto found = list_sweeps(request);
  if (found.sweeps_size() == 0) throw ClientError(exit_not_found, "there is no sweep yet; make one");
  return found.sweeps(0).name();
}

std::string new_request_id() {
  static thread_local std::random_device random;  // opening it costs more than the numbers
  std::array<unsigned, 4> r{};
  for (unsigned& x : r) x = random();
  char text[40];
  std::snprintf(text, sizeof text, "%08x-%04x-4%03x-%04x-%04x%08x", r[0], r[1] >> 16, r[1] & 0xfffu,
                0x8000u | ((r[2] >> 16) & 0x3fffu), r[2] & 0xffffu, r[3]);
  return text;
}

}  // namespace seaway::client
