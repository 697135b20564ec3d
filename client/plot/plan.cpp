// SPDX-License-Identifier: GPL-3.0-or-later
#include "client/plot/plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "client/job_client.hpp"
#include "client/plot/gnuplot.hpp"
#include "proto/text.hpp"

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

void draw_plans(const std::vector<Plan>& plans, const std::string& title, const std::string& path) {
  double largest = 1;  // [mm]
  for (const Plan& p : plans)
    for (const double z : p.elevation_mm)
      if (std::isfinite(z)) largest = std::max(largest, std::abs(z));
  std::ostringstream s;
  s << "set terminal pngcairo size " << 60 + 420 * plans.size() << ",800 font ',11'\nset output '"
    << gnuplot_text(std::filesystem::absolute(path).lexically_normal().string()) << "'\nset multiplot layout 1," << plans.size()
    << " title '" << gnuplot_text(title) << "' noenhanced\nset size ratio -1\nset key off\nset cbrange ["
    << -largest << ":" << largest
    << "]\nset palette defined (-1 '#2166ac', 0 '#f7f7f7', 1 '#b2182b')\nset cblabel 'elevation [mm]'\n"
    << "set xlabel 'x [m], forward'\nset ylabel 'y [m], to port'\n";
  std::map<std::string, std::string> data;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const Plan& p = plans[i];
    const std::string heights = "plan" + std::to_string(i) + ".dat", outline = "hull" + std::to_string(i) + ".dat";
    data[heights] = to_grid(p);
    data[outline] = to_blocks(p.waterline, true);
    char time[32];
    std::snprintf(time, sizeof time, "t = %.2f s", p.time_s);
    s << "set title '" << time << "'\nset xrange [" << p.x_bounds()[0] << ":" << p.x_bounds()[1] << "]\nset yrange ["
      << p.y_bounds()[0] << ":" << p.y_bounds()[1] << "]\nplot '" << heights << "' using 1:2:3 with image";
    if (!data[outline].empty()) s << ", '" << outline << "' with lines lw 1.5 lc rgb 'black'";
    s << "\n";
  }
  s << "unset multiplot\n";
  run_gnuplot(s.str(), data);
}

}  // namespace seaway::client
