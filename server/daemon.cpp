// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/daemon.hpp"

#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "proto/yaml.hpp"
#include "server/config.hpp"
#include "server/http/metrics_listener.hpp"
#include "server/log.hpp"
#include "server/maintenance.hpp"
#include "server/metrics/metrics.hpp"
#include "server/readiness.hpp"
#include "server/standby_thread.hpp"

namespace seaway::server {
namespace {

constexpr unsigned longest_drain_s = 9;

void write_address(const std::string& file, const std::string& address) {
  const std::string aside = file + ".new";
  std::ofstream(aside) << address << "\n";
  if (std::rename(aside.c_str(), file.c_str()) != 0) fail(ErrorCode::unavailable, "cannot write {}", file);
}

int wait_for_signal() {
  sigset_t set;
  sigemptyset(&set);
  for (const int s : {SIGTERM, SIGINT}) sigaddset(&set, s);
  int signal = 0;
  while (sigwait(&set, &signal) != 0) {
  }
  return signal;
}

/// Ends the process if winding up takes too long: what runs is in the store, and the next start recovers it.
void watch_the_clock(const std::stop_token& stop, spdlog::logger& log) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  wake.wait_for(lock, stop, std::chrono::seconds(longest_drain_s), [] { return false; });
  if (stop.stop_requested()) return;
  log.warn("event=drain_too_long text=\"ending; the running jobs go on from their last checkpoint\"");
  log.flush();
  ::_exit(0);
}

rpc::ServerFacts facts_of(const Settings& settings, const std::shared_ptr<spdlog::logger>& log) {
  rpc::ServerFacts facts;
  facts.executor = settings.processes ? "process" : "thread";
  facts.workers = settings.pool.workers;
  facts.log_level = [log] {
    const auto name = spdlog::level::to_string_view(log->level());
    return name == "warning" ? std::string("warn") : std::string(name.data(), name.size());
  };
  facts.set_log_level = [log](const std::string& level) {
    if (!is_log_level(level)) return false;
    log->set_level(spdlog::level::from_str(level));
    return true;
  };
  return facts;
}

/// What Prometheus reads beside the counters.
metrics::Levels levels_now(const Settings& settings, const store::JobStore& store, const rpc::Server& server) {
  metrics::Levels out;
  for (int state = static_cast<int>(store::State::queued); state <= static_cast<int>(store::State::cancelled); ++state)
    out.jobs[std::string(store::to_string(static_cast<store::State>(state)))] = 0;
  for (const auto& [state, n] : store.counts()) out.jobs[std::string(store::to_string(state))] = static_cast<double>(n);
  out.streams = {{"samples", 0}, {"jobs", 0}, {"download", 0}};
  const rpc::Census census = server.census();
  for (auto& [kind, n] : out.streams)
    if (const auto found = census.kinds.find(kind); found != census.kinds.end()) n = found->second;
  out.stream_lag = static_cast<double>(census.largest_lag);
  std::error_code error;
  const auto wal = std::filesystem::file_size(settings.data_dir + "/seaway.db-wal", error);
  if (!error) out.wal_bytes = static_cast<double>(wal);
  const auto space = std::filesystem::space(settings.data_dir, error);
  if (!error) out.disk_free_bytes = static_cast<double>(space.available);
  return out;
}

/// Three dozen threads that mostly wait would each keep an arena of its own, three times the memory that is in use.
void limit_arenas() { ::mallopt(M_ARENA_MAX, 2); }

/// Once a minute: deletes what is older than it has to be kept, and gives memory back that a burst has left.
void keep_house(const std::stop_token& stop, const Settings& settings, jobs::Queue& queue, store::JobStore& store,
                spdlog::logger& log) {
  constexpr std::int64_t day = 86'400'000'000'000;
  constexpr std::int64_t tombstone_days = 30;
  std::mutex mutex;
  std::condition_variable_any wake;
  for (;;) {
    try {
      const auto now = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
      if (settings.keep_days > 0)
        if (const int n = queue.expire(now - static_cast<std::int64_t>(settings.keep_days * day)); n > 0)
          log.info("event=expired jobs={}", n);
      if (const int n = queue.sweep_files(std::chrono::hours(1)); n > 0) log.info("event=swept files={}", n);
      store.prune(settings.keep_changes, now - tombstone_days * day);
    } catch (const std::exception& error) {
      log.warn("event=keep_house text=\"{}\"", error.what());
    }
    ::malloc_trim(0);
    std::unique_lock lock(mutex);
    wake.wait_for(lock, stop, std::chrono::minutes(1), [] { return false; });
    if (stop.stop_requested()) return;
  }
}

void serve(Settings settings, const std::string& address_file, const jobs::Solver& solver,
           const std::shared_ptr<spdlog::logger>& log) {
  metrics::Metrics metrics;
  settings.worker.run.metrics = settings.pool.metrics = &metrics;
  jobs::Workspace workspace(settings.data_dir);
  store::SqliteOptions options;
  options.path = settings.data_dir + "/seaway.db";
  options.commit_interval = std::chrono::milliseconds(settings.commit_interval_ms);
  options.warn = [log](const std::string& text) { log->warn("event=store text=\"{}\"", text); };
  options.committed = [&metrics](double seconds) { metrics.committed(seconds); };
  options.sync_failed = [log] {
    log->critical("event=sync_failed text=\"the disk lost data that it had taken; look at it, then start again: jobs go on from what it holds\"");
    log->flush();
    ::_exit(1);  // nothing here may write any more; the workers die with us
  };
  const auto store = store::open_sqlite_store(std::move(options));
  const store::Recovery recovery = store->recover(settings.max_stalled_attempts);
  metrics.recovered(static_cast<int>(recovery.requeued.size()));
  for (const auto& uid : recovery.requeued) log->info("job={} event=recovered state=QUEUED", uid);
  for (const auto& uid : recovery.cancelled) log->info("job={} event=recovered state=CANCELLED", uid);
  for (const auto& uid : recovery.failed) log->warn("job={} event=recovered state=FAILED", uid);
  const auto executor = settings.processes
                            ? jobs::make_process_executor(settings.worker, workspace, *store, log)
                            : jobs::make_thread_executor(settings.worker.run, solver, workspace, *store, log);
  jobs::WorkerPool pool(settings.pool, *executor, workspace, *store, log);
  jobs::Queue queue(settings.limits, solver, workspace, *store, [&pool] { pool.wake(); },
                    [&pool](const std::string& uid) { pool.request_stop(uid); },
                    [&pool](const std::string& uid) { pool.request_kill(uid); });
  rpc::ServerSettings rpc_settings = settings.rpc;
  rpc_settings.facts = facts_of(settings, log);
  rpc::Server server(rpc_settings, queue, *store);
  const std::jthread keeper([&](const std::stop_token& stop) { keep_house(stop, settings, queue, *store, *log); });
  std::optional<http::MetricsListener> listener;
  if (settings.metrics_port >= 0) {
    listener.emplace(settings.metrics_address, settings.metrics_port,
                     [&] { return metrics.text(levels_now(settings, *store, server)); });
    log->info("event=metrics address={}", listener->address());
  }
  StandbyThread clock([log](const std::stop_token& stop) { watch_the_clock(stop, *log); });
  StandbyThread draining([&pool](const std::stop_token&) { pool.drain(); });
  pool.start();  // not before it listens: a server that cannot start takes no job
  if (!address_file.empty()) write_address(address_file, server.address());
  log->info("event=listening address={} data_dir={} executor={} workers={} threads={} version={}", server.address(),
            settings.data_dir, settings.processes ? "process" : "thread", settings.pool.workers,
            settings.worker.run.threads, code_version());
  notify_manager("READY=1");
  const int signal = wait_for_signal();
  notify_manager("STOPPING=1");
  log->info("event=stopping signal={}", signal);
  clock.go();
  listener.reset();
  draining.go();
  server.shutdown();
  draining.join();
  store->flush();
  log->info("event=stopped");
}

}  // namespace

