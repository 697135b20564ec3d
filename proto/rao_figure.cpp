// SPDX-License-Identifier: GPL-3.0-or-later
#include "proto/rao_figure.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <vector>

namespace seaway {
namespace {

constexpr const char* colours[] = {"#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377"};

std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') out += '\'';  // doubled inside single quotes
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

bool varies(const v1::RaoReport& r, double (v1::RaoPoint::*get)() const) {
  for (const auto& p : r.points())
    if (p.motions_size() > 0 && (p.*get)() != (r.points(0).*get)()) return true;
  return false;
}

/// Title of the curve that the point belongs to.
std::string curve_of(const v1::RaoReport& r, const v1::RaoPoint& p) {
  std::string out = p.case_name();
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  if (varies(r, &v1::RaoPoint::heading_deg)) add(short_number(p.heading_deg()) + " deg");
  if (varies(r, &v1::RaoPoint::wave_height_m)) add("H " + short_number(p.wave_height_m()) + " m");
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
      curve->rows += short_number(p.period_s()) + " " + short_number(m.rao()) + " " + short_number(m.rao_scatter()) + "\n";
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
  s << "set terminal pngcairo size 1000," << 100 + 340 * panels.size() << " font ',12'\nset output '" << quoted(output)
    << "'\nset grid lc rgb '#dddddd'\nset key top right noenhanced\nset yrange [0:*]\nset offsets graph 0.05, graph 0.05, graph 0.1, 0\n"
    << "set multiplot layout " << panels.size() << ",1 title '" << quoted(r.title()) << "' noenhanced\nset xlabel 'wave period [s]'\n";
  int files = 0;
  for (const Panel& panel : panels) {
    const bool rotation = panel.motion == "roll" || panel.motion == "pitch" || panel.motion == "yaw";
    s << "set ylabel '" << panel.motion << (rotation ? " / wave slope [-]" : " / wave amplitude [-]") << "'\nplot ";
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      const std::string file = "curve" + std::to_string(files++) + ".dat";
      out.data[file] = panel.curves[i].rows;
      const char* colour = colours[i % std::size(colours)];
      s << (i > 0 ? ", " : "") << "'" << file << "' using 1:2 with linespoints lw 1.5 pt 7 lc rgb '" << colour << "' title '"
        << quoted(panel.curves[i].title) << "', '" << file << "' using 1:2:3 with yerrorbars pt 7 lc rgb '" << colour << "' notitle";
    }
    s << "\n";
  }
  s << "unset multiplot\n";
  out.script = s.str();
  return out;
}

}  // namespace seaway
