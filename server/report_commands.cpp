// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/report_commands.hpp"

#include <algorithm>
#include <cstdio>

#include "proto/analysis_text.hpp"
#include "proto/json.hpp"
#include "proto/rao_figure.hpp"
#include "server/gnuplot.hpp"
#include "server/reports/decay_report.hpp"
#include "server/reports/rao_report.hpp"

namespace seaway::server {

int print_decay(const ReportOptions& o) {
  for (std::size_t i = 0; i < o.files.size(); ++i) {
    const v1::DecayReport report = reports::make_decay_report(reports::read_run(o.files[i]), o.decay);
    if (o.json)
      std::printf("%s\n", to_json(report).c_str());
    else
      std::printf("%s%s", i > 0 ? "\n" : "", report_text::decay_table(report).c_str());
  }
  return 0;
}

int print_rao(const ReportOptions& o) {
  reports::check_options(o.rao);
  std::vector<v1::RaoPoint> points;
  for (const std::string& file : o.files) points.push_back(reports::make_rao_point(reports::read_run(file), o.rao));
  const std::string title = points.size() == 1 ? points.front().title() : "";
  const v1::RaoReport report = reports::make_rao_report(title, std::move(points));
  std::printf("%s", o.json ? (to_json(report) + "\n").c_str() : report_text::rao_table(report).c_str());
  if (!o.folder.empty()) {
    const Figure figure = rao_figure(report, "rao.png");
    if (!figure.script.empty()) {
      draw_figure(o.folder, "rao", figure);
      if (!o.json) std::printf("\nwrote %s/rao.png\n", o.folder.c_str());
    }
  }
  return std::all_of(report.points().begin(), report.points().end(), [](const auto& p) { return p.motions_size() > 0; }) ? 0 : 1;
}

}  // namespace seaway::server
