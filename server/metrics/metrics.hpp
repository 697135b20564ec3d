// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers that operators watch, in the text form of Prometheus. Names and labels are fixed; there is never a
// job's name among them, so their number is bounded. Safe from any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace seaway::metrics {

/// What is looked up when somebody reads.
struct Levels {
  std::map<std::string, double> jobs;     ///< by state
  std::map<std::string, double> streams;  ///< by kind
  double stream_lag = 0;                  ///< of the slowest reader [samples]
  double wal_bytes = 0, disk_free_bytes = 0;
};

class Metrics {
 public:
  Metrics();
  ~Metrics();
  Metrics(const Metrics&) = delete;
  Metrics& operator=(const Metrics&) = delete;

  /// A job has begun its first attempt, so long after it was submitted [s].
  void job_waited(double seconds);
  /// A stage is over; CPU seconds by phase.
  void stage_finished(int stage, const std::map<std::string, double>& phases);
  /// Time steps of a run on so many cells.
  void stepped(std::int64_t steps, std::int64_t cells);
  /// A transaction took so long, with its sync [s].
  void committed(double seconds);
  /// A checkpoint took so long to write [s].
  void checkpoint_written(double seconds);
  /// Attempts that a crash of server or worker ended and that are made again.
  void recovered(int jobs);
  /// Everything, in the text format 0.0.4. `levels`: the state now.
  std::string text(const Levels& levels);

 private:
  struct Parts;
  const std::unique_ptr<Parts> parts_;
};

}  // namespace seaway::metrics
