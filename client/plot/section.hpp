// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of the free surface around a section: what a section_<t>.json artifact holds, ready to draw.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace seaway::client {

using Point = std::array<double, 2>;  // y, z [m]
using Loop = std::vector<Point>;

struct Section {
  double time_s = 0;
  std::array<double, 2> y_bounds{}, z_bounds{};
  std::vector<Loop> surface;  ///< line segments
  std::vector<Loop> hull;     ///< closed loops; holes run the other way round
  std::vector<Loop> water;    ///< polygons; may be missing
};

/// Throws ClientError for what is not such an artifact.
Section parse_section(const std::string& json);

/// Each hole tied to the loop around it, so that filling a loop leaves its holes open.
std::vector<Loop> open_holes(const std::vector<Loop>& loops);

/// Points as gnuplot reads them: a blank line after each loop. `close`: the first point again at the end.
std::string to_blocks(const std::vector<Loop>& loops, bool close);

}  // namespace seaway::client
