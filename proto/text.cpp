// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/text.hpp"

#include <array>
#include <cstdio>

namespace seaway {

std::string formatted(double value, const char* format) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

std::string gnuplot_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') out += '\'';  // doubled inside single quotes
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

}  // namespace seaway
