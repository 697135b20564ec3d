// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/server.hpp"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>
#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/base/error.hpp"
#include "server/rpc/call_threads.hpp"
#include "server/rpc/malformed.hpp"
#include "server/rpc/services.hpp"

namespace seaway::rpc {
namespace {

constexpr int max_message_bytes = 8 << 20;

void set_keepalive(grpc::ServerBuilder& builder) {
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 30'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 20'000);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  builder.AddChannelArgument(GRPC_ARG_TCP_READ_CHUNK_SIZE, 2048);  // requests are small, connections many
  builder.AddChannelArgument(GRPC_ARG_HTTP2_WRITE_BUFFER_SIZE, 4096);  // the rest waits in the store
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);  // a second server on the port is a mistake
}

}  // namespace

struct Server::Parts {
  Parts(const ServerSettings& s, jobs::Queue& queue, store::JobStore& store)
      : seats(s.max_streams, s.max_streams_per_caller),
        work(s.work_threads, 4096),
        feeds(store),
        access(s.access, store),
        facts(s.facts),
        jobs(backend(s, queue, store)),
        telemetry(backend(s, queue, store)),
        stages(backend(s, queue, store)),
        artifacts(backend(s, queue, store)),
        reports(backend(s, queue, store)),
        sweeps(backend(s, queue, store)),
        admin(backend(s, queue, store)),
        cases(backend(s, queue, store)) {}

  Backend backend(const ServerSettings& s, jobs::Queue& queue, store::JobStore& store) {
    return {queue, store, feeds, registry, work, seats, s.streams, access, facts};
  }

  void tick_loop(std::stop_token stop, const store::JobStore& store) {
    std::mutex mutex;
    std::condition_variable_any wake;
    std::unique_lock lock(mutex);
    while (!wake.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; }) && !stop.stop_requested()) {
      registry.tick_all(std::chrono::steady_clock::now());
      server->GetHealthCheckService()->SetServingStatus("storage", !store.is_stuck());
    }
  }

  Seats seats;  // first: the work queue may hold the last of a call
  Registry registry;
  WorkQueue work;
  Feeds feeds;
  const Access access;
  const ServerFacts facts;
  JobsService jobs;
  TelemetryService telemetry;
  StagesService stages;
  ArtifactsService artifacts;
  ReportsService reports;
  SweepsService sweeps;
  AdminService admin;
  CasesService cases;
  std::unique_ptr<grpc::Server> server;
  std::jthread ticker;
};

Server::Server(const ServerSettings& settings, jobs::Queue& queue, store::JobStore& store)
    : parts_(std::make_unique<Parts>(settings, queue, store)) {
  const auto credentials = parts_->access.credentials(settings.address);
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  const bool is_unix = settings.address.starts_with("unix:");
  const std::string host = settings.address == "::1" ? "[::1]" : settings.address;
  grpc::ServerBuilder builder;
  int port = 0;
  builder.AddListeningPort(is_unix ? host : host + ":" + std::to_string(settings.port),
                           credentials, &port);
  builder.SetMaxReceiveMessageSize(max_message_bytes);
  set_keepalive(builder);
  grpc::ResourceQuota quota("seaway");
  quota.Resize(std::size_t{512} << 20);
  builder.SetResourceQuota(quota);
  start_call_threads(std::chrono::seconds(10));
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> interceptors;
  interceptors.push_back(make_malformed_answer());
  builder.experimental().SetInterceptorCreators(std::move(interceptors));
  builder.RegisterService(&parts_->jobs);
  builder.RegisterService(&parts_->telemetry);
  builder.RegisterService(&parts_->stages);
  builder.RegisterService(&parts_->artifacts);
  builder.RegisterService(&parts_->reports);
  builder.RegisterService(&parts_->sweeps);
  builder.RegisterService(&parts_->admin);
  builder.RegisterService(&parts_->cases);
  parts_->server = builder.BuildAndStart();
  if (parts_->server == nullptr || (!is_unix && port == 0))
    fail(ErrorCode::unavailable, "cannot listen on {}{}; is another server running there?", host,
         is_unix ? "" : ":" + std::to_string(settings.port));
  address_ = is_unix ? host : host + ":" + std::to_string(port);
  auto* health = parts_->server->GetHealthCheckService();
  for (const char* name : {"seaway.v1.Jobs", "seaway.v1.Telemetry", "seaway.v1.Stages", "seaway.v1.Artifacts", "seaway.v1.Reports",
                           "seaway.v1.Sweeps", "seaway.v1.Admin", "seaway.v1.Cases", "storage"})
    health->SetServingStatus(name, true);
  parts_->ticker = std::jthread([parts = parts_.get(), &store](std::stop_token stop) { parts->tick_loop(std::move(stop), store); });
}

Server::~Server() { shutdown(); }

Census Server::census() const { return parts_->registry.census(); }

void Server::shutdown() {
  if (parts_ == nullptr || parts_->server == nullptr) return;
  parts_->server->GetHealthCheckService()->SetServingStatus(false);
  parts_->registry.close_all(std::chrono::milliseconds(1500));
  // All calls have ended; idle connections would be waited for until the deadline.
  parts_->server->Shutdown(std::chrono::system_clock::now() + std::chrono::milliseconds(300));
  parts_->ticker = {};
  parts_->server.reset();
}

}  // namespace seaway::rpc
