// Offsets table of a ship: half-breadths at stations (rows) and waterlines (columns), and the
// section that it gives at one station. Length unit of the table: the table's own.
//
// File: comma-separated text. Lines that begin with # are comments. The first other line is the
// head: any text, then one cell a column: the height z of a waterline as a number, or one of the
// names
//   keel_z   lowest point of the section, on the centre plane
//   deck_z, deck_y   height and half-breadth of the deck edge
// (optional columns). Every other line is a station: x, then the cells; blank: no hull at that
// height. x rises from row to row, the waterlines rise from column to column.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seaway::hull {

struct OffsetsTable {
  struct Station {
    double x = 0;
    std::vector<std::optional<double>> half_breadths;  ///< one a waterline
    std::optional<double> keel_z, deck_z, deck_y;
  };
  std::vector<double> waterlines;
  std::vector<Station> stations;
};

/// Throws Error(not_found) if the file cannot be opened and Error(invalid_argument) with the line
/// number if it is malformed.
OffsetsTable read_offsets_table(const std::string& file);

/// (z, half-breadth) of the section at `x`, from the keel upwards, linear between two stations; a
/// waterline counts only if both have it. Throws Error(invalid_argument) if `x` is outside the
/// table, if fewer than two points are left, or if the section has a gap (a notch in the profile).
std::vector<std::pair<double, double>> half_section_at(const OffsetsTable& table, double x);

}  // namespace seaway::hull
