// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a free decay: the one place where options and units meet core/analysis.
#pragma once

#include "seaway/v1/analysis.pb.h"
#include "server/reports/history.hpp"

namespace seaway::reports {

/// Throws convert::InputError (options), Error(not_found: no such channel; failed_precondition: no decay).
v1::DecayReport make_decay_report(const Run& run, const v1::DecayOptions& options);

}  // namespace seaway::reports
