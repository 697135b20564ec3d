// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/yaml_keys.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace seaway::yaml {
namespace {

// Units of the schema and those that people write instead; longer endings first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 30> units{{
    {"kg_per_m3", "kilograms per cubic metre"},
    {"kg_per_m", "kilograms per metre of length"},
    {"m2_per_s", "square metres per second"},
    {"m_per_s2", "metres per second squared"},
    {"m_per_s", "metres per second"},
    {"per_s", "per second"},
    {"degrees", "degrees"},
    {"radians", "radians"},
    {"metres", "metres"},
    {"meters", "metres"},
    {"seconds", "seconds"},
    {"knots", "knots"},
    {"deg", "degrees"},
    {"rad", "radians"},
    {"feet", "feet"},
    {"min", "minutes"},
    {"mm", "millimetres"},
    {"cm", "centimetres"},
    {"km", "kilometres"},
    {"ft", "feet"},
    {"in", "inches"},
    {"ms", "milliseconds"},
    {"kg", "kilograms"},
    {"hz", "hertz"},
    {"m3", "cubic metres"},
    {"m2", "square metres"},
    {"m", "metres"},
    {"s", "seconds"},
    {"t", "tonnes"},
    {"g", "grams"},
}};

std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

KeyParts split_unit(std::string_view key) {
  for (const auto& [unit, words] : units)
    if (key.size() > unit.size() + 1 && key.ends_with(unit) && key[key.size() - unit.size() - 1] == '_')
      return {key.substr(0, key.size() - unit.size() - 1), unit};
  return {key, {}};
}

std::string unit_words(std::string_view unit) {
  for (const auto& [name, words] : units)
    if (name == unit) return std::string(words);
  return std::string(unit);
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = std::string::npos;
  for (const std::string& candidate : known) {
    const std::size_t d = distance(word, candidate);
    const std::size_t largest = candidate.size() < 4 ? 1 : std::max<std::size_t>(2, candidate.size() / 3);
    if (d < best_distance && d <= largest) {
      best = candidate;
      best_distance = d;
    }
  }
  return best;
}

std::string advise_key(std::string_view key, const std::vector<std::string>& known) {
  const KeyParts parts = split_unit(key);
  for (const std::string& candidate : known) {
    const KeyParts other = split_unit(candidate);
    if (other.unit.empty() || other.stem != parts.stem) continue;
    return "write " + candidate + ", in " + unit_words(other.unit);
  }
  std::string all;
  for (const std::string& candidate : known) all += (all.empty() ? "" : ", ") + candidate;
  const std::string near = nearest(key, known);
  const std::string list = all.empty() ? "nothing is allowed here" : "allowed are " + all;
  return near.empty() ? list : "did you mean " + near + "? " + list;
}

}  // namespace seaway::yaml
