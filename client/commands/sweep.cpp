// SPDX-License-Identifier: GPL-3.0-or-later
// sweep, sweeps: one request, many jobs.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "client/case_input.hpp"
#include "client/commands/commands.hpp"
#include "proto/json.hpp"
#include "proto/report_text.hpp"
#include "proto/text.hpp"

namespace seaway::client {
namespace {

struct Options {
  std::vector<std::string> files, labels;
  std::vector<double> periods, heights, headings;
  std::string title, note, request_id;
  int priority = 0;
  bool hold = false, validate_only = false;
};

std::string number(double value) { return formatted(value, "%.6g"); }

/// queued 3, running 1
std::string counts_text(const v1::Sweep& sweep) {
  std::string out;
  std::int64_t known = 0;
  for (int i = 0; i < sweep.state_counts_size(); ++i) {
    known += sweep.state_counts(i);
    if (sweep.state_counts(i) == 0) continue;
    out += (out.empty() ? "" : ", ") + state_text(static_cast<v1::Job::State>(i + 1)) + " " + std::to_string(sweep.state_counts(i));
  }
  if (known < sweep.job_count()) out += (out.empty() ? "deleted " : ", deleted ") + std::to_string(sweep.job_count() - known);
  return out;
}

void print_sweep(const v1::Sweep& sweep) {
  std::printf("%s  %s\n%d jobs: %s\n", sweep.name().c_str(), sweep.title().c_str(), sweep.job_count(), counts_text(sweep).c_str());
  std::vector<std::vector<std::string>> rows{{"job", "case", "period", "height", "heading", "state", "done"}};
  for (const v1::SweepPoint& p : sweep.points()) {
    const bool deleted = p.state() == v1::Job::STATE_UNSPECIFIED;
    rows.push_back({p.job(), p.case_name(), p.period_s() > 0 ? number(p.period_s()) + " s" : "-", number(p.height_m()) + " m",
                    number(p.heading_deg()) + " deg", deleted ? "deleted" : state_text(p.state()),
                    deleted ? "-" : number(static_cast<int>(100 * p.fraction() + 0.5)) + " %"});
  }
  std::fputs(report_text::align(rows).c_str(), stdout);
}

v1::CreateSweepRequest make_request(const Options& o, const std::vector<CaseInput>& cases) {
  v1::CreateSweepRequest request;
  request.set_request_id(o.request_id.empty() ? new_request_id() : o.request_id);
  request.set_title(o.title);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    v1::SweepCase& one = *request.add_cases();
    one.set_name(std::filesystem::path(o.files[i]).stem().string().substr(0, 40));
    *one.mutable_case_() = cases[i].message;
    *one.mutable_files() = cases[i].files;
  }
  request.mutable_periods_s()->Add(o.periods.begin(), o.periods.end());
  request.mutable_heights_m()->Add(o.heights.begin(), o.heights.end());
  request.mutable_headings_deg()->Add(o.headings.begin(), o.headings.end());
  request.set_priority(o.priority);
  for (const std::string& label : o.labels) (*request.mutable_labels())[parse_label(label).first] = parse_label(label).second;
  request.set_note(o.note);
  request.set_start_held(o.hold);
  request.set_validate_only(o.validate_only);
  return request;
}

/// What the service says about fields, with the lines of the files and the options that they were written in.
std::string text_with_lines(const RpcError& error, const Options& o, const std::vector<CaseInput>& cases) {
  std::string out;
  for (const auto& [field, text] : error.violations()) {
    yaml::Problem problem{{}, field, text, ""};
    std::string file;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const std::string path = "cases[" + std::to_string(i) + "].case.";
      if (!field.starts_with(path)) continue;
      file = o.files[i];
      problem.field = field.substr(path.size());
      problem.at = cases[i].lines.find(problem.field);
    }
    for (const auto& [list, option] : {std::pair{"periods_s[", "--period"}, {"heights_m[", "--height"}, {"headings_deg[", "--heading"}})
      if (field.starts_with(list)) problem.field = option;
    out += (out.empty() ? "" : "\n") + yaml::to_text(file, problem);
  }
  return out;
}

