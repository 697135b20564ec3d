// SPDX-License-Identifier: GPL-3.0-or-later
// The configuration of seawayd: file and flags -> settings with every default applied.
#pragma once

#include <string>

#include "server/jobs/queue.hpp"
#include "server/jobs/worker_pool.hpp"
#include "server/rpc/server.hpp"
#include "server/store/sqlite_store.hpp"

namespace seaway::server {

/// Flags override paths, address, port and log level only.
struct Flags {
  std::string config_file;  ///< empty: all defaults
  std::string data_dir, listen, log_level;
  int port = -1;
  bool processes = true;  ///< executor if the file names none
};

struct Settings {
  std::string data_dir = "seaway-data";
  std::string log_level = "info";
  std::string log_file;
  int commit_interval_ms = 250;
  int max_stalled_attempts = 10;
  double keep_days = 0;  ///< 0: for ever
  std::int64_t keep_changes = 100'000;
  jobs::PoolSettings pool;
  bool processes = true;  ///< executor process, else thread
  jobs::ProcessSettings worker;  ///< its `run` is for both
  jobs::QueueLimits limits;
  rpc::ServerSettings rpc;
  std::string metrics_address = "127.0.0.1";
  int metrics_port = -1;  ///< -1: no listener, 0: any free one
};

/// trace, debug, info, warn, error
bool is_log_level(const std::string& word);
/// Throws convert::InputError or yaml::InputError with file, line, field, value and advice.
Settings load_settings(const Flags& flags);

}  // namespace seaway::server
