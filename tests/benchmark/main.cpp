// seaway-bench: cell-steps per CPU second of the solver, with the share of each phase.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/mesh/parallel_runtime.hpp"
#include "tests/benchmark/bench.hpp"

namespace {

using seaway::bench::Measurement;

void print_json(const Measurement& m) {
  nlohmann::ordered_json line;
  line["bench"] = m.name;
  line["cells"] = m.cells;
  line["steps"] = m.steps;
  line["threads"] = m.threads;
  line["cell_steps_per_cpu_s"] = m.cell_steps_per_cpu_s;
  line["bytes_per_cell"] = m.bytes_per_cell > 0 ? nlohmann::json(m.bytes_per_cell) : nullptr;
  line["pcg_iterations"] = m.pcg_iterations > 0 ? nlohmann::json(m.pcg_iterations) : nullptr;
  line["phases"] = m.phases;
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

void print_row(const Measurement& m) {
  std::printf("%-18s %8lld cells %5lld steps %2d threads %8.3f Mcell-steps/CPU s", m.name.c_str(),
              static_cast<long long>(m.cells), static_cast<long long>(m.steps), m.threads,
              1e-6 * m.cell_steps_per_cpu_s);
  if (m.bytes_per_cell > 0) std::printf("  %5.0f B/cell", m.bytes_per_cell);
  if (m.pcg_iterations > 0) std::printf("  %4.1f iterations", m.pcg_iterations);
  std::printf("\n");
  for (const auto& [phase, share] : m.phases)
    std::printf("    %-12s %5.1f %%\n", phase.c_str(), 100 * share);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Speed of the solver: the example section moving in waves, zones and volume book on."};
  bool json = false, kernels = false, turbulence = false;
  std::vector<std::int64_t> cells{50000, 300000};
  int threads = 1, steps = 0;
  app.add_flag("--json", json, "one JSON object a line");
  app.add_flag("--kernels", kernels, "advection and multigrid cycle by themselves as well");
  app.add_flag("--turbulence", turbulence, "the step with k-epsilon and wall functions as well");
  app.add_option("--cells", cells, "wanted numbers of cells; met to a few per cent")
      ->check(CLI::Range(10000, 20000000));
  app.add_option("--threads", threads)->check(CLI::Range(1, 256));
  app.add_option("--steps", steps, "steps measured; 0: about 6 million cell-steps")
      ->check(CLI::Range(0, 1000000));
  CLI11_PARSE(app, argc, argv);
  try {
    const seaway::mesh::ParallelRuntime runtime;
    for (const std::int64_t n : cells) {
      const int count =
          steps > 0 ? steps : static_cast<int>(std::max<std::int64_t>(20, 6000000 / n));
      const auto print = json ? print_json : print_row;
      print(seaway::bench::measure_step(n, count, threads));
      if (turbulence) print(seaway::bench::measure_step(n, count, threads, true));
      if (!kernels) continue;
      print(seaway::bench::measure_advection(n, count, threads));
      print(seaway::bench::measure_pressure_cycle(n, 4 * count, threads));
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "seaway-bench: %s\n", e.what());
    return 1;
  }
}
