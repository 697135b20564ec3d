#include "core/hull/offsets_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "core/base/error.hpp"

namespace seaway::hull {

namespace {

std::vector<std::string> split_cells(std::string_view line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::string_view cell = line.substr(begin, end - begin);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r'))
      cell.remove_suffix(1);
    cells.emplace_back(cell);
    if (end == line.size()) return cells;
    begin = end + 1;
  }
}

std::optional<double> to_number(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

enum class Column { waterline, keel_z, deck_z, deck_y };

std::vector<Column> read_head(const std::string& file, int line_number,
                              const std::vector<std::string>& cells, OffsetsTable& table) {
  std::vector<Column> columns;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    if (cells[i] == "keel_z") {
      columns.push_back(Column::keel_z);
    } else if (cells[i] == "deck_z") {
      columns.push_back(Column::deck_z);
    } else if (cells[i] == "deck_y") {
      columns.push_back(Column::deck_y);
    } else {
      const std::optional<double> z = to_number(cells[i]);
      SEAWAY_CHECK(z,
                   "{}:{}: column {} is headed '{}'; allowed: a height z, keel_z, deck_z, deck_y",
                   file, line_number, i + 1, cells[i]);
      SEAWAY_CHECK(
          table.waterlines.empty() || *z > table.waterlines.back(),
          "{}:{}: waterline z = {} does not rise above the one before ({}); sort the columns", file,
          line_number, *z, table.waterlines.back());
      table.waterlines.push_back(*z);
      columns.push_back(Column::waterline);
    }
  }
  SEAWAY_CHECK(table.waterlines.size() >= 2,
               "{}:{}: {} waterlines in the head of the table; at least 2 are needed", file,
               line_number, table.waterlines.size());
  return columns;
}

OffsetsTable::Station read_station(const std::string& file, int line_number,
                                   const std::vector<std::string>& cells,
                                   const std::vector<Column>& columns) {
  SEAWAY_CHECK(cells.size() == columns.size() + 1,
               "{}:{}: {} cells where the head has {}; blank cells keep their comma", file,
               line_number, cells.size(), columns.size() + 1);
  OffsetsTable::Station station;
  const std::optional<double> x = to_number(cells[0]);
  SEAWAY_CHECK(x, "{}:{}: station '{}' is not a number", file, line_number, cells[0]);
  station.x = *x;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& cell = cells[i + 1];
    const std::optional<double> value = to_number(cell);
    SEAWAY_CHECK(cell.empty() || value, "{}:{}: cell {} is '{}'; allowed: a number or blank", file,
                 line_number, i + 2, cell);
    const bool is_breadth = columns[i] == Column::waterline || columns[i] == Column::deck_y;
    SEAWAY_CHECK(!is_breadth || !value || *value >= 0,
                 "{}:{}: half-breadth {} in cell {} is negative", file, line_number, *value, i + 2);
    switch (columns[i]) {
      case Column::waterline:
        station.half_breadths.push_back(value);
        break;
      case Column::keel_z:
        station.keel_z = value;
        break;
      case Column::deck_z:
        station.deck_z = value;
        break;
      case Column::deck_y:
        station.deck_y = value;
        break;
    }
  }
  return station;
}

}  // namespace

OffsetsTable read_offsets_table(const std::string& file) {
  std::ifstream in(file);
  if (!in) fail(ErrorCode::not_found, "offsets table '{}' cannot be opened; check the path", file);
  OffsetsTable table;
  std::vector<Column> columns;
  std::string line;
  for (int line_number = 1; std::getline(in, line); ++line_number) {
    if (line.empty() || line == "\r" || line.front() == '#') continue;
    const std::vector<std::string> cells = split_cells(line);
    if (columns.empty()) {
      columns = read_head(file, line_number, cells, table);
      continue;
    }
    OffsetsTable::Station station = read_station(file, line_number, cells, columns);
    SEAWAY_CHECK(table.stations.empty() || station.x > table.stations.back().x,
                 "{}:{}: station x = {} does not rise above the one before ({}); sort the rows",
                 file, line_number, station.x, table.stations.back().x);
    table.stations.push_back(std::move(station));
  }
  SEAWAY_CHECK(!table.stations.empty(), "offsets table '{}' has no stations", file);
  return table;
}

std::vector<std::pair<double, double>> half_section_at(const OffsetsTable& table, double x) {
  const auto& stations = table.stations;
  SEAWAY_CHECK(x >= stations.front().x && x <= stations.back().x,
               "station x = {} is outside the offsets table; allowed: {} to {}", x,
               stations.front().x, stations.back().x);
  const auto above = std::find_if(stations.begin(), stations.end(),
                                  [&](const OffsetsTable::Station& s) { return s.x >= x; });
  const OffsetsTable::Station& b = *above;
  const OffsetsTable::Station& a = b.x == x || above == stations.begin() ? b : *(above - 1);
  const double t = &a == &b ? 0.0 : (x - a.x) / (b.x - a.x);
  const auto blend = [&](const std::optional<double>& va,
                         const std::optional<double>& vb) -> std::optional<double> {
    if (!va || !vb) return std::nullopt;
    return *va + t * (*vb - *va);
  };

  std::vector<std::pair<double, double>> points;
  std::size_t last = 0;
  for (std::size_t k = 0; k < table.waterlines.size(); ++k) {
    const std::optional<double> y = blend(a.half_breadths[k], b.half_breadths[k]);
    if (!y) continue;
    SEAWAY_CHECK(points.empty() || k == last + 1,
                 "the section at x = {} has a gap between z = {} and z = {}: it is not one closed "
                 "curve; choose another station",
                 x, table.waterlines[last], table.waterlines[k]);
    points.emplace_back(table.waterlines[k], *y);
    last = k;
  }
  SEAWAY_CHECK(points.size() >= 2,
               "the section at x = {} has {} points; at least 2 are needed: choose another station "
               "or add waterlines",
               x, points.size());
  const std::optional<double> keel = blend(a.keel_z, b.keel_z);
  if (keel && *keel < points.front().first) points.insert(points.begin(), {*keel, 0.0});
  const std::optional<double> deck_z = blend(a.deck_z, b.deck_z),
                              deck_y = blend(a.deck_y, b.deck_y);
  if (deck_z && deck_y && *deck_z > points.back().first) points.emplace_back(*deck_z, *deck_y);
  return points;
}

}  // namespace seaway::hull
