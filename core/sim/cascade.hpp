// Runs a case from the first stage to the last: the entry point of the core.
#pragma once

#include <string>

#include "core/base/run_context.hpp"
#include "core/sim/case.hpp"
#include "core/sim/run_observer.hpp"

namespace seaway::sim {

struct RunOptions {
  std::string folder;                ///< working folder: checkpoints and artifacts go here; must exist
  bool resume = true;                ///< go on from the newest valid checkpoint in `folder`, if any
  double checkpoint_interval = 60;   ///< wall seconds between checkpoints inside a stage; 0: only at stage ends
  std::string case_digest;           ///< written into checkpoints; one of another case is not resumed
};

enum class StopReason { finished, cancelled, diverged };

struct RunOutcome {
  StopReason reason = StopReason::finished;
  std::string message;               ///< diverged: what happened, where and when, what to do
};

/// Throws Error(invalid_argument) for a case that check_case would refuse, Error(data_loss) never:
/// a broken checkpoint is reported as an event and the one before it is used.
/// On cancellation (context.stop) a checkpoint is written and the outcome says so.
/// On divergence the last good checkpoint is kept.
RunOutcome run_cascade(const Case& c, const RunOptions& options, RunObserver& observer,
                       const RunContext& context);

}  // namespace seaway::sim
