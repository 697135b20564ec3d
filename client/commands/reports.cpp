// SPDX-License-Identifier: GPL-3.0-or-later
// decay, rao: what the service works out from histories.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "client/commands/commands.hpp"
#include "client/plot/gnuplot.hpp"
#include "proto/analysis_text.hpp"
#include "proto/json.hpp"
#include "proto/rao_figure.hpp"

namespace seaway::client {
namespace {

namespace fs = std::filesystem;

void add_decay(CLI::App& app, Common& common) {
  struct Options {
    std::string job = "latest";
    v1::GetDecayReportRequest request;
  };
  auto o = std::make_shared<Options>();
  auto* options = o->request.mutable_options();
  CLI::App* sub = app.add_subcommand("decay", "periods, peaks and damping of a free decay");
  sub->add_option("JOB", o->job, "uid or latest");
  sub->add_option_function<std::string>("--channel", [o, options](const std::string& name) { options->set_channel(name); }, "default: roll");
  sub->add_option_function<double>("--from", [o, options](double t) { options->set_from_s(t); }, "begin at this time [s]; default: the release");
  sub->add_option_function<double>("--until", [o, options](double t) { options->set_until_s(t); }, "end at this time [s]");
  sub->add_option_function<double>("--smallest-peak", [o, options](double part) { options->set_smallest_peak(part); }, "part of the first peak; default 0.02");
  sub->callback([o, &common] {
    common.run = [o, &common](JobClient& c) {
      o->request.set_job(c.resolve(o->job));
      const v1::DecayReport report = c.decay(o->request);
      std::printf("%s", common.json ? (to_json(report) + "\n").c_str() : report_text::decay_table(report).c_str());
      return static_cast<int>(exit_ok);
    };
  });
}

struct RaoOptions {
  std::vector<std::string> jobs;
  std::string sweep, folder;
  v1::GetRaoReportRequest request;
};

int rao(JobClient& client, RaoOptions& o, bool json) {
  if (o.jobs.empty() == o.sweep.empty()) throw ClientError(exit_usage, "name jobs, or one sweep with --sweep");
  for (const std::string& job : o.jobs) o.request.add_jobs(client.resolve(job));
  if (!o.sweep.empty()) o.request.set_sweep(client.resolve_sweep(o.sweep));
  const v1::RaoReport report = client.rao(o.request);
  std::printf("%s", json ? (to_json(report) + "\n").c_str() : report_text::rao_table(report).c_str());
  if (!o.folder.empty()) {
    fs::create_directories(o.folder);
    const std::string picture = (fs::absolute(o.folder) / "rao.png").lexically_normal().string();
    const Figure figure = rao_figure(report, picture);
    if (!figure.script.empty()) {
      run_gnuplot(figure.script, figure.data);
      if (!json) std::printf("\nwrote %s\n", (fs::path(o.folder) / "rao.png").string().c_str());
    }
  }
  const auto has_numbers = [](const v1::RaoPoint& p) { return p.motions_size() > 0; };
  return std::all_of(report.points().begin(), report.points().end(), has_numbers) ? exit_ok : exit_failed;
}

void add_rao(CLI::App& app, Common& common) {
  auto o = std::make_shared<RaoOptions>();
  CLI::App* sub = app.add_subcommand("rao", "response amplitudes in regular waves, of jobs or of a sweep");
  sub->add_option("JOBS", o->jobs, "uids or latest");
  sub->add_option("--sweep", o->sweep, "uid of a sweep or latest");
  sub->add_option_function<int>("--periods", [o](int n) { o->request.mutable_options()->set_period_count(n); }, "last whole periods to fit; default 5");
  sub->add_option("-o,--output", o->folder, "folder for the picture rao.png (needs gnuplot)");
  sub->callback([o, &common] { common.run = [o, &common](JobClient& c) { return rao(c, *o, common.json); }; });
}

}  // namespace

void add_reports(CLI::App& app, Common& common) {
  add_decay(app, common);
  add_rao(app, common);
}

}  // namespace seaway::client
