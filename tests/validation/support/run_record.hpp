// What is kept of one run: histories with the CPU time at each sample, and stages.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/analysis/decay.hpp"
#include "core/sim/case.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {

struct StageRecord {
  std::string name;
  std::int64_t cells = 0, steps = 0;
  double start = 0, end = 0;  ///< [s] of the run
  double cpu_s = 0, mapping_cpu_s = 0;
  bool converged = false;
  double volume_drift = std::nan("");  ///< at its end, of the displacement; not a number in records from before it was kept
};

struct RunRecord {
  std::string digest, version;         ///< of the case it belongs to, and of the code
  std::vector<double> t, roll, heave;  ///< [s], [rad], [m]
  std::vector<double> cpu_s;           ///< of all threads, since the start of the run
  std::vector<StageRecord> stages;
  double total_cpu_s = 0;

  double end_time() const { return t.empty() ? 0 : t.back(); }
  /// CPU seconds until a time of the run.
  double cpu_until(double time) const;
  double mapping_cpu_s() const;
  /// Samples of one signal with from < t <= to.
  Record between(const std::vector<double>& signal, double from, double to) const;
  /// First harmonic of the wave's period [s] in a signal over the last three periods until `end`.
  double amplitude(const std::vector<double>& signal, double end, double period) const;
  /// Free decay of the roll, angles in degrees.
  analysis::Decay roll_decay() const;
  /// When the rule of a stage that began at `start` first held for roll and heave, over periods of `period` [s];
  /// its largest number of periods does not count. Infinite if it never did.
  double converged_at(double start, const sim::EndRule& rule, double period) const;
};

/// Cycle `number`, from 1. Throws Error(failed_precondition) if the run was too short for it.
const analysis::DecayCycle& cycle(const analysis::Decay& decay, std::size_t number);

/// Runs the case in `folder` until it ends or `enough(time, stage)` says so. If a run of the same `digest` was cut
/// there, it goes on from its last checkpoint; CPU times are sums of all attempts up to the checkpoints.
/// Throws Error(diverged) when it does.
RunRecord run_and_record(const sim::Case& c, const std::string& folder, int threads,
                         const std::function<bool(double, int)>& enough, const std::string& digest);

/// To and from a file; load returns false if there is none.
void save(const RunRecord& record, const std::string& path);
bool load(const std::string& path, RunRecord& record);

}  // namespace seaway::validation
