// SPDX-License-Identifier: GPL-3.0-or-later
// seaway-run: one case in the foreground with the real solver, and the worker process of seawayd.
#include <optional>

#include "core/mesh/parallel_runtime.hpp"
#include "core/sim/cascade.hpp"
#include "core/sim/check_case.hpp"
#include "server/jobs/worker.hpp"
#include "server/offline.hpp"

int main(int argc, char** argv) {
  const seaway::jobs::Solver solver{seaway::sim::run_cascade, seaway::sim::check_case};
  std::optional<seaway::jobs::Worker> worker;
  if (seaway::jobs::Worker::is_asked_for(argc, argv)) worker.emplace();
  seaway::server::block_stop_signals();
  const seaway::mesh::ParallelRuntime parallel;
  if (worker) return worker->run(solver);
  return seaway::server::run_offline(argc, argv, solver);
}
