// seaway-bench: cell-steps per CPU second of the solver, with the share of each phase.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "core/mesh/parallel_runtime.hpp"
#include "tests/benchmark/bench.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace {

using seaway::bench::Measurement;

void print_json(const Measurement& m) {
  nlohmann::ordered_json line;
  line["bench"] = m.name;
  line["cells"] = m.cells;
  line["steps"] = m.steps;
  line["threads"] = m.threads;
  line["cell_steps_per_cpu_s"] = m.cell_steps_per_cpu_s;
  if (m.cell_steps_per_wall_s > 0) line["cell_steps_per_wall_s"] = m.cell_steps_per_wall_s;
  line["bytes_per_cell"] = m.bytes_per_cell > 0 ? nlohmann::json(m.bytes_per_cell) : nullptr;
  line["pcg_iterations"] = m.pcg_iterations > 0 ? nlohmann::json(m.pcg_iterations) : nullptr;
  line["phases"] = m.phases;
  if (m.stage_steps > 0) {
    line["stage_steps"] = m.stage_steps;
    line["stage_cpu_h"] = m.stage_cpu_h;
  }
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

void print_row(const Measurement& m) {
  std::printf("%-18s %8lld cells %5lld steps %2d threads %8.3f Mcell-steps/CPU s", m.name.c_str(),
              static_cast<long long>(m.cells), static_cast<long long>(m.steps), m.threads,
              1e-6 * m.cell_steps_per_cpu_s);
  if (m.cell_steps_per_wall_s > 0) std::printf(", %.3f /wall s", 1e-6 * m.cell_steps_per_wall_s);
  if (m.bytes_per_cell > 0) std::printf("  %5.0f B/cell", m.bytes_per_cell);
  if (m.pcg_iterations > 0) std::printf("  %4.1f iterations", m.pcg_iterations);
  if (m.stage_steps > 0) std::printf("  %.0f steps: %.2f CPU h", m.stage_steps, m.stage_cpu_h);
  std::printf("\n");
  for (const auto& [phase, share] : m.phases)
    std::printf("    %-12s %5.1f %%\n", phase.c_str(), 100 * share);
  std::fflush(stdout);
}

struct Options {
  bool json = false, kernels = false, turbulence = false, ship = false;
  std::vector<std::int64_t> cells;
  std::vector<int> threads{1};
  int steps = 0;
  std::string stages;
};

void measure_section(const Options& o, std::int64_t cells, int steps) {
  const auto print = o.json ? print_json : print_row;
  for (const int threads : o.threads) {
    print(seaway::bench::measure_step(cells, steps, threads));
    if (o.turbulence) print(seaway::bench::measure_step(cells, steps, threads, true));
    if (!o.kernels) continue;
    print(seaway::bench::measure_advection(cells, steps, threads));
    print(seaway::bench::measure_pressure_cycle(cells, 4 * steps, threads));
  }
}

void measure_ship(const Options& o, std::int64_t cells, int steps) {
  for (const bool turbulent : {false, true}) {
    if (turbulent && !o.turbulence) continue;
    const auto model = seaway::bench::ship_bench_model(cells, turbulent);
    for (const int threads : o.threads) {
      const auto print = o.json ? print_json : print_row;
      print(seaway::bench::measure_ship_step(model, steps, threads));
    }
  }
}

void measure_stages(const Options& o) {
  const seaway::sim::Case c = seaway::validation::example_case(o.stages);
  if (c.dim != 3) throw std::invalid_argument("--stages needs a case in three dimensions; " + o.stages + " has two");
  for (std::size_t stage = 0; stage < c.stages.size(); ++stage)
    for (const int threads : o.threads)
      (o.json ? print_json : print_row)(seaway::bench::measure_stage(c, stage, o.steps > 0 ? o.steps : 50, threads));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Speed of the solver: the example section (or ship) moving in waves, zones and volume book on."};
  Options o;
  app.add_flag("--json", o.json, "one JSON object a line");
  app.add_flag("--ship", o.ship, "three dimensions: the damaged DTMB 5415 instead of its section");
  app.add_flag("--kernels", o.kernels, "section: advection and multigrid cycle by themselves as well");
  app.add_flag("--turbulence", o.turbulence, "the step with k-epsilon and wall functions as well");
  app.add_option("--stages", o.stages,
                 "instead: each stage of this case of client/examples (three dimensions), 50 steps, and the CPU hours of "
                 "the whole stage extrapolated from them");
  app.add_option("--cells", o.cells, "wanted numbers of cells; met to a few per cent [50000 300000; ship: 1000000]")
      ->check(CLI::Range(10000, 20000000));
  app.add_option("--threads", o.threads, "numbers of threads, each measured [1]")->check(CLI::Range(1, 256));
  app.add_option("--steps", o.steps, "steps measured; 0: about 6 million cell-steps (ship: 20 million)")
      ->check(CLI::Range(0, 1000000));
  CLI11_PARSE(app, argc, argv);
  if (o.cells.empty()) o.cells = o.ship ? std::vector<std::int64_t>{1000000} : std::vector<std::int64_t>{50000, 300000};
  try {
    const seaway::mesh::ParallelRuntime runtime;
    if (!o.stages.empty()) {
      measure_stages(o);
      return 0;
    }
    for (const std::int64_t n : o.cells) {
      const std::int64_t wanted = std::max<std::int64_t>(20, (o.ship ? 20000000 : 6000000) / n);
      (o.ship ? measure_ship : measure_section)(o, n, o.steps > 0 ? o.steps : static_cast<int>(wanted));
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "seaway-bench: %s\n", e.what());
    return 1;
  }
}
