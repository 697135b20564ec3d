// SPDX-License-Identifier: GPL-3.0-or-later
// The whole service in this process, with the stand-in solver.
#pragma once

#include <memory>

#include "client/job_client.hpp"
#include "server/jobs/worker_pool.hpp"
#include "server/rpc/server.hpp"
#include "tests/support/fake_cascade.hpp"
#include "tests/support/service_jobs.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::testing {

/// The status that a call of a client ended with.
template <class F>
grpc::StatusCode status_of(F call) {
  try {
    call();
  } catch (const client::RpcError& error) {
    return error.status();
  }
  return grpc::StatusCode::OK;
}

class TestService {
 public:
  explicit TestService(FakeOptions fake = {}, rpc::ServerSettings settings = {}) : fake_(std::move(fake)), settings_(std::move(settings)) {
    start();
  }
  void start() {
    store = open_store(folder.path());
    store->recover(10);
    executor = jobs::make_thread_executor({}, fake_solver(fake_), workspace, *store, quiet_context().log);
    pool = std::make_unique<jobs::WorkerPool>(jobs::PoolSettings{}, *executor, workspace, *store, quiet_context().log);
    queue = std::make_unique<jobs::Queue>(jobs::QueueLimits{}, fake_solver(fake_), workspace, *store, [this] { pool->wake(); },
                                          [this](const std::string& uid) { pool->request_stop(uid); },
                                          [this](const std::string& uid) { pool->request_kill(uid); });
    server = std::make_unique<rpc::Server>(settings_, *queue, *store);
    pool->start();
  }
  void stop() {
    server.reset();
    pool.reset();
    executor.reset();
    queue.reset();
    store.reset();
  }
  ~TestService() { stop(); }

  TempFolder folder;
  jobs::Workspace workspace{folder.path()};
  std::unique_ptr<store::JobStore> store;
  std::unique_ptr<jobs::Executor> executor;
  std::unique_ptr<jobs::WorkerPool> pool;
  std::unique_ptr<jobs::Queue> queue;
  std::unique_ptr<rpc::Server> server;

 private:
  FakeOptions fake_;
  rpc::ServerSettings settings_;
};

/// What a watcher has received, with the promise checked: consecutive samples, each once.
struct Received {
  std::vector<double> heave;
  std::int64_t last = 0;
  v1::ProgressMark mark;
  int headers = 0;
  bool gap = false;
  void take(const v1::WatchSamplesResponse& m) {
    headers += m.has_header() ? 1 : 0;
    if (m.has_mark()) mark = m.mark();
    if (!m.has_chunk()) return;
    gap = gap || m.chunk().first_sequence() != last + 1;
    last = m.chunk().first_sequence() + m.chunk().times_s_size() - 1;
    for (const double v : m.chunk().columns(0).values()) heave.push_back(v);
  }
};

}  // namespace seaway::testing
