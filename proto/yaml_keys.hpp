// SPDX-License-Identifier: GPL-3.0-or-later
// Advice about keys and values: the nearest known key, and the unit that a key's name asks for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seaway::yaml {

/// Name and unit of a key: height_m -> {height, m}; the unit is empty where there is none.
struct KeyParts {
  std::string_view stem;
  std::string_view unit;
};
KeyParts split_unit(std::string_view key);

/// A unit as a person says it: m -> metres.
std::string unit_words(std::string_view unit);

/// What to do about an unknown key: another unit, a slip of the pen, or the list of keys.
std::string advise_key(std::string_view key, const std::vector<std::string>& known);

/// The known word that differs from `word` in at most a third of its letters (or two), or empty.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

}  // namespace seaway::yaml
