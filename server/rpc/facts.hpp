// SPDX-License-Identifier: GPL-3.0-or-later
// What the services tell of the program around them, and change of it.
#pragma once

#include <functional>
#include <string>

namespace seaway::rpc {

/// What the daemon says of itself.
struct ServerFacts {
  std::string executor = "thread";
  int workers = 1;
  std::function<std::string()> log_level = [] { return std::string("info"); };
  /// False for a level that does not exist.
  std::function<bool(const std::string&)> set_log_level = [](const std::string&) { return false; };
};

}  // namespace seaway::rpc
