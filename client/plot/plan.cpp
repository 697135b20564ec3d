// SPDX-License-Identifier: GPL-3.0-or-later
#include "client/plot/plan.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/job_client.hpp"

namespace seaway::client {

Plan parse_plan(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    const auto axis = [&](const char* name) {
      const auto& a = json.at(name);
      return Plan::Axis{a.at("first").get<double>(), a.at("step").get<double>(), a.at("count").get<int>()};
    };
    Plan p;
    p.time_s = json.at("time_s").get<double>();
    p.x = axis("x");
    p.y = axis("y");
    for (const auto& row : json.at("elevation_mm"))
      for (const auto& z : row) p.elevation_mm.push_back(z.is_null() ? std::nan("") : z.get<double>());
    p.waterline = json.at("waterline").get<std::vector<Loop>>();
    if (p.x.count < 1 || p.y.count < 1 ||
        p.elevation_mm.size() != static_cast<std::size_t>(p.x.count) * static_cast<std::size_t>(p.y.count))
      throw ClientError(exit_failed, "the plan cannot be read: its rows do not fit its axes");
    return p;
  } catch (const nlohmann::json::exception& error) {
    throw ClientError(exit_failed, std::string("the plan cannot be read: ") + error.what());
  }
}

std::string to_grid(const Plan& p) {
  std::string out;
  char line[96];
  for (int j = 0; j < p.y.count; ++j) {
    for (int i = 0; i < p.x.count; ++i) {
      const double z = p.elevation_mm[static_cast<std::size_t>(j) * static_cast<std::size_t>(p.x.count) +
                                      static_cast<std::size_t>(i)];
      if (std::isfinite(z))
        std::snprintf(line, sizeof line, "%.6g %.6g %.6g\n", p.x.first + i * p.x.step, p.y.first + j * p.y.step, z);
      else
        std::snprintf(line, sizeof line, "%.6g %.6g NaN\n", p.x.first + i * p.x.step, p.y.first + j * p.y.step);
      out += line;
    }
    out += "\n";
  }
  return out;
}

}  // namespace seaway::client
