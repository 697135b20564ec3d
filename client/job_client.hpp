// SPDX-License-Identifier: GPL-3.0-or-later
// The service as the commands see it: one call a function, deadlines, failures as exceptions. A call that
// finds the connection broken is repeated for about a second.
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/support/status.h>

#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "seaway/v1/job_service.grpc.pb.h"

namespace seaway::client {

/// What the program returns to its caller.
enum ExitCode {
  exit_ok = 0,
  exit_failed = 1,       ///< the job failed, or something went wrong that has no code of its own
  exit_usage = 2,        ///< wrong options, wrong case, wrong request
  exit_cancelled = 3,    ///< the job that was watched was cancelled
  exit_unreachable = 4,  ///< the server does not answer
  exit_not_found = 5,    ///< no such job or artifact
  exit_denied = 6,       ///< the server does not know who calls, or does not allow it
};

class ClientError : public std::runtime_error {
 public:
  ClientError(ExitCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// A status of the service that is not OK.
class RpcError : public ClientError {
 public:
  explicit RpcError(const grpc::Status& status);
  grpc::StatusCode status() const { return status_; }
  /// Field and description of what the service refused.
  const std::vector<std::pair<std::string, std::string>>& violations() const { return violations_; }

 private:
  grpc::StatusCode status_;
  std::vector<std::pair<std::string, std::string>> violations_;
};

/// PEM files and a token; what is empty is not used.
struct Credentials {
  std::string ca, certificate, key, token;
};

/// Where calls go, and in whose name.
struct Link {
  std::shared_ptr<grpc::Channel> channel;
  std::string authorization;  ///< of each call; empty: none
};

class JobClient {
 public:
  /// TLS if there is a ca. Throws ClientError for files that cannot be read.
  explicit JobClient(const std::string& server, const Credentials& credentials = {});

  /// On a channel of one's own.
  explicit JobClient(std::shared_ptr<grpc::Channel> channel, std::string token = "");

  /// Repeats a submit that got no answer with the same request id, so that it makes one job.
  v1::CreateJobResponse create(const v1::CreateJobRequest& request);
  v1::Job get(const std::string& name, v1::JobView view = v1::JOB_VIEW_BASIC);
  v1::ListJobsResponse list(const v1::ListJobsRequest& request);
  v1::Job cancel(const std::string& name);
  v1::Job kill(const std::string& name);
  v1::Job hold(const std::string& name);
  v1::Job release(const std::string& name);
  v1::Job retry(const v1::RetryJobRequest& request);
  v1::Job update(const v1::UpdateJobRequest& request);
  v1::ServerInfo info();
  void set_log_level(const std::string& level);
  v1::DecayReport decay(const v1::GetDecayReportRequest& request);
  v1::RaoReport rao(const v1::GetRaoReportRequest& request);
  /// As create().
  v1::CreateSweepResponse create_sweep(const v1::CreateSweepRequest& request);
  v1::Sweep sweep(const std::string& name);
  v1::ListSweepsResponse list_sweeps(const v1::ListSweepsRequest& request);
  v1::Sweep cancel_sweep(const std::string& name);
  v1::ReadEnvelopeResponse envelope(const v1::ReadEnvelopeRequest& request);
  /// Changes of jobs after a revision until `message` returns false or the stream ends.
  grpc::Status watch_jobs(std::int64_t after, const std::function<bool(const v1::WatchJobsResponse&)>& message);
  void erase(const std::string& name);
  v1::CaseReport validate(const v1::ValidateCaseRequest& request);
  v1::ListStagesResponse stages(const std::string& name);
  v1::ListArtifactsResponse artifacts(const std::string& name);
  /// The whole history, page by page.
  void history(const std::string& name, const std::function<void(const v1::ReadSamplesResponse&)>& page);
  void download(const std::string& name, const std::string& artifact, const std::function<void(const std::string&)>& piece);
  /// Waits so long, or until a connection that is missing has been made: before a stream is tried again.
  void pause(std::chrono::milliseconds time);
  /// One stream until it ends; `message` returns false to leave it.
  grpc::Status watch(const std::string& name, std::int64_t after,
                     const std::function<bool(const v1::WatchSamplesResponse&)>& message);

  /// jobs/<uid> out of what a person wrote: a uid, jobs/<uid>, or latest.
  std::string resolve(const std::string& job);
  /// sweeps/<uid>, likewise.
  std::string resolve_sweep(const std::string& sweep);

 private:
  Link link_;  // first: the others are made of it
  std::unique_ptr<v1::Jobs::Stub> jobs_;
  std::unique_ptr<v1::Telemetry::Stub> telemetry_;
  std::unique_ptr<v1::Stages::Stub> stages_;
  std::unique_ptr<v1::Artifacts::Stub> artifacts_;
  std::unique_ptr<v1::Reports::Stub> reports_;
  std::unique_ptr<v1::Sweeps::Stub> sweeps_;
  std::unique_ptr<v1::Admin::Stub> admin_;
  std::unique_ptr<v1::Cases::Stub> cases_;
};

/// A random UUID (version 4).
std::string new_request_id();

}  // namespace seaway::client
