// SPDX-License-Identifier: GPL-3.0-or-later
// submit and validate: a case file with the files it names -> the service.
#include <cstdio>
#include <memory>

#include "client/case_input.hpp"
#include "client/commands/commands.hpp"
#include "proto/json.hpp"
#include "proto/report_text.hpp"
#include "proto/yaml.hpp"

namespace seaway::client {
namespace {

struct Options {
  std::string file, request_id;
  bool watch = false, validate_only = false;
  int priority = 0;
  std::vector<std::string> labels;
  std::string note;
  bool hold = false;
};

void print_report(const v1::CaseReport& report, const CaseInput& in) {
  std::fputs(report_text::diagnostics(report.diagnostics(), in.lines).c_str(), stderr);
  if (report.has_hydrostatics())
    std::printf("hydrostatics\n%s\n", report_text::hydrostatics(report.hydrostatics(), in.message.dimension()).c_str());
  if (report.stages_size() > 0) std::printf("estimated cost\n%s\n", report_text::cost(report.stages()).c_str());
}

int validate(JobClient& client, const Options& o, bool json) {
  const CaseInput in = read_case(o.file);
  v1::ValidateCaseRequest request;
  *request.mutable_case_() = in.message;
  *request.mutable_files() = in.files;
  try {
    const v1::CaseReport report = client.validate(request);
    if (json)
      std::printf("%s\n", to_json(report).c_str());
    else
      print_report(report, in);
    return report.ok() ? exit_ok : exit_usage;
  } catch (const RpcError& error) {
    rethrow_with_lines(error, in, o.file);
  }
}

int submit(JobClient& client, const Options& o, bool json) {
  const CaseInput in = read_case(o.file);
  v1::CreateJobRequest request;
  *request.mutable_case_() = in.message;
  *request.mutable_files() = in.files;
  request.set_priority(o.priority);
  for (const std::string& label : o.labels) (*request.mutable_labels())[parse_label(label).first] = parse_label(label).second;
  request.set_note(o.note);
  request.set_start_held(o.hold);
  request.set_request_id(o.request_id.empty() ? new_request_id() : o.request_id);
  v1::CreateJobResponse response;
  try {
    response = client.create(request);
  } catch (const RpcError& error) {
    rethrow_with_lines(error, in, o.file);
  }
  if (json) {
    std::printf("%s\n", to_json(response).c_str());
  } else {
    print_report(response.report(), in);
    std::printf("%s  %s  %s\n", response.job().name().c_str(), state_text(response.job().state()).c_str(),
                response.job().title().c_str());
  }
  std::fflush(stdout);
  return o.watch ? follow(client, response.job().name(), 0, json, 0) : static_cast<int>(exit_ok);
}

}  // namespace

void add_submit(CLI::App& app, Common& common) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("submit", "queue a case");
  sub->add_option("CASE", o->file, "case file (YAML)")->required();
  sub->add_flag("-w,--watch", o->watch, "follow it to its end");
  sub->add_option("--priority", o->priority, "-100 to 100; larger ones first");
  sub->add_option("--label", o->labels, "KEY=VALUE; may be repeated");
  sub->add_option("--note", o->note, "for people");
  sub->add_flag("--hold", o->hold, "let it wait for seaway release");
  sub->add_option("--request-id", o->request_id, "UUID; the same one again gives the same job");
  sub->callback([o, &common] { common.run = [o, &common](JobClient& c) { return submit(c, *o, common.json); }; });
  CLI::App* check = app.add_subcommand("validate", "diagnostics, hydrostatics and cost of a case; queues nothing");
  check->add_option("CASE", o->file, "case file (YAML)")->required();
  check->callback([o, &common] { common.run = [o, &common](JobClient& c) { return validate(c, *o, common.json); }; });
}

}  // namespace seaway::client
