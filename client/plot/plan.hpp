// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of the free surface from above: what a plan_<stage>_<time>.json artifact holds, ready to draw.
#pragma once

#include <string>
#include <vector>

#include "client/plot/section.hpp"

namespace seaway::client {

struct Plan {
  struct Axis {
    double first = 0, step = 0;  ///< middle of the first square, distance to the next [m]
    int count = 0;
  };
  double time_s = 0;
  Axis x, y;
  std::vector<double> elevation_mm;  ///< x fastest; NaN where the hull is
  std::vector<Loop> waterline;       ///< the hull cut at the calm level, (x, y)

  std::array<double, 2> x_bounds() const { return bounds(x); }
  std::array<double, 2> y_bounds() const { return bounds(y); }

 private:
  static std::array<double, 2> bounds(const Axis& a) {
    return {a.first - 0.5 * a.step, a.first + (a.count - 0.5) * a.step};
  }
};

/// Throws ClientError for what is not such an artifact.
Plan parse_plan(const std::string& json);

/// "x y z" lines as gnuplot's image style reads them, a blank line after each row.
std::string to_grid(const Plan& plan);

/// PNG of the free surface from above at a few instants, side by side: heights in colour, the ship's waterline.
/// Throws ClientError as run_gnuplot.
void draw_plans(const std::vector<Plan>& plans, const std::string& title, const std::string& path);

}  // namespace seaway::client
