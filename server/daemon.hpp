// SPDX-License-Identifier: GPL-3.0-or-later
// seawayd without its solver: reads the configuration, builds the objects, waits for a signal, winds up.
#pragma once

#include "server/jobs/solver.hpp"

namespace seaway::server {

/// Blocks SIGTERM, SIGINT and SIGHUP in the calling thread and in all that it starts later. Call it first in
/// main, before anything makes threads or installs handlers: the daemon takes signals with sigwait.
void block_signals();

/// The program. Exit codes: 0 stopped on request, 1 failed, 2 wrong configuration.
/// `processes`: the executor that is used if the configuration names none.
int run_daemon(int argc, char** argv, const jobs::Solver& solver, bool processes = true);

}  // namespace seaway::server