void block_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int s : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&set, s);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  ::signal(SIGPIPE, SIG_IGN);
}

int run_daemon(int argc, char** argv, const jobs::Solver& solver, bool processes) {
  block_signals();
  limit_arenas();
  CLI::App app{"seawayd: runs simulations of ships in waves and keeps their results", "seawayd"};
  Flags flags;
  std::string address_file;
  app.add_option("-c,--config", flags.config_file, "configuration file (YAML; see seaway/v1/server_config.proto)");
  app.add_option("--data-dir", flags.data_dir, "folder of database, files and runs");
  app.add_option("--listen", flags.listen, "loopback address or unix:/path");
  app.add_option("--port", flags.port, "0: any free port");
  app.add_option("--log-level", flags.log_level, "trace, debug, info, warn, error");
  app.add_option("--address-file", address_file, "written with the address once the server listens");
  app.set_version_flag("--version", std::string(code_version()));
  std::string backup_file;
  app.require_subcommand(0, 1);
  app.fallthrough();
  CLI::App* backing_up = app.add_subcommand("backup", "copy the database to a new file, also while a server runs");
  backing_up->add_option("FILE", backup_file, "must not exist")->required();
  CLI::App* verifying = app.add_subcommand("verify", "read the whole database and say what is wrong with it");
  int audit_rows = 100;
  bool only_denied = false;
  CLI::App* auditing = app.add_subcommand("audit", "who has changed what, and who was turned away");
  auditing->add_option("-n,--limit", audit_rows, "the last so many")->check(CLI::Range(1, 1'000'000))->capture_default_str();
  auditing->add_flag("--denied", only_denied, "only calls that were denied");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    flags.processes = processes;
    const Settings settings = load_settings(flags);
    if (backing_up->parsed()) return backup(settings.data_dir, backup_file);
    if (verifying->parsed()) return verify(settings.data_dir);
    if (auditing->parsed()) return audit(settings.data_dir, audit_rows, only_denied);
    const auto log = make_log(settings.log_file, settings.log_level);
    try {
      serve(settings, address_file, solver, log);
      return 0;
    } catch (const Error& error) {
      log->error("event=failed text=\"{}\"", error.what());
      return error.code() == ErrorCode::invalid_argument ? 2 : 1;
    }
  } catch (const yaml::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seawayd: %s\n", error.what());
    return 1;
  }
}

}  // namespace seaway::server
