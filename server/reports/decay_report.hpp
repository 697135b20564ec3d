// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a free decay: the one place where options and units meet core/analysis.
#pragma once

#include <string>
#include <vector>

#include "seaway/v1/analysis.pb.h"
#include "server/reports/history.hpp"

namespace seaway::reports {

/// Throws convert::InputError naming the option that is wrong.
void check_options(const v1::DecayOptions& options);
/// The channel that is asked for, roll unless said otherwise, among those that `source` has. Throws convert::InputError if
/// it is none of them, failed_precondition if the run has none yet.
std::string find_channel(const std::string& source, const std::vector<std::string>& names, const v1::DecayOptions& options);
/// Throws what the two throw, and failed_precondition if there is no decay to be seen.
v1::DecayReport make_decay_report(const Run& run, const v1::DecayOptions& options);

}  // namespace seaway::reports
