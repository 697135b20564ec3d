#include "core/base/run_context.hpp"

#include <spdlog/sinks/null_sink.h>
#include <sys/resource.h>

namespace seaway {

RunContext quiet_context(int threads) {
  auto sink = std::make_shared<spdlog::sinks::null_sink_mt>();
  return {std::make_shared<spdlog::logger>("quiet", sink), {}, threads};
}

double process_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace seaway
