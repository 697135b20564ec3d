// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/config.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <thread>

#include "proto/yaml.hpp"
#include "seaway/v1/server_config.pb.h"
#include "server/convert/checker.hpp"

namespace seaway::server {
namespace {

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(1000 * seconds));
}

/// Executor and limits of the workers.
void read_worker(const v1::Workers& m, const Flags& flags, convert::Checker& check, Settings& s) {
  constexpr std::int64_t megabyte = 1'000'000;
  jobs::ProcessSettings& w = s.worker;
  s.processes = flags.processes;
  if (m.has_executor()) s.processes = m.executor() != v1::Workers::EXECUTOR_THREAD;
  w.program = m.has_program() ? m.program() : (std::filesystem::canonical("/proc/self/exe").parent_path() / "seaway-run").string();
  if (m.has_max_faults()) s.pool.max_faults = check.count("workers.max_faults", m.max_faults(), 1, 1000);
  if (m.has_stall_timeout_s())
    w.stall = milliseconds(check.number("workers.stall_timeout_s", m.stall_timeout_s(), {1, 86400}));
  if (m.has_lease_s()) w.lease = milliseconds(check.number("workers.lease_s", m.lease_s(), {1, 600}));
  if (m.has_stop_grace_s()) w.stop_grace = milliseconds(check.number("workers.stop_grace_s", m.stop_grace_s(), {0, 3600}));
  if (m.has_memory_mb()) w.limits.memory_bytes = megabyte * check.count("workers.memory_mb", m.memory_mb(), 0, 100'000'000);
  if (m.has_wall_s()) w.limits.wall = milliseconds(check.number("workers.wall_s", m.wall_s(), {0, 1e9}));
  if (m.has_disk_mb()) w.limits.disk_bytes = megabyte * check.count("workers.disk_mb", m.disk_mb(), 0, 100'000'000);
}

/// Who may do what.
void read_security(const v1::Security& m, convert::Checker& check, rpc::AccessSettings& s) {
  s.certificate = m.certificate();
  s.key = m.key();
  s.client_ca = m.client_ca();
  for (int i = 0; i < m.principals_size(); ++i) {
    const v1::Principal& p = m.principals(i);
    const std::string field = "security.principals[" + std::to_string(i) + "]";
    const auto hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
    if (p.name().empty()) check.problem(field + ".name", "is missing", "it stands in the audit trail");
    if (p.role() == v1::Principal::ROLE_UNSPECIFIED) check.problem(field + ".role", "is missing", "allowed are viewer, submitter, admin");
    if (p.token_sha256().empty() == p.subject().empty())
      check.problem(field, "needs either token_sha256 or subject", "a token or a client certificate, not both");
    if (!p.token_sha256().empty() &&
        (p.token_sha256().size() != 64 || !std::all_of(p.token_sha256().begin(), p.token_sha256().end(), hex)))
      check.problem(field + ".token_sha256", "is no SHA-256", "64 lower-case hexadecimal digits: printf %s TOKEN | sha256sum");
    s.principals.push_back({p.name(), static_cast<rpc::Role>(p.role()), p.token_sha256(), p.subject()});
  }
}

constexpr std::array<std::string_view, 5> levels{"trace", "debug", "info", "warn", "error"};

}  // namespace

bool is_log_level(const std::string& word) { return std::find(levels.begin(), levels.end(), word) != levels.end(); }

Settings load_settings(const Flags& flags) {
  v1::ServerConfig m;
  yaml::SourceMap lines(flags.config_file);
  if (!flags.config_file.empty()) lines = yaml::read_file(flags.config_file, m);
  convert::Checker check;
  check.finite(m);
  Settings s;
  s.rpc.port = 7411;
  if (m.listen().has_address()) s.rpc.address = m.listen().address();
  if (m.listen().has_port()) s.rpc.port = check.count("listen.port", m.listen().port(), 0, 65535);
  if (m.storage().has_data_dir()) s.data_dir = m.storage().data_dir();
  if (m.storage().has_commit_interval_ms())
    s.commit_interval_ms = check.count("storage.commit_interval_ms", m.storage().commit_interval_ms(), 1, 10000);
  if (m.storage().has_keep_days()) s.keep_days = check.number("storage.keep_days", m.storage().keep_days(), {0, 36500});
  if (m.storage().has_keep_changes()) {
    s.keep_changes = m.storage().keep_changes();
    if (s.keep_changes < 1000 || s.keep_changes > 100'000'000)
      check.problem("storage.keep_changes", std::to_string(s.keep_changes) + " is not allowed", "must be 1000 to 100000000");
  }
  read_security(m.security(), check, s.rpc.access);
  read_worker(m.workers(), flags, check, s);
  if (m.workers().has_count()) s.pool.workers = check.count("workers.count", m.workers().count(), 1, 64);
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  s.worker.jobs = s.pool.workers;
  s.worker.run.threads = std::max(1, cores / std::max(1, s.pool.workers));
  if (m.workers().has_threads()) s.worker.run.threads = check.count("workers.threads", m.workers().threads(), 1, 256);
  if (m.workers().has_checkpoint_interval_s())
    s.worker.run.checkpoint_interval_s =
        check.number("workers.checkpoint_interval_s", m.workers().checkpoint_interval_s(), {0, 86400});
  if (m.workers().has_max_attempts_without_progress())
    s.max_stalled_attempts = check.count("workers.max_attempts_without_progress",
                                         m.workers().max_attempts_without_progress(), 1, 1000);
  if (m.limits().has_queued_jobs())
    s.limits.queued_jobs = check.count("limits.queued_jobs", m.limits().queued_jobs(), 1, 1'000'000);
  if (m.limits().has_streams()) s.rpc.max_streams = check.count("limits.streams", m.limits().streams(), 1, 100'000);
  if (m.limits().has_streams_per_caller())
    s.rpc.max_streams_per_caller = check.count("limits.streams_per_caller", m.limits().streams_per_caller(), 1, 100'000);
  if (m.limits().has_job_cpu_s())
    s.limits.job_cpu_s = check.number("limits.job_cpu_s", m.limits().job_cpu_s(), convert::not_negative);
  if (m.metrics().has_address()) s.metrics_address = m.metrics().address();
  if (m.metrics().has_port()) s.metrics_port = check.count("metrics.port", m.metrics().port(), 0, 65535);
  if (m.metrics().has_address() && !m.metrics().has_port())
    check.problem("metrics.port", "is missing", "give the port, or leave metrics out for no listener");
  if (m.logging().has_level()) s.log_level = m.logging().level();
  if (m.logging().has_file()) s.log_file = m.logging().file();
  if (!flags.data_dir.empty()) s.data_dir = flags.data_dir;
  if (!flags.listen.empty()) s.rpc.address = flags.listen;
  if (flags.port >= 0) s.rpc.port = check.count("--port", flags.port, 0, 65535);
  if (!flags.log_level.empty()) s.log_level = flags.log_level;
  if (!is_log_level(s.log_level))
    check.problem("logging.level", "'" + s.log_level + "' is unknown", "allowed are trace, debug, info, warn, error");
  if (s.data_dir.empty()) check.problem("storage.data_dir", "is empty", "name a folder");
  if (!check.ok()) {
    std::vector<yaml::Problem> problems;
    for (const auto& d : check.take()) problems.push_back({lines.find(d.field), d.field, d.message, d.hint});
    throw yaml::InputError(flags.config_file.empty() ? "options" : flags.config_file, std::move(problems));
  }
  return s;
}

}  // namespace seaway::server
