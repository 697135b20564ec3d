// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of an RAO report as a script for gnuplot and its data; who asks for it runs the program.
#pragma once

#include <map>
#include <string>

#include "seaway/v1/analysis.pb.h"

namespace seaway {

struct Figure {
  std::string script;
  std::map<std::string, std::string> data;  ///< file name -> content, beside the script
};

/// Transfer functions over the wave period, one panel a motion (heave and roll first), one curve for each case, heading
/// and height, bars for the scatter over periods. Empty script if no point has numbers. `output`: name of the picture,
/// relative to the script or absolute.
Figure rao_figure(const v1::RaoReport& report, const std::string& output);

}  // namespace seaway
