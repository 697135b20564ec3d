// Speed of the solver on the example case: damaged section moving in waves, generation and
// absorption zones, volume book. Figures are CPU seconds, user and system, of all threads.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace seaway::bench {

struct Measurement {
  std::string name;
  std::int64_t cells = 0, steps = 0;
  int threads = 1;
  double cell_steps_per_cpu_s = 0;
  double bytes_per_cell = 0;             ///< of heap, all of the run; 0: not measured
  double pcg_iterations = 0;             ///< mean of the steps; 0: none
  std::map<std::string, double> phases;  ///< share of the CPU time
};

/// Whole time steps on a mesh of about `cells` cells, after some that let the hull get going.
Measurement measure_step(std::int64_t cells, int steps, int threads, bool turbulent = false);

/// Transport of water and momentum alone, `steps` sub-steps.
Measurement measure_advection(std::int64_t cells, int steps, int threads);

/// Multigrid cycles alone, `steps` of them.
Measurement measure_pressure_cycle(std::int64_t cells, int steps, int threads);

}  // namespace seaway::bench
