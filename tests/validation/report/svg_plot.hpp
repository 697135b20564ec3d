// Small pictures of curves for the report: plain SVG without scripts, fonts or links.
#pragma once

#include <string>

#include "tests/validation/report/case_record.hpp"

namespace seaway::validation {

/// & < > " ' as entities, for text and attributes of HTML and SVG.
std::string escaped(const std::string& text);

/// References as circles, all else as lines; a curve of up to 12 points has marks as well. Long curves are thinned to what
/// can be seen, their peaks kept. Values that are not finite (or not positive, with logarithmic axes) are left out.
/// Returns an empty string if nothing is left.
std::string svg_of(const Plot& plot);

/// Round numbers for an axis from low to high, about five.
std::vector<double> ticks_between(double low, double high);

}  // namespace seaway::validation
