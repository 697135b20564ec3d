// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the offline commands through the external program gnuplot (Debian: gnuplot-nox).
#pragma once

#include <filesystem>
#include <string>

#include "proto/rao_figure.hpp"

namespace seaway::server {

/// Runs gnuplot on a script in `folder`. Throws Error(failed_precondition) if it is missing or complains.
void run_gnuplot(const std::filesystem::path& folder, const std::string& script);

/// Writes script and data of a figure into `folder`, as NAME.gp and NAME_*.dat, and draws it.
void draw_figure(const std::filesystem::path& folder, const std::string& name, const Figure& figure);

}  // namespace seaway::server
