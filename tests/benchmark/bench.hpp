// Speed of the solver on the example cases: damaged section, or damaged ship, moving in waves,
// generation and absorption zones, volume book. Figures are CPU seconds, user and system, of all
// threads.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "core/sim/simulation.hpp"

namespace seaway::bench {

struct Measurement {
  std::string name;
  std::int64_t cells = 0, steps = 0;
  int threads = 1;
  double cell_steps_per_cpu_s = 0;
  double cell_steps_per_wall_s = 0;      ///< 0: not measured
  double bytes_per_cell = 0;             ///< all of the run, see below; 0: not measured
  double pcg_iterations = 0;             ///< mean of the steps; 0: none
  std::map<std::string, double> phases;  ///< share of the CPU time
  double stage_steps = 0;                ///< of the whole stage, as its case asks for them; 0: no stage of a case
  double stage_cpu_h = 0;                ///< CPU hours of so many steps, each as dear as the measured ones
};

/// Whole time steps on a mesh of about `cells` cells, after some that let the hull get going. Bytes: live heap.
Measurement measure_step(std::int64_t cells, int steps, int threads, bool turbulent = false);

/// The same in three dimensions: DTMB 5415, two flooded compartments. Bytes: highest resident memory of the process
/// during start and steps less what it had before the mesh, the hull's table included there.
Measurement measure_ship_step(const std::shared_ptr<const sim::Model<3>>& model, int steps, int threads);

/// One stage of a ship's case as measure_ship_step: on the stage's mesh from the start, hull free from the first step
/// on. What the whole stage costs is extrapolated from the mean of the measured steps; its number of steps is that of
/// the case's estimate (durations; where a rule ends a stage, the periods it usually takes). Mapping is not in it, and neither is
/// what a violent motion later asks for: with water thrown up at 20 degrees of roll, steps took three times as long.
Measurement measure_stage(const sim::Case& c, std::size_t stage, int steps, int threads);

/// The ship's case on about `cells` cells.
std::shared_ptr<const sim::Model<3>> ship_bench_model(std::int64_t cells, bool turbulent = false);

/// Transport of water and momentum alone, `steps` sub-steps.
Measurement measure_advection(std::int64_t cells, int steps, int threads);

/// Multigrid cycles alone, `steps` of them.
Measurement measure_pressure_cycle(std::int64_t cells, int steps, int threads);

}  // namespace seaway::bench
