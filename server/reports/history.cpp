// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/reports/history.hpp"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

#include "core/base/error.hpp"
#include "proto/yaml.hpp"

namespace seaway::reports {
namespace {

namespace fs = std::filesystem;

std::vector<std::string_view> cells_of(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string_view> out;
  for (std::size_t at = 0;;) {
    const std::size_t comma = line.find(',', at);
    out.push_back(line.substr(at, comma == line.npos ? line.npos : comma - at));
    if (comma == line.npos) return out;
    at = comma + 1;
  }
}

std::optional<double> number_in(std::string_view cell) {
  double value = 0;
  const auto result = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (result.ec != std::errc{} || result.ptr != cell.data() + cell.size()) return std::nullopt;
  return value;
}

struct Columns {
  std::size_t stage = std::string::npos, time = std::string::npos;
  std::vector<std::size_t> channels;
};

/// `name [unit]` into its two parts.
std::pair<std::string, std::string> split_title(std::string_view title) {
  const auto bracket = title.find(" [");
  if (bracket == title.npos || !title.ends_with(']')) return {std::string(title), ""};
  return {std::string(title.substr(0, bracket)), std::string(title.substr(bracket + 2, title.size() - bracket - 3))};
}

Columns read_header(const std::string& file, std::string_view line, History& out) {
  Columns columns;
  const auto titles = cells_of(line);
  for (std::size_t i = 0; i < titles.size(); ++i) {
    auto [name, unit] = split_title(titles[i]);
    if (name == "time") {
      SEAWAY_CHECK(unit == "s", "{}:1: the time is in '{}'; it must be in s", file, unit);
      columns.time = i;
    } else if (name == "stage") {
      columns.stage = i;
    } else if (name != "sequence" && name != "step") {
      columns.channels.push_back(i);
      out.channels.push_back({std::move(name), std::move(unit), {}});
    }
  }
  SEAWAY_CHECK(columns.time != std::string::npos && !out.channels.empty(),
               "{}:1: is no history; its first line must be sequence,stage,step,time [s],heave [m], ...", file);
  return columns;
}

}  // namespace

const History::Channel* History::find(const std::string& name) const {
  for (const Channel& c : channels)
    if (c.name == name) return &c;
  return nullptr;
}

History read_history(const std::string& file) {
  std::ifstream in(file);
  if (!in) fail(ErrorCode::not_found, "{} cannot be opened", file);
  std::string line;
  std::getline(in, line);
  History out;
  const Columns columns = read_header(file, line, out);
  const std::size_t width = cells_of(line).size();
  for (int number = 2; std::getline(in, line); ++number) {
    const auto cells = cells_of(line);
    if (in.eof() && cells.size() != width) break;  // a line that a killed run did not finish
    SEAWAY_CHECK(cells.size() == width, "{}:{}: {} cells, the first line has {}", file, number, cells.size(), width);
    const auto read = [&](std::size_t i) {
      const auto value = number_in(cells[i]);
      SEAWAY_CHECK(value.has_value(), "{}:{}: '{}' is no number", file, number, cells[i]);
      return *value;
    };
    const double time = read(columns.time);
    SEAWAY_CHECK(out.times.empty() || time > out.times.back(), "{}:{}: the time {} s is not later than the one before", file,
                 number, time);
    out.times.push_back(time);
    out.stages.push_back(columns.stage == std::string::npos ? 0 : static_cast<int>(read(columns.stage)));
    for (std::size_t i = 0; i < columns.channels.size(); ++i) out.channels[i].values.push_back(read(columns.channels[i]));
  }
  return out;
}

Run read_run(const std::string& path) {
  const bool folder = fs::is_directory(path);
  const fs::path place = folder ? fs::path(path) : fs::path(path).parent_path();
  Run run;
  run.source = path;
  run.history = read_history(folder ? (place / "history.csv").string() : path);
  const fs::path case_file = place / "case.yaml";
  run.has_case = fs::exists(case_file);
  if (run.has_case) {
    yaml::read_file(case_file.string(), run.message);
    run.title = run.message.title();
  }
  return run;
}

}  // namespace seaway::reports
