// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures through the external program gnuplot, found on PATH (Debian: gnuplot-nox).
#pragma once

#include <map>
#include <string>

namespace seaway::client {

/// Runs `script` in a folder of its own that holds `data` (file name -> content), and is removed after. Throws
/// ClientError if gnuplot is missing or complains.
void run_gnuplot(const std::string& script, const std::map<std::string, std::string>& data);

}  // namespace seaway::client
