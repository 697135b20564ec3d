// What a long computation may ask of its surroundings: where to log, whether to stop.
// Passed down by reference; never global. The core configures no log sink.
#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <stop_token>

namespace seaway {

struct RunContext {
  std::shared_ptr<spdlog::logger> log;  ///< never null
  std::stop_token stop;                 ///< asked once a time step
  int threads = 1;                      ///< threads for block loops; results do not depend on it
};

/// A context that logs nowhere and never stops: for tests and for library use.
RunContext quiet_context(int threads = 1);

/// CPU seconds (user + system, all threads) that this process has used so far.
double process_cpu_seconds();

}  // namespace seaway