double cpu_seconds(const v1::CreateSweepResponse& response) {
  double sum = 0;
  for (const auto& report : response.reports())
    for (const auto& stage : report.stages()) sum += stage.cpu_s();
  return sum;
}

int create(JobClient& client, const Options& o, bool json) {
  std::vector<CaseInput> cases;
  for (const std::string& file : o.files) cases.push_back(read_case(file));
  v1::CreateSweepResponse response;
  try {
    response = client.create_sweep(make_request(o, cases));
  } catch (const RpcError& error) {
    if (error.violations().empty()) throw;
    throw ClientError(error.code(), text_with_lines(error, o, cases));
  }
  bool ok = true;
  for (const auto& report : response.reports()) ok = ok && report.ok();
  if (json) {
    std::printf("%s\n", to_json(response).c_str());
    return ok ? exit_ok : exit_usage;
  }
  for (const auto& report : response.reports())
    std::fputs(report_text::diagnostics(report.diagnostics(), cases.front().lines).c_str(), stderr);
  if (response.reports_size() > 0)
    std::printf("%d jobs, estimated CPU time in all %s\n", response.reports_size(), report_text::duration(cpu_seconds(response)).c_str());
  if (response.has_sweep()) print_sweep(response.sweep());
  return ok ? exit_ok : exit_usage;
}

int show(JobClient& client, const std::string& name, bool cancel, bool json) {
  const std::string resolved = client.resolve_sweep(name);
  const v1::Sweep sweep = cancel ? client.cancel_sweep(resolved) : client.sweep(resolved);
  if (json)
    std::printf("%s\n", to_json(sweep).c_str());
  else
    print_sweep(sweep);
  return exit_ok;
}

int list(JobClient& client, bool json) {
  v1::ListSweepsRequest request;
  std::vector<std::vector<std::string>> rows{{"uid", "jobs", "states", "created", "title"}};
  v1::ListSweepsResponse all;
  for (;;) {
    const auto page = client.list_sweeps(request);
    for (const v1::Sweep& s : page.sweeps()) {
      rows.push_back({s.uid(), std::to_string(s.job_count()), counts_text(s), time_text(s.create_time()), s.title()});
      *all.add_sweeps() = s;
    }
    if (page.next_page_token().empty()) break;
    request.set_page_token(page.next_page_token());
  }
  std::printf("%s", json ? (to_json(all) + "\n").c_str() : report_text::align(rows).c_str());
  return exit_ok;
}

}  // namespace

void add_sweep(CLI::App& app, Common& common) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("sweep", "queue one job for each combination of case, heading, height and period");
  sub->add_option("CASE", o->files, "case files (YAML), one for each condition, with a regular wave")->required();
  sub->add_option("--period", o->periods, "wave periods [s], separated by commas")->delimiter(',');
  sub->add_option("--height", o->heights, "wave heights [m]")->delimiter(',');
  sub->add_option("--heading", o->headings, "directions that the waves go to [deg]")->delimiter(',');
  sub->add_option("--title", o->title, "default: that of the first case");
  sub->add_option("--priority", o->priority, "-100 to 100; larger ones first");
  sub->add_option("--label", o->labels, "KEY=VALUE; may be repeated");
  sub->add_option("--note", o->note, "for people");
  sub->add_flag("--hold", o->hold, "let the jobs wait for seaway release");
  sub->add_flag("--check", o->validate_only, "only check all jobs; queue nothing");
  sub->add_option("--request-id", o->request_id, "UUID; the same one again gives the same sweep");
  sub->callback([o, &common] { common.run = [o, &common](JobClient& c) { return create(c, *o, common.json); }; });

  auto name = std::make_shared<std::string>();
  auto cancel = std::make_shared<bool>(false);
  sub = app.add_subcommand("sweeps", "all sweeps, or one with the states of its jobs");
  sub->add_option("SWEEP", *name, "uid or latest");
  sub->add_flag("--cancel", *cancel, "cancel its jobs that have not ended");
  sub->callback([=, &common] {
    common.run = [=, &common](JobClient& c) {
      if (name->empty() && *cancel) throw ClientError(exit_usage, "which sweep?");
      return name->empty() ? list(c, common.json) : show(c, *name, *cancel, common.json);
    };
  });
}

}  // namespace seaway::client
