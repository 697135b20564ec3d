// SPDX-License-Identifier: GPL-3.0-or-later
// The wave of a case as a function of (x, t).
#pragma once

#include <memory>
#include <vector>

#include "core/sim/case.hpp"
#include "core/waves/linear_sea.hpp"
#include "core/waves/wave_field.hpp"

namespace seaway::sim {

/// Null in calm water. Throws Error(invalid_argument) for a wave that does not exist (it breaks, or lacks its period),
/// Error(not_found) if its file cannot be opened.
std::shared_ptr<const waves::WaveField> build_wave(const Case& c);

/// Of a sea that is a sum of linear waves: irregular, focused, time_series. Throws likewise.
waves::LinearSeaSpec sea_of(const Case& c);

/// The spectrum that an irregular or focused sea has asked for. Hs of a focused group is of no account.
waves::SpectrumSpec spectrum_of(const Case& c);

/// A table of time [s] and elevation [m] at equal steps.
struct ElevationTable {
  double step = 0;
  std::vector<double> elevation;
};
/// Throws Error(not_found; invalid_argument with file and line).
ElevationTable read_elevation_table(const std::string& file);

}  // namespace seaway::sim
