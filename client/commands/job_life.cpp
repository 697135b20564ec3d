// SPDX-License-Identifier: GPL-3.0-or-later
// hold, release, kill, retry, label, note, priority, events, server.
#include <cstdio>
#include <fstream>
#include <memory>
#include <vector>

#include "client/commands/commands.hpp"
#include "proto/json.hpp"

namespace seaway::client {
namespace {

int print(const v1::Job& job, bool json) {
  if (json)
    std::printf("%s\n", to_json(job).c_str());
  else
    std::printf("%s %s\n", job.name().c_str(), state_text(job.state()).c_str());
  return exit_ok;
}

/// A command that takes a job and gives it back.
void add_simple(CLI::App& app, Common& common, const char* name, const char* text,
                v1::Job (JobClient::*call)(const std::string&)) {
  auto job = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand(name, text);
  sub->add_option("JOB", *job, "uid or latest")->required();
  sub->callback([=, &common] {
    common.run = [=, &common](JobClient& c) { return print((c.*call)(c.resolve(*job)), common.json); };
  });
}

void add_retry(CLI::App& app, Common& common) {
  auto job = std::make_shared<std::string>();
  auto start = std::make_shared<bool>(false);
  auto stage = std::make_shared<int>(0);
  CLI::App* sub = app.add_subcommand("retry", "a new job from an ended one, from its last checkpoint");
  sub->add_option("JOB", *job, "uid or latest")->required();
  auto* from_start = sub->add_flag("--from-start", *start, "from the beginning");
  sub->add_option("--from-stage", *stage, "from the beginning of this stage, 1 is the first")
      ->check(CLI::Range(1, 16))
      ->excludes(from_start);
  sub->callback([=, &common] {
    common.run = [=, &common](JobClient& c) {
      v1::RetryJobRequest request;
      request.set_name(c.resolve(*job));
      request.set_request_id(new_request_id());
      if (*start) request.set_from(v1::RetryJobRequest::FROM_START);
      if (*stage > 0) request.set_from(v1::RetryJobRequest::FROM_STAGE);
      request.set_stage(*stage);
      return print(c.retry(request), common.json);
    };
  });
}

/// label JOB KEY=VALUE KEY- ...
void add_label(CLI::App& app, Common& common) {
  auto job = std::make_shared<std::string>();
  auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* sub = app.add_subcommand("label", "set labels (KEY=VALUE) and remove them (KEY-)");
  sub->add_option("JOB", *job, "uid or latest")->required();
  sub->add_option("LABEL", *words, "KEY=VALUE or KEY-")->required();
  sub->callback([=, &common] {
    common.run = [=, &common](JobClient& c) {
      v1::UpdateJobRequest request;
      *request.mutable_job() = c.get(c.resolve(*job));
      for (const std::string& word : *words) {
        if (word.ends_with('-') && word.find('=') == word.npos)
          request.mutable_job()->mutable_labels()->erase(word.substr(0, word.size() - 1));
        else
          (*request.mutable_job()->mutable_labels())[parse_label(word).first] = parse_label(word).second;
      }
      request.mutable_update_mask()->add_paths("labels");
      return print(c.update(request), common.json);
    };
  });
}

void add_note_and_priority(CLI::App& app, Common& common) {
  auto job = std::make_shared<std::string>();
  auto note = std::make_shared<std::string>();
  auto priority = std::make_shared<int>(0);
  CLI::App* sub = app.add_subcommand("note", "write a note to a job");
  sub->add_option("JOB", *job, "uid or latest")->required();
  sub->add_option("TEXT", *note, "empty: none")->required();
  const auto update = [job, &common](JobClient& c, v1::Job change, const char* field) {
    v1::UpdateJobRequest request;
    *request.mutable_job() = std::move(change);
    request.mutable_job()->set_name(c.resolve(*job));
    request.mutable_update_mask()->add_paths(field);
    return print(c.update(request), common.json);
  };
  sub->callback([=, &common] {
    common.run = [=](JobClient& c) {
      v1::Job change;
      change.set_note(*note);
      return update(c, change, "note");
    };
  });
  sub = app.add_subcommand("priority", "change the priority of a job, -100 to 100; larger ones first");
  sub->add_option("JOB", *job, "uid or latest")->required();
  sub->add_option("N", *priority, "0 is normal")->required();
  sub->callback([=, &common] {
    common.run = [=](JobClient& c) {
      v1::Job change;
      change.set_priority(*priority);
      return update(c, change, "priority");
    };
  });
}

void add_events(CLI::App& app, Common& common) {
  auto after = std::make_shared<std::int64_t>(0);
  auto once = std::make_shared<bool>(false);
  CLI::App* sub = app.add_subcommand("events", "changes of all jobs, as they happen");
  sub->add_option("--after", *after, "begin after this revision")->check(CLI::NonNegativeNumber);
  sub->add_flag("--once", *once, "what there is, and then end");
  sub->callback([=, &common] {
    common.run = [=, &common](JobClient& c) {
      std::int64_t latest = 0;
      const auto status = c.watch_jobs(*after, [&](const v1::WatchJobsResponse& m) {
        if (m.has_header()) latest = m.header().latest();
        if (m.has_change()) {
          const auto& change = m.change();
          if (common.json)
            std::printf("%s\n", to_json(change).c_str());
          else
            std::printf("%lld  %s  %s  %s  %s\n", static_cast<long long>(change.revision()), time_text(change.time()).c_str(),
                        change.name().c_str(), change.kind().c_str(), state_text(change.state()).c_str());
          std::fflush(stdout);
        }
        return !(*once && (m.has_change() ? m.change().revision() : *after) >= latest);
      });
      if (!status.ok()) throw RpcError(status);
      return static_cast<int>(exit_ok);
    };
  });
}

void add_server(CLI::App& app, Common& common) {
  auto level = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand("server", "version, executor and load of the server");
  sub->add_option("--log-level", *level, "change it: trace, debug, info, warn, error");
  sub->callback([=, &common] {
    common.run = [=, &common](JobClient& c) {
      if (!level->empty()) c.set_log_level(*level);
      const v1::ServerInfo info = c.info();
      if (common.json) {
        std::printf("%s\n", to_json(info).c_str());
        return static_cast<int>(exit_ok);
      }
      std::printf("version    %s\nexecutor   %s, %d at a time\nlog level  %s\nstorage    %s\n", info.version().c_str(),
                  info.executor().c_str(), info.worker_count(), info.log_level().c_str(), info.storage_ok() ? "ok" : "the disk refuses");
      for (int i = 0; i < info.job_counts_size(); ++i)
        std::printf("%-10s %lld\n", state_text(static_cast<v1::Job::State>(i + 1)).c_str(), static_cast<long long>(info.job_counts(i)));
      return static_cast<int>(exit_ok);
    };
  });
}

}  // namespace

std::string read_token(const std::string& file) {
  std::string token;
  std::ifstream in(file);
  if (!std::getline(in, token) || token.empty()) throw ClientError(exit_usage, file + " cannot be read or holds no token");
  return token;
}

std::pair<std::string, std::string> parse_label(const std::string& text) {
  const auto at = text.find('=');
  if (at == text.npos || at == 0) throw ClientError(exit_usage, "'" + text + "' is no label; write KEY=VALUE");
  return {text.substr(0, at), text.substr(at + 1)};
}

void add_job_life(CLI::App& app, Common& common) {
  add_simple(app, common, "hold", "let a queued job wait until it is released", &JobClient::hold);
  add_simple(app, common, "release", "put a held job back into the queue", &JobClient::release);
  add_simple(app, common, "kill", "cancel a job at once, without a checkpoint", &JobClient::kill);
  add_retry(app, common);
  add_label(app, common);
  add_note_and_priority(app, common);
  add_events(app, common);
  add_server(app, common);
}

}  // namespace seaway::client
