// SPDX-License-Identifier: GPL-3.0-or-later
#include "client/plot/section.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "client/job_client.hpp"

namespace seaway::client {
namespace {

double area(const Loop& loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point& a = loop[i];
    const Point& b = loop[(i + 1) % loop.size()];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return 0.5 * twice;
}

bool contains(const Loop& loop, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    const Point& a = loop[i];
    const Point& b = loop[j];
    if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside;
}

/// outer up to its point nearest to the hole, round the hole, and on: one loop with a cut of no width.
void tie(Loop& outer, const Loop& hole) {
  std::size_t at = 0, from = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outer.size(); ++i)
    for (std::size_t j = 0; j < hole.size(); ++j)
      if (const double d = std::hypot(outer[i][0] - hole[j][0], outer[i][1] - hole[j][1]); d < nearest) {
        nearest = d;
        at = i;
        from = j;
      }
  Loop cut;
  for (std::size_t j = 0; j <= hole.size(); ++j) cut.push_back(hole[(from + j) % hole.size()]);
  cut.push_back(outer[at]);
  outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(at) + 1, cut.begin(), cut.end());
}

std::vector<Loop> loops_of(const nlohmann::json& json, const char* key) {
  return json.contains(key) ? json.at(key).get<std::vector<Loop>>() : std::vector<Loop>{};
}

}  // namespace

Section parse_section(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    Section s;
    s.time_s = json.at("time_s").get<double>();
    s.y_bounds = json.at("bounds").at("y").get<std::array<double, 2>>();
    s.z_bounds = json.at("bounds").at("z").get<std::array<double, 2>>();
    s.surface = loops_of(json, "surface");
    s.hull = loops_of(json, "hull");
    s.water = loops_of(json, "water");
    return s;
  } catch (const nlohmann::json::exception& error) {
    throw ClientError(exit_failed, std::string("the section cannot be read: ") + error.what());
  }
}

std::vector<Loop> open_holes(const std::vector<Loop>& loops) {
  std::vector<Loop> outer, holes;
  for (const Loop& loop : loops) {
    if (loop.size() < 3) continue;
    (area(loop) >= 0 ? outer : holes).push_back(loop);
  }
  for (const Loop& hole : holes) {
    Loop* around = nullptr;
    for (Loop& loop : outer)
      if (contains(loop, hole.front()) && (around == nullptr || std::abs(area(loop)) < std::abs(area(*around)))) around = &loop;
    if (around != nullptr)
      tie(*around, hole);
    else
      outer.push_back(hole);
  }
  return outer;
}

std::string to_blocks(const std::vector<Loop>& loops, bool close) {
  std::string out;
  char line[80];
  for (const Loop& loop : loops) {
    if (loop.empty()) continue;
    for (const Point& p : loop) {
      std::snprintf(line, sizeof line, "%.9g %.9g\n", p[0], p[1]);
      out += line;
    }
    if (close) {
      std::snprintf(line, sizeof line, "%.9g %.9g\n", loop.front()[0], loop.front()[1]);
      out += line;
    }
    out += "\n";
  }
  return out;
}

}  // namespace seaway::client
