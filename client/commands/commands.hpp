// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of `seaway`. Each adds itself to the program's options; what it shall do when it was chosen
// ends up in `run`, which returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "client/job_client.hpp"

namespace seaway::client {

/// Options that all commands share.
struct Common {
  std::string server = "127.0.0.1:7411";
  Credentials credentials;
  std::string token_file;
  bool json = false;
  std::function<int(JobClient&)> run;  ///< of the command that was chosen
};

void add_submit(CLI::App& app, Common& common);     // submit, validate
void add_watch(CLI::App& app, Common& common);      // watch
void add_jobs(CLI::App& app, Common& common);       // list, show, cancel, delete
void add_job_life(CLI::App& app, Common& common);   // hold, release, kill, retry, label, note, priority, events, server
void add_results(CLI::App& app, Common& common);    // history, stages, artifacts, download
void add_reports(CLI::App& app, Common& common);    // decay, rao
void add_sweep(CLI::App& app, Common& common);      // sweep, sweeps
void add_plot(CLI::App& app, Common& common);       // plot

/// First line of the file. Throws ClientError.
std::string read_token(const std::string& file);
/// KEY=VALUE; throws ClientError for anything else.
std::pair<std::string, std::string> parse_label(const std::string& text);

/// Follows a job to its end and prints its stages; the exit code says how it ended.
int follow(JobClient& client, const std::string& name, std::int64_t after, bool json, double give_up_s);

/// A state as a person reads it: running.
std::string state_text(v1::Job::State state);
/// Why, with the message: DIVERGED: the speed ...
std::string reason_text(v1::Job::Reason reason, const std::string& message);
std::string time_text(const google::protobuf::Timestamp& time);

}  // namespace seaway::client
