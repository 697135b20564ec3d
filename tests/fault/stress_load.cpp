// SPDX-License-Identifier: GPL-3.0-or-later
// submit, list, boot: latencies with many clients and many jobs. shutdown: how long SIGTERM takes under load.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include "server/store/database.hpp"
#include "server/store/migrations.hpp"
#include "tests/fault/stress.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point t) { return std::chrono::duration<double, std::milli>(Clock::now() - t).count(); }

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

/// A database as after `jobs` jobs, all ended but one in ten, which is held.
void fill_database(const std::string& folder, int jobs) {
  std::filesystem::create_directories(folder + "/data");
  store::Database db(folder + "/data/seaway.db", store::Database::Role::writer);
  store::migrate(db);
  db.execute("BEGIN");
  db.prepare("INSERT INTO jobs (uid, request_id, title, state, digest, code_version, created_ns, updated_ns, ended_ns) "
             "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < ?) "
             "SELECT 'job' || i, 'request' || i, 'Section ' || i, CASE WHEN i % 10 = 0 THEN 2 ELSE 5 END, "
             "hex(randomblob(32)), '0.1.0', i, i, CASE WHEN i % 10 = 0 THEN 0 ELSE i END FROM n")
      .bind(jobs)
      .run();
  db.execute("INSERT INTO case_specs SELECT digest, randomblob(900) FROM jobs");
  db.execute("INSERT INTO case_uses SELECT digest, 1 FROM jobs");
  db.execute("INSERT INTO events (job, time_ns, attempt, kind, text) SELECT id, id, 1, 'STATE', 'QUEUED' FROM jobs");
  db.execute("INSERT INTO changes (uid, kind, state, time_ns) SELECT uid, 'CREATED', 1, id FROM jobs");
  db.execute("COMMIT");
}

}  // namespace

namespace {

/// What this disk takes for a sync alone: 12 KiB appended to a file, one after the other [ms].
std::vector<double> sync_times(const std::string& file) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  const std::string bytes(12 * 1024, 'x');
  std::vector<double> out;
  for (int i = 0; i < 300; ++i) {
    const auto began = Clock::now();
    if (::write(fd, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()) || ::fdatasync(fd) != 0)
      throw std::runtime_error("submit: the disk refuses");
    out.push_back(ms_since(began));
  }
  ::close(fd);
  return out;
}

/// Eight clients submit for so long; how long each submit took [ms]. `distinct`: no two cases are the same.
std::vector<double> submit_times(const std::string& address, const v1::CreateJobRequest& pattern, bool distinct, std::chrono::seconds time) {
  constexpr int clients = 8;
  const auto until = Clock::now() + time;
  std::vector<std::vector<double>> ms(clients);
  {
    std::vector<std::jthread> threads;
    for (int k = 0; k < clients; ++k)
      threads.emplace_back([&, k, &mine = ms[static_cast<std::size_t>(k)]] {
        client::JobClient client(own_channel(address));
        v1::CreateJobRequest request = pattern;
        request.set_start_held(true);  // nothing runs beside it
        while (Clock::now() < until) {
          request.set_request_id(client::new_request_id());
          if (distinct) request.mutable_case_()->set_title("Client " + std::to_string(k) + ", case " + std::to_string(mine.size()));
          const auto sent = Clock::now();
          client.create(request);
          mine.push_back(ms_since(sent));
        }
      });
  }
  std::vector<double> all;
  for (const auto& mine : ms) all.insert(all.end(), mine.begin(), mine.end());
  return all;
}

}  // namespace

