// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/config.hpp"

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "proto/yaml.hpp"
#include "seaway/v1/server_config.pb.h"
#include "server/log.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::server {
namespace {

using ::testing::HasSubstr;

const std::string deploy = SEAWAY_SOURCE_DIR "/deploy/";

std::string text_of(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// All that a configuration sets, but the folder and the program.
std::string summary(const Settings& s) {
  const auto ms = [](std::chrono::milliseconds t) { return static_cast<long long>(t.count()); };
  return fmt::format("{} {} | {} '{}' | {} {} {} {} | {} {} {} {} {} | {} {} {} | {} {} {} | {} {} {} {} | '{}' '{}' '{}' {} | {} {}", s.rpc.address,
                     s.rpc.port, s.log_level, s.log_file, s.commit_interval_ms, s.keep_days, s.keep_changes, s.max_stalled_attempts,
                     s.pool.workers, s.pool.max_faults, s.processes, s.worker.run.threads, s.worker.run.checkpoint_interval_s,
                     ms(s.worker.lease), ms(s.worker.stall), ms(s.worker.stop_grace), s.worker.limits.memory_bytes,
                     ms(s.worker.limits.wall), s.worker.limits.disk_bytes, s.limits.queued_jobs, s.limits.job_cpu_s, s.rpc.max_streams, s.rpc.max_streams_per_caller,
                     s.rpc.access.certificate, s.rpc.access.key, s.rpc.access.client_ca, s.rpc.access.principals.size(),
                     s.metrics_address, s.metrics_port);
}

TEST(Config, TheSampleHoldsEveryDefault) {
  Flags file;
  file.config_file = deploy + "seawayd.yaml";
  EXPECT_EQ(summary(load_settings(file)), summary(load_settings({})));
}

TEST(Config, TheSampleForOthersIsTaken) {
  Flags file;
  file.config_file = deploy + "seawayd-tls.yaml";
  const Settings s = load_settings(file);
  EXPECT_EQ(s.rpc.access.principals.size(), 2u);
  EXPECT_EQ(s.worker.limits.memory_bytes, 8'000'000'000);
}

void names_below(const google::protobuf::Descriptor& type, std::vector<std::string>& out) {
  for (int i = 0; i < type.field_count(); ++i) {
    out.push_back(type.field(i)->name());
    if (type.field(i)->message_type() != nullptr) names_below(*type.field(i)->message_type(), out);
  }
}

TEST(Config, EveryFieldStandsInASample) {
  std::vector<std::string> names;
  names_below(*v1::ServerConfig::descriptor(), names);
  const std::string samples = text_of(deploy + "seawayd.yaml") + text_of(deploy + "seawayd-tls.yaml");
  ASSERT_GT(names.size(), 40u);
  for (const std::string& name : names) EXPECT_THAT(samples, HasSubstr(name + ":"));
}

struct Wrong {
  const char* section;
  const char* field;
  const char* value;
};

TEST(Config, WrongValuesAreNamedWithTheirLine) {
  const testing::TempFolder folder;
  for (const Wrong& w : {Wrong{"listen", "port", "70000"}, {"listen", "port", "-1"}, {"storage", "commit_interval_ms", "0"},
                         {"storage", "keep_days", "-1"}, {"storage", "keep_changes", "10"}, {"workers", "count", "0"},
                         {"workers", "count", "65"}, {"workers", "threads", "0"}, {"workers", "checkpoint_interval_s", "-1"},
                         {"workers", "max_attempts_without_progress", "0"}, {"workers", "max_faults", "0"},
                         {"workers", "stall_timeout_s", "0"}, {"workers", "lease_s", "0"}, {"workers", "stop_grace_s", "-1"},
                         {"workers", "memory_mb", "-1"}, {"workers", "wall_s", "-1"}, {"workers", "disk_mb", "-1"},
                         {"workers", "executor", "slurm"}, {"limits", "queued_jobs", "0"}, {"limits", "streams", "0"}, {"limits", "streams_per_caller", "0"},
                         {"limits", "job_cpu_s", "-1"}, {"metrics", "port", "65536"}, {"logging", "level", "loud"},
                         {"workers", "lease_s", "30 s"}, {"workers", "memory", "8000"}, {"storage", "keep_days", ".nan"}}) {
    Flags flags;
    flags.config_file = folder / "config.yaml";
    std::ofstream(flags.config_file) << "# a configuration\n" << w.section << ":\n  " << w.field << ": " << w.value << "\n";
    try {
      load_settings(flags);
      ADD_FAILURE() << w.field << ": " << w.value << " was taken";
    } catch (const yaml::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(flags.config_file + ":3:"));
      EXPECT_THAT(error.what(), HasSubstr(w.field));
    }
  }
}

TEST(Config, WrongPrincipalsAreNamed) {
  const testing::TempFolder folder;
  const std::string digest(64, 'a');
  const auto why = [&](const std::string& principal) -> std::string {
    Flags flags;
    flags.config_file = folder / "config.yaml";
    std::ofstream(flags.config_file) << "security:\n  principals:\n    - " << principal << "\n";
    try {
      load_settings(flags);
    } catch (const yaml::InputError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_EQ(why("{name: ada, role: admin, token_sha256: " + digest + "}"), "taken");
  EXPECT_THAT(why("{role: admin, token_sha256: " + digest + "}"), HasSubstr("principals[0].name"));
  EXPECT_THAT(why("{name: ada, token_sha256: " + digest + "}"), HasSubstr("principals[0].role"));
  EXPECT_THAT(why("{name: ada, role: root, token_sha256: " + digest + "}"), HasSubstr("role"));
  EXPECT_THAT(why("{name: ada, role: admin}"), HasSubstr("needs either token_sha256 or subject"));
  EXPECT_THAT(why("{name: ada, role: admin, subject: ada, token_sha256: " + digest + "}"), HasSubstr("needs either"));
  EXPECT_THAT(why("{name: ada, role: admin, token_sha256: my-secret}"), HasSubstr("is no SHA-256"));
}

TEST(Log, AMessageIsOneLineWhateverItsText) {
  const testing::TempFolder folder;
  const auto log = make_log(folder / "log", "info");
  log->warn("text=\"{}\"", "it failed\n2026-01-01 level=info all is well\x1b[2J, \u00fcberall");
  log->debug("not shown");
  log->flush();
  const std::string text = text_of(folder / "log");
  EXPECT_THAT(text, ::testing::EndsWith(" level=warning text=\"it failed\\n2026-01-01 level=info all is well\\x1b[2J, \u00fcberall\"\n"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

}  // namespace
}  // namespace seaway::server
