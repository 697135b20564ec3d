// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/metrics_listener.hpp"

#include <arpa/inet.h>
#include <httplib.h>
#include <sys/socket.h>

#include <chrono>
#include <thread>

#include "core/base/error.hpp"

namespace seaway::http {
namespace {

bool is_loopback(const std::string& address) {
  in_addr number{};  // a name that begins with 127 may stand for any machine
  const bool loopback = ::inet_pton(AF_INET, address.c_str(), &number) == 1 && (ntohl(number.s_addr) >> 24) == 127;
  return loopback || address == "localhost" || address == "::1";
}

}  // namespace

struct MetricsListener::Parts {
  httplib::Server server;
  std::thread thread;
};

MetricsListener::MetricsListener(const std::string& address, int port, std::function<std::string()> text)
    : parts_(std::make_unique<Parts>()) {
  SEAWAY_CHECK(is_loopback(address), "metrics.address {}: only loopback addresses, as nobody is asked who he is; let a proxy "
               "with TLS pass the numbers on", address);
  httplib::Server& server = parts_->server;
  server.new_task_queue = [] { return new httplib::ThreadPool(2); };  // the server deletes it
  // Without the default SO_REUSEPORT: a second server on the port is a mistake.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_payload_max_length(1024);
  server.set_keep_alive_timeout(2);
  server.set_read_timeout(2);
  server.set_write_timeout(5);
  server.Get("/metrics", [text = std::move(text)](const httplib::Request&, httplib::Response& response) {
    try {
      response.set_content(text(), "text/plain; version=0.0.4; charset=utf-8");
    } catch (const std::exception&) {
      response.status = 503;  // the store refuses; the log says why
    }
  });
  if (port == 0) port = server.bind_to_any_port(address);
  else if (!server.bind_to_port(address, port)) port = -1;
  if (port < 0) fail(ErrorCode::unavailable, "metrics: cannot listen on {}; is another server running there?", address);
  address_ = (address == "::1" ? "[::1]" : address) + ":" + std::to_string(port);
  parts_->thread = std::thread([&server] { server.listen_after_bind(); });
  while (!server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // stop() needs it
}

MetricsListener::~MetricsListener() {
  parts_->server.stop();
  parts_->thread.join();
}

}  // namespace seaway::http
