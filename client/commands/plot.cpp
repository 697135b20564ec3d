// SPDX-License-Identifier: GPL-3.0-or-later
// plot: roll and heave histories with the stage changes, and the free surface around the section.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

#include "client/commands/commands.hpp"
#include "client/plot/gnuplot.hpp"
#include "client/plot/plan.hpp"
#include "client/plot/section.hpp"
#include "proto/json.hpp"
#include "proto/text.hpp"

namespace seaway::client {
namespace {

namespace fs = std::filesystem;

/// Instants of the free surface from above, a quarter of a wave period apart if snapshots are.
constexpr std::size_t plans_in_a_picture = 4;

struct Panel {
  int column = 0;
  std::string label;
  double factor = 1;
};

/// Heave and roll where there are; else the first channels, so that a tank without a hull has a picture too.
std::vector<Panel> choose_panels(const google::protobuf::RepeatedPtrField<v1::ChannelSchema>& channels) {
  std::vector<Panel> out;
  const auto add = [&](int i) {
    const auto& c = channels[i];
    const bool small = c.unit() == "m";
    out.push_back({i, c.name() + " [" + (small ? "mm" : c.unit()) + "]", small ? 1000.0 : 1.0});
  };
  for (const char* name : {"roll", "heave"})
    for (int i = 0; i < channels.size(); ++i)
      if (channels[i].name() == name) add(i);
  for (int i = 0; i < channels.size() && out.empty(); ++i)
    if (channels[i].unit() == "m") add(i);
  if (out.empty() && !channels.empty()) add(0);
  return out;
}

std::string absolute(const std::string& path) { return fs::absolute(path).lexically_normal().string(); }

void plot_motions(JobClient& client, const v1::Job& job, const std::string& path) {
  std::vector<Panel> panels;
  std::string data;
  client.history(job.name(), [&](const v1::ReadSamplesResponse& page) {
    if (panels.empty()) panels = choose_panels(page.header().channels());
    char cell[64];
    for (int i = 0; i < page.chunk().times_s_size(); ++i) {
      std::snprintf(cell, sizeof cell, "%.6f", page.chunk().times_s(i));
      data += cell;
      for (const Panel& p : panels) {
        std::snprintf(cell, sizeof cell, " %.6g", p.factor * page.chunk().columns(p.column).values(i));
        data += cell;
      }
      data += '\n';
    }
  });
  if (data.empty()) throw ClientError(exit_failed, job.name() + " has no samples yet; nothing to plot");
  std::ostringstream s;
  s << "set terminal pngcairo size 1200," << 120 + 330 * panels.size() << " font ',12'\nset output '" << gnuplot_text(absolute(path))
    << "'\nset grid lc rgb '#dddddd'\nset key off\nset multiplot layout " << panels.size() << ",1 title '"
    << gnuplot_text(job.title()) << "' noenhanced\nset xlabel 'time [s]'\n";
  const auto stages = client.stages(job.name());
  for (const auto& stage : stages.stages()) {
    if (stage.stage() > 0)
      s << "set arrow from first " << stage.start_time_s() << ", graph 0 to first " << stage.start_time_s()
        << ", graph 1 nohead dashtype 2 lc rgb '#aa3377'\n";
    s << "set label '" << gnuplot_text(stage.name()) << "' at first " << stage.start_time_s()
      << ", graph 0.95 offset 0.5,0 noenhanced tc rgb '#aa3377'\n";
  }
  for (std::size_t i = 0; i < panels.size(); ++i)
    s << "set ylabel '" << gnuplot_text(panels[i].label) << "' noenhanced\nplot 'history.dat' using 1:" << i + 2
      << " with lines lw 1.5 lc rgb '" << (i == 0 ? "#4477aa" : "#ee6677") << "'\n";
  s << "unset multiplot\n";
  run_gnuplot(s.str(), {{"history.dat", data}});
}

/// The last artifacts of a kind ("section", "plan"; names <kind>_<stage>_<time>.json), in order of time.
std::vector<std::string> last_artifacts(JobClient& client, const std::string& job, const std::string& kind,
                                        std::size_t count) {
  std::vector<std::pair<double, std::string>> found;
  const v1::ListArtifactsResponse list = client.artifacts(job);
  for (const v1::Artifact& a : list.artifacts()) {
    int stage = 0;
    double time = 0;
    if (std::sscanf(a.name().c_str(), (kind + "_%d_%lf").c_str(), &stage, &time) == 2 && a.name().ends_with(".json"))
      found.emplace_back(time, a.name());
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> names;
  for (std::size_t i = found.size() > count ? found.size() - count : 0; i < found.size(); ++i)
    names.push_back(found[i].second);
  return names;
}

std::string download(JobClient& client, const std::string& job, const std::string& artifact) {
  std::string text;
  client.download(job, artifact, [&](const std::string& piece) { text += piece; });
  return text;
}

void plot_section(const Section& section, const v1::Job& job, const std::string& path) {
  std::array<double, 2> y = section.y_bounds, z = section.z_bounds;
  if (!section.hull.empty()) {
    std::array<double, 2> hull_y{1e300, -1e300}, hull_z{1e300, -1e300};
    for (const Loop& loop : section.hull)
      for (const Point& p : loop) {
        hull_y = {std::min(hull_y[0], p[0]), std::max(hull_y[1], p[0])};
        hull_z = {std::min(hull_z[0], p[1]), std::max(hull_z[1], p[1])};
      }
    const double width = hull_y[1] - hull_y[0];
    const double height = hull_z[1] - hull_z[0];
    y = {std::max(y[0], hull_y[0] - 1.2 * width), std::min(y[1], hull_y[1] + 1.2 * width)};
    z = {std::max(z[0], hull_z[0] - 0.5 * height), std::min(z[1], hull_z[1] + 0.3 * height)};
  }
  std::ostringstream s;
  char time[32];
  std::snprintf(time, sizeof time, "%.2f", section.time_s);
  s << "set terminal pngcairo size 1200,800 font ',12'\nset output '" << gnuplot_text(absolute(path)) << "'\nset title '"
    << gnuplot_text(job.title()) << ", t = " << time << " s' noenhanced\nset size ratio -1\nset xrange [" << y[0] << ":"
    << y[1] << "]\nset yrange [" << z[0] << ":" << z[1]
    << "]\nset xlabel 'y [m], to port'\nset ylabel 'z [m]'\nset grid lc rgb '#eeeeee'\nset key off\nset style fill solid 1.0 noborder\nplot ";
  std::map<std::string, std::string> data;
  if (!section.water.empty()) {
    data["water.dat"] = to_blocks(section.water, true);
    s << "'water.dat' with filledcurves closed lc rgb '#cfe3f5', ";
  }
  if (!section.hull.empty()) {
    data["hull.dat"] = to_blocks(open_holes(section.hull), true);
    data["outline.dat"] = to_blocks(section.hull, true);
    s << "'hull.dat' with filledcurves closed lc rgb '#bbbbbb', 'outline.dat' with lines lw 1 lc rgb '#333333', ";
  }
  data["surface.dat"] = to_blocks(section.surface, false);
  s << "'surface.dat' with lines lw 2 lc rgb '#0055aa'\n";
  if (section.surface.empty()) data["surface.dat"] = "0 0\n";
  run_gnuplot(s.str(), data);
}

int plot(JobClient& client, const std::string& name, const std::string& folder, bool json) {
  const v1::Job job = client.get(client.resolve(name));
  fs::create_directories(folder);
  std::vector<std::string> written;
  written.push_back((fs::path(folder) / (job.uid() + "_motions.png")).string());
  plot_motions(client, job, written.back());
  if (const auto last = last_artifacts(client, job.name(), "section", 1); !last.empty()) {
    written.push_back((fs::path(folder) / (job.uid() + "_section.png")).string());
    plot_section(parse_section(download(client, job.name(), last.back())), job, written.back());
  }
  std::vector<Plan> plans;
  for (const std::string& artifact : last_artifacts(client, job.name(), "plan", plans_in_a_picture))
    plans.push_back(parse_plan(download(client, job.name(), artifact)));
  if (!plans.empty()) {
    written.push_back((fs::path(folder) / (job.uid() + "_plan.png")).string());
    draw_plans(plans, job.title(), written.back());
  }
  if (json) {
    std::string list;
    for (const std::string& file : written) list += (list.empty() ? "\"" : ",\"") + file + "\"";
    std::printf("{\"files\":[%s]}\n", list.c_str());
  } else {
    for (const std::string& file : written) std::printf("%s\n", file.c_str());
  }
  return exit_ok;
}

}  // namespace

void add_plot(CLI::App& app, Common& common) {
  struct Options {
    std::string job = "latest", folder = ".";
  };
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("plot", "PNG pictures of the motions and of the free surface (needs gnuplot)");
  sub->add_option("JOB", o->job, "uid or latest");
  sub->add_option("-o,--output", o->folder, "folder; default: here");
  sub->callback([o, &common] { common.run = [o, &common](JobClient& c) { return plot(c, o->job, o->folder, common.json); }; });
}

}  // namespace seaway::client
