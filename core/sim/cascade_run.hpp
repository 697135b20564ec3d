// One run through the stages of a case: what cascade.hpp promises, for one number of dimensions. Internal.
#pragma once

#include <chrono>
#include <optional>

#include "core/sim/cascade.hpp"
#include "core/sim/cycle_monitor.hpp"
#include "core/sim/recorder.hpp"
#include "core/sim/simulation.hpp"
#include "core/transfer/map_flow.hpp"

namespace seaway::sim {

template <int Dim>
class CascadeRun {
 public:
  CascadeRun(const Case& c, const RunOptions& options, RunObserver& observer, const RunContext& context);
  RunOutcome run();

 private:
  using Clock = std::chrono::steady_clock;

  /// What belongs to the stage that is running; saved in checkpoints.
  struct StageState {
    int index = 0;
    double start_time = 0;
    std::int64_t start_step = 0;
    double wall_s = 0;             ///< of earlier attempts
    PhaseTimes phases;             ///< of earlier attempts
    std::int64_t iterations = 0;
    int max_iterations = 0;
    bool has_mapping = false;
    bool finished = false;
    MappingReport mapping;
  };

  void start();
  bool resume();
  void restore(const std::string& path);
  void write_checkpoint();
  void prune_checkpoints() const;
  void discard_checkpoints() const;  ///< a run from the start: none of the old ones may outlive it
  std::vector<std::string> checkpoints() const;  ///< newest first

  void make_simulation(std::unique_ptr<Forest<Dim>> forest, int stage);
  void begin_stage(int index);
  void map_to_stage(int index);
  std::optional<RunOutcome> run_stage();
  void take_step();
  bool stage_is_over() const;
  void watch_release();
  void start_motion_monitor();
  StageResult result() const;
  void finish_stage();
  void snapshot();
  void report_progress(bool force);
  double expected_duration(int stage) const;
  StageInfo info() const;

  Case case_;
  RunOptions options_;
  RunObserver& observer_;
  RunContext context_;
  std::shared_ptr<const Model<Dim>> model_;
  Recorder<Dim> recorder_;
  std::unique_ptr<Simulation<Dim>> simulation_;
  std::vector<std::int64_t> stage_cells_;
  StageState stage_;
  CycleMonitor flow_monitor_, motion_monitor_;
  double initial_water_ = 0;
  std::int64_t sequence_ = 0;
  double next_sample_ = 0, next_snapshot_ = 0;
  StepReport last_step_;
  bool failed_ = false;
  Clock::time_point stage_begun_, last_checkpoint_, last_progress_, run_begun_;
  double work_done_ = 0;  ///< cell-steps of this attempt
};

extern template class CascadeRun<2>;
extern template class CascadeRun<3>;

}  // namespace seaway::sim
