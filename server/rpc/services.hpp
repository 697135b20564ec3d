// SPDX-License-Identifier: GPL-3.0-or-later
// The methods of job_service.proto: take a request apart, ask queue or store, put the answer together.
#pragma once

#include "seaway/v1/job_service.grpc.pb.h"
#include "server/jobs/queue.hpp"
#include "server/rpc/access.hpp"
#include "server/rpc/facts.hpp"
#include "server/rpc/feed.hpp"
#include "server/rpc/registry.hpp"
#include "server/rpc/seats.hpp"
#include "server/rpc/stream_call.hpp"
#include "server/rpc/work_queue.hpp"

namespace seaway::rpc {

/// What the services share; all outlive them.
struct Backend {
  jobs::Queue& queue;
  store::JobStore& store;
  Feeds& feeds;
  Registry& registry;
  WorkQueue& work;
  Seats& seats;
  StreamLimits streams;
  const Access& access;
  const ServerFacts& facts;
};

class JobsService final : public v1::Jobs::CallbackService {
 public:
  explicit JobsService(Backend backend) : b_(backend) {}
  grpc::ServerUnaryReactor* CreateJob(grpc::CallbackServerContext* context, const v1::CreateJobRequest* request,
                                      v1::CreateJobResponse* response) override;
  grpc::ServerUnaryReactor* GetJob(grpc::CallbackServerContext* context, const v1::GetJobRequest* request,
                                   v1::Job* response) override;
  grpc::ServerUnaryReactor* ListJobs(grpc::CallbackServerContext* context, const v1::ListJobsRequest* request,
                                     v1::ListJobsResponse* response) override;
  grpc::ServerUnaryReactor* CancelJob(grpc::CallbackServerContext* context, const v1::CancelJobRequest* request,
                                      v1::Job* response) override;
  grpc::ServerUnaryReactor* KillJob(grpc::CallbackServerContext* context, const v1::KillJobRequest* request,
                                    v1::Job* response) override;
  grpc::ServerUnaryReactor* HoldJob(grpc::CallbackServerContext* context, const v1::HoldJobRequest* request,
                                    v1::Job* response) override;
  grpc::ServerUnaryReactor* ReleaseJob(grpc::CallbackServerContext* context, const v1::ReleaseJobRequest* request,
                                       v1::Job* response) override;
  grpc::ServerUnaryReactor* RetryJob(grpc::CallbackServerContext* context, const v1::RetryJobRequest* request,
                                     v1::Job* response) override;
  grpc::ServerUnaryReactor* UpdateJob(grpc::CallbackServerContext* context, const v1::UpdateJobRequest* request,
                                      v1::Job* response) override;
  grpc::ServerUnaryReactor* DeleteJob(grpc::CallbackServerContext* context, const v1::DeleteJobRequest* request,
                                      v1::DeleteJobResponse* response) override;

 private:
  Backend b_;
};

class TelemetryService final : public v1::Telemetry::CallbackService {
 public:
  explicit TelemetryService(Backend backend) : b_(backend) {}
  grpc::ServerWriteReactor<v1::WatchSamplesResponse>* WatchSamples(grpc::CallbackServerContext* context,
                                                                   const v1::WatchSamplesRequest* request) override;
  grpc::ServerWriteReactor<v1::WatchJobsResponse>* WatchJobs(grpc::CallbackServerContext* context,
                                                             const v1::WatchJobsRequest* request) override;
  grpc::ServerUnaryReactor* ReadEnvelope(grpc::CallbackServerContext* context, const v1::ReadEnvelopeRequest* request,
                                         v1::ReadEnvelopeResponse* response) override;
  grpc::ServerUnaryReactor* ReadSamples(grpc::CallbackServerContext* context, const v1::ReadSamplesRequest* request,
                                        v1::ReadSamplesResponse* response) override;

 private:
  Backend b_;
};

class StagesService final : public v1::Stages::CallbackService {
 public:
  explicit StagesService(Backend backend) : b_(backend) {}
  grpc::ServerUnaryReactor* ListStages(grpc::CallbackServerContext* context, const v1::ListStagesRequest* request,
                                       v1::ListStagesResponse* response) override;

 private:
  Backend b_;
};

class ArtifactsService final : public v1::Artifacts::CallbackService {
 public:
  explicit ArtifactsService(Backend backend) : b_(backend) {}
  grpc::ServerUnaryReactor* ListArtifacts(grpc::CallbackServerContext* context, const v1::ListArtifactsRequest* request,
                                          v1::ListArtifactsResponse* response) override;
  grpc::ServerWriteReactor<v1::DownloadArtifactResponse>* DownloadArtifact(
      grpc::CallbackServerContext* context, const v1::DownloadArtifactRequest* request) override;

 private:
  Backend b_;
};

class ReportsService final : public v1::Reports::CallbackService {
 public:
  explicit ReportsService(Backend backend) : b_(backend) {}
  grpc::ServerUnaryReactor* GetDecayReport(grpc::CallbackServerContext* context, const v1::GetDecayReportRequest* request,
                                           v1::DecayReport* response) override;
  grpc::ServerUnaryReactor* GetRaoReport(grpc::CallbackServerContext* context, const v1::GetRaoReportRequest* request,
                                         v1::RaoReport* response) override;

 private:
  Backend b_;
};

class SweepsService final : public v1::Sweeps::CallbackService {
 public:
  explicit SweepsService(Backend backend) : b_(backend) {}
  grpc::ServerUnaryReactor* CreateSweep(grpc::CallbackServerContext* context, const v1::CreateSweepRequest* request,
                                        v1::CreateSweepResponse* response) override;
  grpc::ServerUnaryReactor* GetSweep(grpc::CallbackServerContext* context, const v1::GetSweepRequest* request,
                                     v1::Sweep* response) override;
  grpc::ServerUnaryReactor* ListSweeps(grpc::CallbackServerContext* context, const v1::ListSweepsRequest* request,
                                       v1::ListSweepsResponse* response) override;
  grpc::ServerUnaryReactor* CancelSweep(grpc::CallbackServerContext* context, const v1::CancelSweepRequest* request,
                                        v1::Sweep* response) override;

 private:
  Backend b_;
};

class AdminService final : public v1::Admin::CallbackService {
 public:
  explicit AdminService(Backend backend) : b_(backend) {}
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context, const v1::GetServerInfoRequest* request,
                                          v1::ServerInfo* response) override;
  grpc::ServerUnaryReactor* SetLogLevel(grpc::CallbackServerContext* context, const v1::SetLogLevelRequest* request,
                                        v1::SetLogLevelResponse* response) override;

 private:
  Backend b_;
};

class CasesService final : public v1::Cases::CallbackService {
 public:
  explicit CasesService(Backend backend) : b_(backend) {}
  grpc::ServerUnaryReactor* ValidateCase(grpc::CallbackServerContext* context, const v1::ValidateCaseRequest* request,
                                         v1::CaseReport* response) override;

 private:
  Backend b_;
};

}  // namespace seaway::rpc
