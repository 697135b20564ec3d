// CPU seconds by phase: every piece of a run says which phase it belongs to.
#pragma once

#include <string>

#include "core/base/run_context.hpp"
#include "core/sim/run_observer.hpp"

namespace seaway::sim {

class PhaseClock {
 public:
  PhaseClock() { restart(); }

  /// All phases back to 0.
  void restart() {
    times_.clear();
    for (const char* phase : {"mesh", "mapping", "advection", "pressure", "hull", "turbulence", "forcing",
                              "checkpoint", "output"})
      times_[phase] = 0;
    mark_ = process_cpu_seconds();
  }
  /// What has passed since the last call belongs to `phase`.
  void charge(const std::string& phase) {
    const double now = process_cpu_seconds();
    times_[phase] += now - mark_;
    mark_ = now;
  }
  const PhaseTimes& times() const { return times_; }
  double total() const {
    double sum = 0;
    for (const auto& [phase, seconds] : times_) sum += seconds;
    return sum;
  }

 private:
  PhaseTimes times_;
  double mark_ = 0;
};

}  // namespace seaway::sim
