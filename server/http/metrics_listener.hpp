// SPDX-License-Identifier: GPL-3.0-or-later
// http://address:port/metrics on a loopback address. Two threads; anything but GET /metrics is refused.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace seaway::http {

class MetricsListener {
 public:
  /// Listens when it returns. `text`: asked at each reading, from the listener's threads; what it throws becomes status 503.
  /// port 0: any free one. Throws Error: invalid_argument for an address that others can reach, unavailable if it
  /// cannot be used.
  MetricsListener(const std::string& address, int port, std::function<std::string()> text);
  /// Finishes the answers that are under way.
  ~MetricsListener();
  /// host:port
  const std::string& address() const { return address_; }

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
  std::string address_;
};

}  // namespace seaway::http
