// SPDX-License-Identifier: GPL-3.0-or-later
// The case as users write it -> the case as the solver reads it: the one place where defaults are applied
// and degrees become radians. What the message alone can tell is checked here (missing, negative, not
// finite, contradictory); what needs the geometry is checked by sim::check_case, with the same field paths.
#pragma once

#include <string>

#include "core/sim/case.hpp"
#include "seaway/v1/case.pb.h"

namespace seaway::convert {

/// Throws InputError (reason INVALID_CASE) that lists every problem. The file names in the case are
/// passed on as they stand; `folder` stays empty.
sim::Case to_core(const v1::Case& message);

/// The same case with every default written out: what a run really used.
v1::Case to_proto(const sim::Case& c);

}  // namespace seaway::convert
