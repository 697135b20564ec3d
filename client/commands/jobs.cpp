// SPDX-License-Identifier: GPL-3.0-or-later
// list, show, cancel, delete.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>

#include "client/commands/commands.hpp"
#include "proto/json.hpp"
#include "proto/report_text.hpp"
#include "proto/yaml.hpp"

namespace seaway::client {
namespace {

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

struct ListOptions {
  int limit = 50;
  bool all = false;
  std::vector<std::string> states, labels;
};

v1::Job::State parse_state(const std::string& word) {
  std::string name = "STATE_" + word;
  for (char& c : name)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  v1::Job::State state{};
  if (!v1::Job::State_Parse(name, &state) || state == v1::Job::STATE_UNSPECIFIED)
    throw ClientError(exit_usage, "'" + word + "' is no state; write queued, held, running, cancelling, succeeded, failed or cancelled");
  return state;
}

int list(JobClient& client, const ListOptions& o, bool json) {
  v1::ListJobsRequest request;
  request.set_page_size(o.all ? 1000 : std::clamp(o.limit, 1, 1000));
  for (const std::string& state : o.states) request.add_states(parse_state(state));
  for (const std::string& label : o.labels) (*request.mutable_labels())[parse_label(label).first] = parse_label(label).second;
  v1::ListJobsResponse jobs;
  do {
    v1::ListJobsResponse page = client.list(request);
    jobs.mutable_jobs()->MergeFrom(page.jobs());
    request.set_page_token(page.next_page_token());
    jobs.set_next_page_token(page.next_page_token());
  } while (o.all && !request.page_token().empty());
  if (json) {
    std::printf("%s\n", to_json(jobs).c_str());
    return exit_ok;
  }
  std::vector<std::vector<std::string>> rows{{"job", "state", "done", "samples", "created", "title"}};
  for (const v1::Job& job : jobs.jobs()) {
    char done[16];
    std::snprintf(done, sizeof done, "%.0f %%", 100 * job.progress().fraction());
    rows.push_back({job.uid(), state_text(job.state()), done, std::to_string(job.latest_sequence()),
                    time_text(job.create_time()), job.title()});
  }
  std::fputs(report_text::align(rows).c_str(), stdout);
  if (!jobs.next_page_token().empty()) std::printf("there are more; see --all and --limit\n");
  return exit_ok;
}

int show(JobClient& client, const std::string& name, bool with_case, bool json) {
  const v1::Job job = client.get(client.resolve(name), v1::JOB_VIEW_FULL);
  if (json) {
    std::printf("%s\n", to_json(job).c_str());
    return exit_ok;
  }
  if (with_case) {
    std::fputs(yaml::write(job.case_()).c_str(), stdout);
    return exit_ok;
  }
  const v1::Progress& p = job.progress();
  char progress[100];
  std::snprintf(progress, sizeof progress, "stage %d of %d, %.0f %%, t = %.2f s", p.stage() + 1, p.stage_count(),
                100 * p.fraction(), p.time_s());
  std::vector<std::vector<std::string>> rows{{"job", job.name()}, {"title", job.title()},
                                             {"state", state_text(job.state()) + reason_text(job.state_reason(), job.state_message())},
                                             {"created", time_text(job.create_time())}};
  if (job.has_start_time()) rows.push_back({"started", time_text(job.start_time())});
  if (job.has_end_time()) rows.push_back({"ended", time_text(job.end_time())});
  if (p.stage_count() > 0) rows.push_back({"progress", progress});
  if (job.priority() != 0) rows.push_back({"priority", std::to_string(job.priority())});
  for (const auto& [key, value] : job.labels()) rows.push_back({"label", key + "=" + value});
  if (!job.note().empty()) rows.push_back({"note", job.note()});
  if (!job.base_job().empty()) rows.push_back({"repeats", job.base_job()});
  rows.push_back({"attempt", std::to_string(job.attempt())});
  rows.push_back({"samples", std::to_string(job.latest_sequence())});
  rows.push_back({"checkpoint after", std::to_string(job.checkpoint_sequence())});
  rows.push_back({"digest", job.spec_digest().substr(0, 16)});
  rows.push_back({"version", job.code_version()});
  for (const auto& row : rows) std::printf("%-17s %s\n", row[0].c_str(), row[1].c_str());
  for (const v1::JobEvent& event : job.events())
    std::printf("%s  #%d  %s  %s\n", time_text(event.time()).c_str(), event.attempt(), event.kind().c_str(), event.text().c_str());
  return exit_ok;
}

}  // namespace

std::string state_text(v1::Job::State state) { return lower(v1::Job::State_Name(state).substr(6)); }

std::string reason_text(v1::Job::Reason reason, const std::string& message) {
  std::string out;
  if (reason != v1::Job::REASON_UNSPECIFIED) out += " (" + lower(v1::Job::Reason_Name(reason).substr(7)) + ")";
  if (!message.empty()) out += ": " + message;
  return out;
}

std::string time_text(const google::protobuf::Timestamp& time) {
  const std::time_t seconds = time.seconds();
  std::tm local{};
  localtime_r(&seconds, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &local);
  return text;
}

void add_jobs(CLI::App& app, Common& common) {
  auto o = std::make_shared<ListOptions>();
  CLI::App* sub = app.add_subcommand("list", "jobs, newest first");
  sub->add_option("-n,--limit", o->limit, "how many")->check(CLI::Range(1, 1000));
  sub->add_flag("--all", o->all, "all of them");
  sub->add_option("--state", o->states, "only jobs in this state; may be repeated");
  sub->add_option("--label", o->labels, "only jobs with KEY=VALUE; may be repeated");
  sub->callback([o, &common] { common.run = [o, &common](JobClient& c) { return list(c, *o, common.json); }; });

  auto job = std::make_shared<std::string>("latest");
  auto with_case = std::make_shared<bool>(false);
  sub = app.add_subcommand("show", "one job: state, progress, events");
  sub->add_option("JOB", *job, "uid or latest");
  sub->add_flag("--case", *with_case, "print its case as YAML");
  sub->callback([=, &common] { common.run = [=, &common](JobClient& c) { return show(c, *job, *with_case, common.json); }; });

  sub = app.add_subcommand("cancel", "cancel a job; a running one writes a last checkpoint");
  sub->add_option("JOB", *job, "uid or latest")->required();
  sub->callback([=, &common] {
    common.run = [=, &common](JobClient& c) {
      const v1::Job now = c.cancel(c.resolve(*job));
      if (common.json)
        std::printf("%s\n", to_json(now).c_str());
      else
        std::printf("%s %s\n", now.name().c_str(), state_text(now.state()).c_str());
      return static_cast<int>(exit_ok);
    };
  });

  sub = app.add_subcommand("delete", "remove an ended job with all its data");
  sub->add_option("JOB", *job, "uid")->required();
  sub->callback([=, &common] {
    common.run = [=, &common](JobClient& c) {
      const std::string name = c.resolve(*job);
      c.erase(name);
      std::printf(common.json ? "{\"deleted\":\"%s\"}\n" : "%s deleted\n", name.c_str());
      return static_cast<int>(exit_ok);
    };
  });
}

}  // namespace seaway::client
