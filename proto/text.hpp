// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of text that tables and pictures share.
#pragma once

#include <string>

namespace seaway {

/// A number in a printf format, which may hold other text: at most 63 characters.
std::string formatted(double value, const char* format);

/// A text inside a single-quoted string of a gnuplot script, without markup.
std::string gnuplot_text(const std::string& text);

}  // namespace seaway
