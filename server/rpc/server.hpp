// SPDX-License-Identifier: GPL-3.0-or-later
// The gRPC server: services, health, reflection, limits and an orderly end.
#pragma once

#include <memory>
#include <string>

#include "server/jobs/queue.hpp"
#include "server/rpc/access.hpp"
#include "server/rpc/facts.hpp"
#include "server/rpc/registry.hpp"
#include "server/rpc/stream_call.hpp"
#include "server/store/job_store.hpp"

namespace seaway::rpc {

struct ServerSettings {
  std::string address = "127.0.0.1";  ///< loopback, unix:/path; others need access settings
  int port = 0;                       ///< 0: any free one; unused with unix:
  int max_streams = 1000;
  int max_streams_per_caller = 200;  ///< a principal; a connection if there are none
  int work_threads = 16;  ///< they wait for commits: so many submits can share one
  StreamLimits streams;
  AccessSettings access;
  ServerFacts facts;
};

class Server {
 public:
  /// Listens when it returns. Throws Error(unavailable) if the address cannot be used, invalid_argument if
  /// others can reach it without TLS and principals.
  Server(const ServerSettings& settings, jobs::Queue& queue, store::JobStore& store);
  /// Shuts down.
  ~Server();
  /// host:port, or unix:/path.
  const std::string& address() const { return address_; }
  /// The calls that are alive now.
  Census census() const;
  /// Says NOT_SERVING, refuses new calls, finishes the live ones and stops; at most about five seconds.
  void shutdown();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
  std::string address_;
};

}  // namespace seaway::rpc
