#include "tests/validation/support/cascade_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::validation {
namespace {

constexpr double left = 70, right = 880, panel_height = 200, gap = 40;

struct Scale {
  double end = 1, largest = 1, middle = 0;
  double x(double t) const { return left + (right - left) * t / end; }
  double y(double v) const { return middle - 0.5 * panel_height * v / largest; }
};

std::string curve(const RunRecord& run, const std::vector<double>& signal, double factor,
                  const Scale& scale, const char* colour) {
  std::string points;
  for (std::size_t i = 0; i < run.t.size(); ++i)
    if (run.t[i] <= scale.end)
      points += fmt::format("{:.1f},{:.1f} ", scale.x(run.t[i]), scale.y(factor * signal[i]));
  return fmt::format("<polyline fill='none' stroke='{}' points='{}'/>\n", colour, points);
}

std::string panel(const RunRecord& cascade, const RunRecord& single,
                  std::vector<double> RunRecord::*signal, double factor, const char* label,
                  double top, double end) {
  Scale scale{end, 0, top + 0.5 * panel_height};
  for (const RunRecord* run : {&cascade, &single})
    for (const double v : run->*signal)
      scale.largest = std::max(scale.largest, std::abs(factor * v));
  scale.largest = std::max(1.05 * scale.largest, 1e-12);
  std::string out = fmt::format(
      "<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n"
      "<text x='5' y='{}'>{}</text><text x='5' y='{}'>{:.3g}</text>\n"
      "<text x='5' y='{}'>{:.3g}</text>\n",
      left, top, right - left, panel_height, scale.middle, label, top + 12, scale.largest,
      top + panel_height, -scale.largest);
  for (const StageRecord& s : cascade.stages)
    out += fmt::format(
        "<line x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}' stroke='#888' stroke-dasharray='4 3'/>"
        "<text x='{3:.1f}' y='{4}'>{5}</text>\n",
        scale.x(s.start), top, top + panel_height, scale.x(s.start) + 3, top + 12, s.name);
  out += curve(single, single.*signal, factor, scale, "#d95f02");
  out += curve(cascade, cascade.*signal, factor, scale, "#1b5e9e");
  return out;
}

void add_rows(std::string& out, const char* run, const RunRecord& record) {
  for (const StageRecord& s : record.stages)
    out += fmt::format("| {} | {} | {} | {:.2f} - {:.2f} | {} | {:.1f} | {:.2f} | {} |\n", run,
                       s.name, s.cells, s.start, s.end, s.steps, s.cpu_s, s.mapping_cpu_s,
                       s.converged ? "yes" : "no");
}

}  // namespace

std::string table_of(const RunRecord& cascade, const RunRecord& single) {
  std::string out =
      "| run | stage | cells | time, s | steps | CPU s | of it mapping | converged |\n"
      "|---|---|---|---|---|---|---|---|\n";
  add_rows(out, "cascade", cascade);
  add_rows(out, "single mesh", single);
  out += fmt::format("\nCPU seconds until t = {:.2f} s: cascade {:.1f}, single mesh {:.1f}\n",
                     cascade.end_time(), cascade.total_cpu_s, single.cpu_until(cascade.end_time()));
  return out;
}

std::string picture_of(const RunRecord& cascade, const RunRecord& single) {
  const double end = std::max(cascade.end_time(), 1e-3);
  std::string out =
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 900 500' font-family='sans-serif' "
      "font-size='11'>\n<rect width='900' height='500' fill='white'/>\n";
  out += panel(cascade, single, &RunRecord::roll, 1 / degree, "roll, deg", 20, end);
  out += panel(cascade, single, &RunRecord::heave, 1000, "heave, mm", 20 + panel_height + gap, end);
  out += fmt::format(
      "<text x='{}' y='490' fill='#1b5e9e'>cascade</text>"
      "<text x='{}' y='490' fill='#d95f02'>single mesh</text>"
      "<text x='{}' y='490'>t = 0 to {:.2f} s</text>\n</svg>\n",
      left, left + 80, right - 100, end);
  return out;
}

}  // namespace seaway::validation
