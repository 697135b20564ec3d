// SPDX-License-Identifier: GPL-3.0-or-later
// Decay and RAO reports as tables for a person: the same ones from `seaway` and seaway-run.
#pragma once

#include <string>

#include "seaway/v1/analysis.pb.h"

namespace seaway::report_text {

/// Turning points, cycles, damped cosine and extinction coefficients, with their 95 % intervals.
std::string decay_table(const v1::DecayReport& report);

/// One line a run: period, slope, and for each motion its transfer function with scatter and phase.
std::string rao_table(const v1::RaoReport& report);

}  // namespace seaway::report_text
