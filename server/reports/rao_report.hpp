// SPDX-License-Identifier: GPL-3.0-or-later
// Response amplitudes in regular waves: the one place where cases, histories and core/analysis meet.
#pragma once

#include <vector>

#include "seaway/v1/analysis.pb.h"
#include "server/reports/history.hpp"

namespace seaway::reports {

/// Throws convert::InputError for wrong options.
void check_options(const v1::RaoOptions& options);

/// One run. What keeps it from having numbers (no regular wave, too short, not finite) is in the message. Only the last
/// stage counts. Does not throw for what the run is.
v1::RaoPoint make_rao_point(const Run& run, const v1::RaoOptions& options);

/// Orders the points by case, heading, height and period. Where each run has a title of its own the cases are one.
v1::RaoReport make_rao_report(const std::string& title, std::vector<v1::RaoPoint> points);

}  // namespace seaway::reports
