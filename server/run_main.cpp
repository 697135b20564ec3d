// SPDX-License-Identifier: GPL-3.0-or-later
// seaway-run: one case in the foreground with the real solver.
#include "core/mesh/parallel_runtime.hpp"
#include "core/sim/cascade.hpp"
#include "core/sim/check_case.hpp"
#include "server/offline.hpp"

int main(int argc, char** argv) {
  seaway::server::block_stop_signals();
  const seaway::mesh::ParallelRuntime parallel;
  return seaway::server::run_offline(argc, argv, {seaway::sim::run_cascade, seaway::sim::check_case});
}
