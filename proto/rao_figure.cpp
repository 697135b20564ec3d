// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/rao_figure.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include "proto/text.hpp"

namespace seaway {
namespace {

constexpr const char* colours[] = {"#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377"};

bool varies(const v1::RaoReport& r, double (v1::RaoPoint::*get)() const) {
  for (const auto& p : r.points())
    if (p.motions_size() > 0 && (p.*get)() != (r.points(0).*get)()) return true;
  return false;
}

/// Title of the curve that the point belongs to.
std::string curve_of(const v1::RaoReport& r, const v1::RaoPoint& p) {
  std::string out = p.case_name();
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  if (varies(r, &v1::RaoPoint::heading_deg)) add(formatted(p.heading_deg(), "%.4g") + " deg");
  if (varies(r, &v1::RaoPoint::wave_height_m)) add("H " + formatted(p.wave_height_m(), "%.4g") + " m");
  return out.empty() ? "computed" : out;
}

struct Curve {
  std::string title, rows;
};

std::vector<Curve> curves_of(const v1::RaoReport& r, const std::string& motion) {
  std::vector<Curve> out;
  for (const auto& p : r.points())
    for (const auto& m : p.motions()) {
      if (m.channel() != motion) continue;
      const std::string title = curve_of(r, p);
      auto curve = std::find_if(out.begin(), out.end(), [&](const Curve& c) { return c.title == title; });
      if (curve == out.end()) curve = out.insert(out.end(), {title, ""});
      curve->rows += formatted(p.period_s(), "%.4g") + " " + formatted(m.rao(), "%.4g") + " " + formatted(m.rao_scatter(), "%.4g") + "\n";
    }
  return out;
}

}  // namespace

Figure rao_figure(const v1::RaoReport& r, const std::string& output) {
  struct Panel {
    std::string motion;
    std::vector<Curve> curves;
  };
  std::vector<Panel> panels;
  for (const char* motion : {"heave", "roll", "pitch", "sway", "surge", "yaw"})
    if (auto curves = curves_of(r, motion); !curves.empty()) panels.push_back({motion, std::move(curves)});
  Figure out;
  if (panels.empty()) return out;
  std::ostringstream s;
  s << "set terminal pngcairo size 1000," << 100 + 340 * panels.size() << " font ',12'\nset output '" << gnuplot_text(output)
    << "'\nset grid lc rgb '#dddddd'\nset key top right noenhanced\nset yrange [0:*]\nset offsets graph 0.05, graph 0.05, graph 0.1, 0\n"
    << "set multiplot layout " << panels.size() << ",1 title '" << gnuplot_text(r.title()) << "' noenhanced\nset xlabel 'wave period [s]'\n";
  int files = 0;
  for (const Panel& panel : panels) {
    const bool rotation = panel.motion == "roll" || panel.motion == "pitch" || panel.motion == "yaw";
    s << "set ylabel '" << panel.motion << (rotation ? " / wave slope [-]" : " / wave amplitude [-]") << "'\nplot ";
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      const std::string file = "curve" + std::to_string(files++) + ".dat";
      out.data[file] = panel.curves[i].rows;
      const char* colour = colours[i % std::size(colours)];
      s << (i > 0 ? ", " : "") << "'" << file << "' using 1:2 with linespoints lw 1.5 pt 7 lc rgb '" << colour << "' title '"
        << gnuplot_text(panel.curves[i].title) << "', '" << file << "' using 1:2:3 with yerrorbars pt 7 lc rgb '" << colour << "' notitle";
    }
    s << "\n";
  }
  s << "unset multiplot\n";
  out.script = s.str();
  return out;
}

}  // namespace seaway
