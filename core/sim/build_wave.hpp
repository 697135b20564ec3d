// SPDX-License-Identifier: GPL-3.0-or-later
// The wave of a case as a function of (x, t).
#pragma once

#include <memory>

#include "core/sim/case.hpp"
#include "core/waves/wave_field.hpp"

namespace seaway::sim {

/// Null in calm water. Throws Error(invalid_argument) for a wave that does not exist: it breaks, or lacks its period.
std::shared_ptr<const waves::WaveField> build_wave(const Case& c);

}  // namespace seaway::sim
