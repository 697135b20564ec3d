#include "tests/validation/report/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace seaway::validation {
namespace {

constexpr double width = 460, height = 300, left = 64, right = 448, top = 28, bottom = 250;
constexpr std::array colours{"#1b5e9e", "#d95f02", "#1b9e77", "#7570b3", "#a6761d", "#666666"};
constexpr std::size_t most_points = 240;

using Point = std::array<double, 2>;
using Points = std::vector<Point>;

struct Axis {
  double low = 0, high = 1;
  bool log = false;
  double place(double v) const { return (v - low) / (high - low); }
};

Points visible_points(const Curve& c, bool log) {
  Points out;
  for (std::size_t i = 0; i < std::min(c.x.size(), c.y.size()); ++i) {
    if (log && !(c.x[i] > 0 && c.y[i] > 0)) continue;
    const Point p = log ? Point{std::log10(c.x[i]), std::log10(c.y[i])} : Point{c.x[i], c.y[i]};
    if (std::isfinite(p[0]) && std::isfinite(p[1])) out.push_back(p);
  }
  return out;
}

/// Smallest and largest of each stretch: peaks stay.
Points thinned(const Points& p) {
  if (p.size() <= most_points) return p;
  Points out;
  const std::size_t stretches = most_points / 2;
  for (std::size_t s = 0; s < stretches; ++s) {
    const auto from = p.begin() + static_cast<std::ptrdiff_t>(s * p.size() / stretches);
    const auto to = p.begin() + static_cast<std::ptrdiff_t>((s + 1) * p.size() / stretches);
    const auto [low, high] = std::minmax_element(from, to, [](const Point& a, const Point& b) { return a[1] < b[1]; });
    out.push_back(std::min(low, high)[0]);
    if (low != high) out.push_back(std::max(low, high)[0]);
  }
  return out;
}

Axis axis_of(const std::vector<Points>& curves, std::size_t coordinate, bool log) {
  Axis a{1e300, -1e300, log};
  for (const Points& points : curves)
    for (const Point& p : points) {
      a.low = std::min(a.low, p[coordinate]);
      a.high = std::max(a.high, p[coordinate]);
    }
  const double margin = a.high > a.low ? 0.04 * (a.high - a.low) : std::max(1e-12, 0.1 * std::abs(a.low));
  a.low -= margin;
  a.high += margin;
  return a;
}

/// Values in the axis's own measure.
std::vector<double> ticks_of(const Axis& a) {
  if (!a.log) return ticks_between(a.low, a.high);
  std::vector<double> out;
  for (double decade = std::floor(a.low); decade <= a.high; ++decade)
    for (const double part : {1.0, 2.0, 5.0}) {
      const double v = decade + std::log10(part);
      if (v >= a.low && v <= a.high) out.push_back(v);
    }
  return out;
}

std::string label_of(const Axis& a, double v) { return fmt::format("{:.4g}", a.log ? std::pow(10, v) : std::abs(v) < 1e-12 * (a.high - a.low) ? 0 : v); }

std::string frame(const Plot& plot, const Axis& x, const Axis& y) {
  std::string out = fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n", left, top,
                                right - left, bottom - top);
  for (const double v : ticks_of(x)) {
    const double at = left + (right - left) * x.place(v);
    out += fmt::format("<path d='M{0:.1f},{1}V{2}' stroke='#ddd'/><text x='{0:.1f}' y='{3}' text-anchor='middle'>{4}</text>\n",
                       at, top, bottom, bottom + 14, label_of(x, v));
  }
  for (const double v : ticks_of(y)) {
    const double at = bottom - (bottom - top) * y.place(v);
    out += fmt::format("<path d='M{0},{1:.1f}H{2}' stroke='#ddd'/><text x='{3}' y='{4:.1f}' text-anchor='end'>{5}</text>\n",
                       left, at, right, left - 4, at + 4, label_of(y, v));
  }
  out += fmt::format("<text x='{}' y='18' text-anchor='middle' font-weight='bold'>{}</text>\n", 0.5 * (left + right), escaped(plot.title));
  out += fmt::format("<text x='{}' y='{}' text-anchor='middle'>{}</text>\n", 0.5 * (left + right), bottom + 30, escaped(plot.x_label));
  out += fmt::format("<text transform='translate(12,{}) rotate(-90)' text-anchor='middle'>{}</text>\n", 0.5 * (top + bottom),
                     escaped(plot.y_label));
  return out;
}

std::string curve(const Points& points, bool reference, const char* colour, const Axis& x, const Axis& y) {
  std::string line, marks;
  for (const Point& p : points) {
    const double px = left + (right - left) * x.place(p[0]), py = bottom - (bottom - top) * y.place(p[1]);
    line += fmt::format("{:.1f},{:.1f} ", px, py);
    marks += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='2.5'/>", px, py);
  }
  std::string out;
  if (!reference) out += fmt::format("<polyline fill='none' stroke='{}' points='{}'/>\n", colour, line);
  if (reference || points.size() <= 12)
    out += fmt::format("<g fill='{}' stroke='{}'>{}</g>\n", reference ? "none" : colour, colour, marks);
  return out;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += c;
    }
  }
  return out;
}

std::vector<double> ticks_between(double low, double high) {
  const double rough = (high - low) / 5, decade = std::pow(10, std::floor(std::log10(rough)));
  double step = decade;
  for (const double part : {1.0, 2.0, 5.0, 10.0})
    if (part * decade <= rough * 1.5) step = part * decade;
  std::vector<double> out;
  for (double v = std::ceil(low / step) * step; v <= high + 1e-9 * step; v += step) out.push_back(v);
  return out;
}

std::string svg_of(const Plot& plot) {
  std::vector<Points> curves;
  for (const Curve& c : plot.curves) curves.push_back(thinned(visible_points(c, plot.log_axes)));
  if (std::all_of(curves.begin(), curves.end(), [](const Points& p) { return p.empty(); })) return {};
  const Axis x = axis_of(curves, 0, plot.log_axes), y = axis_of(curves, 1, plot.log_axes);
  const double rows = static_cast<double>((curves.size() + 1) / 2);
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {} {}' width='{}' font-family='sans-serif' font-size='11'>\n", width,
      height + 14 * (rows - 1), width);
  out += frame(plot, x, y);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const bool reference = plot.curves[i].reference;
    const char* colour = reference ? "#000000" : colours[i % colours.size()];
    out += curve(curves[i], reference, colour, x, y);
    const double at = left + static_cast<double>(i % 2) * 195, row = bottom + 46 + 14 * static_cast<double>(i / 2);
    out += fmt::format("<text x='{}' y='{}' fill='{}'>{} {}</text>\n", at, row, colour, reference ? "&#9675;" : "&#8212;",
                       escaped(plot.curves[i].label));
  }
  return out + "</svg>\n";
}

}  // namespace seaway::validation
