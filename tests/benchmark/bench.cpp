#include "tests/benchmark/bench.hpp"

#include <malloc.h>

#include <algorithm>
#include <cmath>

#include "core/linear/multigrid.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::bench {
namespace {

sim::Case bench_case(std::int64_t cells) {
  sim::Case c = validation::example_case();
  c.turbulence = {};
  c.body.release = sim::Body::Release::at_start;
  c.body.angles = {5 * degree, 0, 0};
  c.stages.resize(1);
  c.stages.front().mesh = validation::example_mesh(cells);
  return c;
}

double heap_bytes() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

double rate(const Measurement& m, double cpu_s) {
  return static_cast<double>(m.cells) * static_cast<double>(m.steps) / cpu_s;
}

}  // namespace

Measurement measure_step(std::int64_t cells, int steps, int threads, bool turbulent) {
  sim::Case c = bench_case(cells);
  if (turbulent) {
    c.turbulence.model = sim::Turbulence::Model::stabilised;
    c.turbulence.walls = sim::Turbulence::Walls::wall_function;
  }
  const double heap_before = heap_bytes();
  const auto run = validation::start(c, threads);
  for (int i = 0; i < 10; ++i) validation::step(*run);
  Measurement m;
  m.name = turbulent ? "step_2d_rans" : "step_2d";
  m.cells = run->forest().n_cells();
  m.steps = steps;
  m.threads = threads;
  run->clock().restart();
  const double cpu_before = process_cpu_seconds();
  for (int i = 0; i < steps; ++i) {
    const double n = validation::step(*run).pressure.iterations;
    m.pcg_iterations += n / steps;
  }
  m.cell_steps_per_cpu_s = rate(m, process_cpu_seconds() - cpu_before);
  m.bytes_per_cell = (heap_bytes() - heap_before) / static_cast<double>(m.cells);
  const double total = run->clock().total();
  for (const auto& [phase, seconds] : run->clock().times())
    if (seconds > 0) m.phases[phase] = seconds / total;
  return m;
}

Measurement measure_advection(std::int64_t cells, int steps, int threads) {
  const auto run = validation::start(bench_case(cells), threads);
  flow::Advection<2> advection(run->forest(), run->model().fluids, run->model().boundaries);
  const double courant = advection.courant_number(run->state().w, run->dt());
  const double dt = run->dt() * std::min(1.0, 0.4 / courant);
  Measurement m;
  m.name = "advection_2d";
  m.cells = run->forest().n_cells();
  m.steps = steps;
  m.threads = threads;
  const double cpu_before = process_cpu_seconds();
  for (int i = 0; i < steps; ++i) advection.advance(run->state(), dt, i);
  m.cell_steps_per_cpu_s = rate(m, process_cpu_seconds() - cpu_before);
  return m;
}

Measurement measure_pressure_cycle(std::int64_t cells, int steps, int threads) {
  const auto run = validation::start(bench_case(cells), threads);
  linear::PoissonOperator<2> op(run->forest());
  for (int axis = 0; axis < 2; ++axis) {
    auto& c = op.coefficients().data(axis);
    std::fill(c.begin(), c.end(), 1.0F);
  }
  op.finish();
  linear::Multigrid<2> multigrid(op);
  multigrid.update();
  const flow::CellField<double, 2> right(run->forest(), 1.0);
  Measurement m;
  m.name = "pressure_cycle_2d";
  m.cells = run->forest().n_cells();
  m.steps = steps;
  m.threads = threads;
  const double cpu_before = process_cpu_seconds();
  for (int i = 0; i < steps; ++i) multigrid.apply(right);
  m.cell_steps_per_cpu_s = rate(m, process_cpu_seconds() - cpu_before);
  return m;
}

}  // namespace seaway::bench
