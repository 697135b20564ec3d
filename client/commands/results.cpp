// SPDX-License-Identifier: GPL-3.0-or-later
// history, stages, artifacts, download.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "client/commands/commands.hpp"
#include "proto/history_csv.hpp"
#include "proto/json.hpp"
#include "proto/report_text.hpp"

namespace seaway::client {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

int keep_open(std::FILE* file) { return std::fflush(file); }

File open_output(const std::string& path) {
  if (path.empty() || path == "-") return {stdout, keep_open};
  File file(std::fopen(path.c_str(), "wb"), std::fclose);
  if (file == nullptr) throw ClientError(exit_failed, path + " cannot be written");
  return file;
}

void write(const File& file, const std::string& bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
    throw ClientError(exit_failed, "the output cannot be written; is the disk full?");
}

int history(JobClient& client, const std::string& job, const std::string& output, bool json) {
  const File file = open_output(output);
  bool first = true;
  client.history(client.resolve(job), [&](const v1::ReadSamplesResponse& page) {
    if (json) {
      if (first || page.chunk().times_s_size() > 0) write(file, to_json(page) + "\n");
    } else {
      std::string text;
      if (first) text = history_csv::header(page.header().channels());
      history_csv::append(page.chunk(), text);
      write(file, text);
    }
    first = false;
  });
  return exit_ok;
}

int download(JobClient& client, const std::string& job, const std::string& artifact, const std::string& output) {
  // The name comes from the server: only its last part may choose the file.
  const std::string path = output.empty() ? std::filesystem::path(artifact).filename().string() : output;
  const File file = open_output(path);
  client.download(client.resolve(job), artifact, [&](const std::string& piece) { write(file, piece); });
  if (file.get() != stdout) std::printf("%s\n", path.c_str());
  return exit_ok;
}

}  // namespace

void add_results(CLI::App& app, Common& common) {
  struct Options {
    std::string job = "latest", artifact, output;
  };
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("history", "the samples as CSV, units in the header");
  sub->add_option("JOB", o->job, "uid or latest");
  sub->add_option("-o,--output", o->output, "file; default: standard output");
  sub->callback([o, &common] { common.run = [o, &common](JobClient& c) { return history(c, o->job, o->output, common.json); }; });

  sub = app.add_subcommand("stages", "table by stage: cells, steps, CPU seconds by phase, mapping, amplitudes");
  sub->add_option("JOB", o->job, "uid or latest");
  sub->callback([o, &common] {
    common.run = [o, &common](JobClient& c) {
      const auto stages = c.stages(c.resolve(o->job));
      std::printf("%s", common.json ? (to_json(stages) + "\n").c_str() : report_text::stage_table(stages.stages()).c_str());
      return static_cast<int>(exit_ok);
    };
  });

  sub = app.add_subcommand("artifacts", "result files of a job");
  sub->add_option("JOB", o->job, "uid or latest");
  sub->callback([o, &common] {
    common.run = [o, &common](JobClient& c) {
      const auto list = c.artifacts(c.resolve(o->job));
      if (common.json) {
        std::printf("%s\n", to_json(list).c_str());
        return static_cast<int>(exit_ok);
      }
      std::vector<std::vector<std::string>> rows{{"name", "bytes", "type", "created"}};
      for (const v1::Artifact& a : list.artifacts())
        rows.push_back({a.name(), std::to_string(a.size_bytes()), a.media_type(), time_text(a.create_time())});
      std::fputs(report_text::align(rows).c_str(), stdout);
      return static_cast<int>(exit_ok);
    };
  });

  sub = app.add_subcommand("download", "one result file");
  sub->add_option("JOB", o->job, "uid or latest")->required();
  sub->add_option("ARTIFACT", o->artifact, "its name")->required();
  sub->add_option("-o,--output", o->output, "file, - for standard output; default: its name");
  sub->callback([o, &common] { common.run = [o](JobClient& c) { return download(c, o->job, o->artifact, o->output); }; });
}

}  // namespace seaway::client
