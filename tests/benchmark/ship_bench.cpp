#include <malloc.h>

#include <chrono>
#include <fstream>
#include <string>

#include "core/sim/check_case.hpp"
#include "tests/benchmark/bench.hpp"
#include "tests/validation/support/ship_run.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::bench {
namespace {

/// An entry of /proc/self/status in bytes; 0 where there is none.
double status_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    double kibibytes = 0;
    if (word == key + ":" && file >> kibibytes) return 1024 * kibibytes;
  }
  return 0;
}

/// Forgets the highest resident memory so far and returns what is resident now.
double restart_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  return status_bytes("VmRSS");
}

}  // namespace

std::shared_ptr<const sim::Model<3>> ship_bench_model(std::int64_t cells, bool turbulent) {
  sim::Case c = validation::ship_in_waves(cells);
  if (turbulent) {
    c.turbulence.model = sim::Turbulence::Model::stabilised;
    c.turbulence.walls = sim::Turbulence::Walls::wall_function;
  }
  return validation::ship_model(c);
}

Measurement measure_ship_step(const std::shared_ptr<const sim::Model<3>>& model, int steps, int threads) {
  const double before = restart_peak();
  const auto run = validation::start<3>(model, threads);
  for (int i = 0; i < 3; ++i) validation::step(*run);
  Measurement m;
  m.name = model->turbulence.model != flow::TurbulenceSpec::Model::none ? "step_3d_rans" : "step_3d";
  m.cells = run->forest().n_cells();
  m.steps = steps;
  m.threads = threads;
  run->clock().restart();
  const auto start = std::chrono::steady_clock::now();
  const double cpu_before = process_cpu_seconds();
  for (int i = 0; i < steps; ++i) m.pcg_iterations += static_cast<double>(validation::step(*run).pressure.iterations) / steps;
  const double work = static_cast<double>(m.cells) * static_cast<double>(steps);
  m.cell_steps_per_cpu_s = work / (process_cpu_seconds() - cpu_before);
  m.cell_steps_per_wall_s = work / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  m.bytes_per_cell = (status_bytes("VmHWM") - before) / static_cast<double>(m.cells);
  const double total = run->clock().total();
  for (const auto& [phase, seconds] : run->clock().times())
    if (seconds > 0) m.phases[phase] = seconds / total;
  return m;
}

Measurement measure_stage(const sim::Case& c, std::size_t stage, int steps, int threads) {
  sim::Case alone = c;
  alone.stages = {c.stages.at(stage)};
  alone.body.release = sim::Body::Release::at_start;
  Measurement m = measure_ship_step(validation::ship_model(alone), steps, threads);
  m.name = "stage_" + c.stages[stage].name;
  m.stage_steps = static_cast<double>(sim::check_case(c).stages.at(stage).steps);
  m.stage_cpu_h = m.stage_steps * static_cast<double>(m.cells) / m.cell_steps_per_cpu_s / 3600;
  return m;
}

}  // namespace seaway::bench