std::vector<Line> submit(const Settings& s) {
  const testing::TempFolder folder;
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  const v1::CreateJobRequest pattern = request_of(s.case_file);
  constexpr std::chrono::seconds time{5};
  const auto syncs = sync_times(folder / "sync");
  const auto all = submit_times(daemon.address(), pattern, false, time);
  const double cpu = cpu_seconds(daemon.process().pid());
  const auto distinct = submit_times(daemon.address(), pattern, true, time);
  const double cpu_distinct = cpu_seconds(daemon.process().pid()) - cpu;
  std::fprintf(stderr, "submit: %zu durable submits of one case, %zu of different ones, %lld s each\n", all.size(), distinct.size(),
               static_cast<long long>(time.count()));
  daemon.terminate();
  const auto per_s = [&](const std::vector<double>& times) { return static_cast<double>(times.size()) / static_cast<double>(time.count()); };
  Line rate{"submit", "per_s", per_s(all), "1/s", 2000, cpu};
  rate.at_least = true;
  std::vector<Line> out{{"submit", "p50_ms", quantile(all, 0.5), "ms", 2, cpu}, {"submit", "p99_ms", quantile(all, 0.99), "ms", 20, cpu}, rate};
  for (const auto& [quantity, value] : {std::pair{"distinct_p50_ms", quantile(distinct, 0.5)}, {"distinct_p99_ms", quantile(distinct, 0.99)},
                                        {"distinct_per_s", per_s(distinct)}, {"fdatasync_p50_ms", quantile(syncs, 0.5)},
                                        {"fdatasync_p99_ms", quantile(syncs, 0.99)}})
    out.push_back({"submit", quantity, value, std::string(quantity).ends_with("_s") ? "1/s" : "ms", 0, cpu_distinct, false, true});
  return out;
}

std::vector<Line> list(const Settings& s) {
  const testing::TempFolder folder;
  fill_database(folder.path(), 100'000);
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  client::JobClient client(daemon.address());
  v1::ListJobsRequest request;
  request.set_page_size(1000);
  std::vector<std::string> places{""};
  do {
    request.set_page_token(client.list(request).next_page_token());
    if (!request.page_token().empty()) places.push_back(request.page_token());
  } while (!request.page_token().empty());
  if (places.size() < 100) throw std::runtime_error("list: the jobs are not there");
  request.set_page_size(100);
  std::vector<double> ms;
  for (int round = 0; round < 5; ++round)
    for (const std::string& place : places) {
      request.set_page_token(place);
      const auto sent = Clock::now();
      client.list(request);
      ms.push_back(ms_since(sent));
    }
  const double cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  return {{"list", "p99_ms", quantile(ms, 0.99), "ms", 15, cpu}};
}

std::vector<Line> boot(const Settings& s) {
  const testing::TempFolder folder;
  fill_database(folder.path(), 100'000);
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  auto request = request_of(s.case_file);
  request.set_start_held(true);
  client::JobClient(daemon.address()).create(request);
  daemon.kill();  // the next start has a log to recover and checks the file
  const auto began = Clock::now();
  daemon.start();
  client::JobClient(daemon.address()).list({});
  const double seconds = 1e-3 * ms_since(began);
  const double cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  return {{"boot", "ready_s", seconds, "s", 3, cpu}};
}

std::vector<Line> shutdown(const Settings& s) {
  const testing::TempFolder folder;
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  double worst = 0;
  for (int round = 0; round < s.rounds; ++round) {
    daemon.start();
    client::JobClient client(daemon.address());
    const std::string job = client.create(request_of(s.case_file)).job().name();
    std::atomic<int> open{0};
    {
      std::vector<std::jthread> threads;
      for (int i = 0; i < s.clients; ++i)
        threads.emplace_back([&] {
          client::JobClient watcher(own_channel(daemon.address()));
          bool counted = false;
          watcher.watch(job, 0, [&](const auto&) {
            if (!std::exchange(counted, true)) ++open;
            return true;
          });
          if (!counted) ++open;
        });
      while (open < s.clients) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      while (client.get(job).latest_sequence() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      const auto asked = Clock::now();
      if (daemon.terminate() != 0) throw std::runtime_error("shutdown: the server did not end well");
      worst = std::max(worst, 1e-3 * ms_since(asked));
    }
    daemon.start();  // the job has gone on or is cancelled: the next round begins with an empty queue
    client::JobClient(daemon.address()).cancel(job);
    if (daemon.terminate() != 0) throw std::runtime_error("shutdown: the server did not end well");
  }
  return {{"shutdown", "worst_s", worst, "s", 10, 0}};
}

}  // namespace seaway::stress
