// The only way in which a run talks to the world. The server's observer writes to the store,
// seaway-run's writes files, a test's keeps vectors. Called from the run's own thread, in order.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace seaway::sim {

/// One column of the history. `unit` is SI with radians: "m", "rad", "N", "N m", "m3", "s", "1".
/// In 2-D forces, masses and volumes are per metre ("N/m", "m2").
struct Channel {
  std::string name;  ///< for example heave, roll, force_z, moment_x, gauge.bow, compartment.port.volume
  std::string unit;
};

struct Sample {
  std::int64_t sequence = 0;  ///< 1, 2, 3 ... over all stages, without gaps
  int stage = 0;              ///< from 0
  std::int64_t step = 0;      ///< time steps since the start of the run
  double time = 0;            ///< [s] since the start of the run
  std::vector<double> values; ///< one per channel
};

/// CPU seconds (all threads) by phase: mesh, mapping, advection, pressure, hull, turbulence, forcing,
/// checkpoint, output. Always these keys; unused ones are 0.
using PhaseTimes = std::map<std::string, double>;

struct MappingReport {
  std::string method;
  double cpu_s = 0;
  double vof_min = 0, vof_max = 0;
  double water_before = 0, water_after = 0;            ///< [m3] or [m2]
  double divergence_before = 0, divergence_after = 0;  ///< max dt |div w| on the new mesh
  std::int64_t kept_cells = 0, new_cells = 0;
  std::int64_t fall_backs = 0;                         ///< stencils that dropped to a lower degree
};

struct StageInfo {
  int stage = 0;
  std::string name;
  std::int64_t cells = 0;
  int levels = 0;
  double finest_cell = 0;  ///< [m]
  double time = 0;         ///< start of the stage [s]
  double dt = 0;
};

struct MotionAmplitude {
  std::string channel;    ///< sway, heave, roll, ...
  double amplitude = 0;   ///< first harmonic over the last whole periods (waves) or half the last swing
  double mean = 0;
  double period = 0;
  double change = 0;      ///< relative cycle-to-cycle change that the end rule saw
};

/// y+ of the points at which the law of the wall is applied, at the wetted walls of the hull or a compartment; the
/// mean is over area and the stage's time.
struct WallReport {
  std::string name;  ///< hull, or the compartment's
  double y_plus_min = 0, y_plus_mean = 0, y_plus_max = 0;
};

struct StageResult {
  StageInfo info;
  double end_time = 0;
  std::int64_t steps = 0;
  bool converged = false;          ///< the end rule was met (time rules: always)
  double wall_s = 0, cpu_s = 0;
  PhaseTimes phases;
  double mean_pressure_iterations = 0;
  int max_pressure_iterations = 0;
  double volume_drift = 0;         ///< (visible water - initial - exchanged by zones) / displacement (no hull: / initial)
  bool has_mapping = false;
  MappingReport mapping;
  std::vector<MotionAmplitude> motions;
  std::vector<WallReport> walls;   ///< empty where the hull slips
};

struct Progress {
  int stage = 0, stage_count = 0;
  double time = 0;                 ///< [s]
  double fraction = 0;             ///< of the whole run, 0..1
  double remaining_s = -1;         ///< wall seconds, < 0: not known yet
  bool held = false;               ///< the hull is still held
};

class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void on_channels(const std::vector<Channel>&) {}
  virtual void on_stage_started(const StageInfo&) {}
  /// A sample may come again after a resume: same sequence, same bytes.
  virtual void on_sample(const Sample&) {}
  virtual void on_progress(const Progress&) {}
  virtual void on_stage_finished(const StageResult&) {}
  /// A checkpoint file is complete on disk (written aside, synced, renamed). Samples up to `sequence`
  /// precede it: an observer must have made them durable before it records the checkpoint.
  /// `write_s`: wall time that it took to write [s].
  virtual void on_checkpoint(const std::string& /*path*/, std::int64_t /*sequence*/, double /*write_s*/) {}
  /// A result file was written: snapshot of the free surface and the hull, report.
  virtual void on_artifact(const std::string& /*name*/, const std::string& /*path*/,
                           const std::string& /*media_type*/) {}
  /// Something happened that a person should know: released, mapped, dt lowered, limits reached.
  virtual void on_event(const std::string& /*kind*/, const std::string& /*text*/) {}
};

}  // namespace seaway::sim
