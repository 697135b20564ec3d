// SPDX-License-Identifier: GPL-3.0-or-later
// seaway-run without its solver: one case in the foreground, no service and no database.
#pragma once

#include "server/jobs/solver.hpp"

namespace seaway::server {

/// As block_signals() of the daemon, for SIGTERM and SIGINT: call it first in main.
void block_stop_signals();

/// The program. Exit codes: 0 finished (or the case is fine), 1 failed or diverged, 2 wrong usage or case,
/// 3 stopped by a signal after a checkpoint; the same command goes on from there.
int run_offline(int argc, char** argv, const jobs::Solver& solver);

}  // namespace seaway::server
