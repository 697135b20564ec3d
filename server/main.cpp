// SPDX-License-Identifier: GPL-3.0-or-later
// seawayd: the service with the real solver.
#include "core/mesh/parallel_runtime.hpp"
#include "core/sim/cascade.hpp"
#include "core/sim/check_case.hpp"
#include "server/daemon.hpp"

int main(int argc, char** argv) {
  seaway::server::block_signals();
  const seaway::mesh::ParallelRuntime parallel;
  return seaway::server::run_daemon(argc, argv, {seaway::sim::run_cascade, seaway::sim::check_case});
}
