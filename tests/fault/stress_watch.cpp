// SPDX-License-Identifier: GPL-3.0-or-later
// watch: many clients at once see every sample; clients that stop reading cost little.
// get_job: answers while the solver works.
#include <grpcpp/client_context.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "tests/fault/stress.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

using Clock = std::chrono::steady_clock;

struct Stream {
  std::shared_ptr<grpc::Channel> channel;
  std::unique_ptr<v1::Telemetry::Stub> stub;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReader<v1::WatchSamplesResponse>> reader;

  Stream(std::shared_ptr<grpc::Channel> to, const std::string& job) : channel(std::move(to)), stub(v1::Telemetry::NewStub(channel)) {
    v1::WatchSamplesRequest request;
    request.set_job(job);
    reader = stub->WatchSamples(&context, request);
  }
};

struct Watched {
  std::atomic<int> gaps{0};
  double server_cores = 0, rss_mb = 0;
  std::vector<double> latency_ms;  ///< of samples with a clock (SEAWAY_FAKE_CLOCK)
};

/// What `clients` watchers see until the run ends or `seconds` are over.
void follow(const testing::Daemon& daemon, const v1::Job& job, int clients, double seconds, Watched& out) {
  std::atomic<bool> over{false};
  std::vector<std::unique_ptr<Stream>> streams;
  for (int i = 0; i < clients; ++i) streams.push_back(std::make_unique<Stream>(own_channel(daemon.address()), job.name()));
  std::vector<std::vector<double>> latencies(streams.size());
  std::vector<std::jthread> threads;
  std::atomic<int> left{clients}, ready{0};
  for (std::size_t i = 0; i < streams.size(); ++i)
    threads.emplace_back([&, s = streams[i].get(), mine = &latencies[i]] {
      v1::WatchSamplesResponse m;
      std::int64_t last = 0;
      int clock = -1;
      while (s->reader->Read(&m)) {
        if (m.has_header()) {
          if (last == 0 && clock < 0) ++ready;
          for (int c = 0; c < m.header().channels_size(); ++c)
            if (m.header().channels(c).name() == "clock") clock = c;
        }
        if (!m.has_chunk()) continue;
        if (m.chunk().first_sequence() != last + 1) ++out.gaps;
        last = m.chunk().first_sequence() + m.chunk().times_s_size() - 1;
        const double now = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
        if (clock >= 0)
          for (const double written : m.chunk().columns(clock).values()) mine->push_back(1e3 * (now - written));
      }
      const auto status = s->reader->Finish();
      if (!status.ok() && !over) ++out.gaps;  // cut off
      --left;
    });
  while (ready < clients && left == clients) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const auto began = Clock::now();
  const double cpu = cpu_seconds(daemon.process().pid());
  const auto deadline = began + std::chrono::duration<double>(seconds);
  while (left > 0 && Clock::now() < deadline) {
    out.rss_mb = std::max(out.rss_mb, static_cast<double>(daemon.process().resident_bytes()) / 1e6);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  out.server_cores = (cpu_seconds(daemon.process().pid()) - cpu) / std::chrono::duration<double>(Clock::now() - began).count();
  over = true;
  for (auto& stream : streams) stream->context.TryCancel();
  threads.clear();
  for (const auto& mine : latencies) out.latency_ms.insert(out.latency_ms.end(), mine.begin(), mine.end());
}

void end_job(client::JobClient& client, const std::string& job) {
  try {
    client.kill(job);
  } catch (const client::RpcError& error) {
    if (error.status() != grpc::StatusCode::FAILED_PRECONDITION) throw;  // it has ended by itself
  }
}

/// Growth of the server [MB] by connected clients that open a stream and stop reading it.
double stalled_cost(const testing::Daemon& daemon, const std::string& job, int clients) {
  const auto resident = [&] { return static_cast<double>(daemon.process().resident_bytes()) / 1e6; };
  std::vector<std::shared_ptr<grpc::Channel>> channels;
  for (int i = 0; i < clients; ++i) {
    channels.push_back(own_channel(daemon.address()));
    channels.back()->WaitForConnected(std::chrono::system_clock::now() + std::chrono::seconds(10));
  }
  const double before = resident();
  std::vector<std::unique_ptr<Stream>> streams;
  for (const auto& channel : channels) streams.push_back(std::make_unique<Stream>(channel, job));
  double most = 0;
  const auto deadline = Clock::now() + std::chrono::seconds(5);
  while (Clock::now() < deadline) {
    most = std::max(most, resident());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  for (auto& stream : streams) {
    stream->context.TryCancel();
    stream->reader->Finish();
  }
  return most - before;
}

}  // namespace

std::vector<Line> watch(const Settings& s) {
  const testing::TempFolder folder;
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  client::JobClient client(daemon.address());
  const v1::Job job = client.create(request_of(s.case_file)).job();
  Watched seen;
  follow(daemon, job, s.clients, s.seconds, seen);
  end_job(client, job.name());
  while (client.get(job.name()).state() < v1::Job::STATE_SUCCEEDED) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const double cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  std::vector<Line> out{{"watch", "gaps", static_cast<double>(seen.gaps), "1", 0, cpu},
                        {"watch", "server_cores", seen.server_cores, "1", 0.6, cpu},
                        {"watch", "rss_mb", seen.rss_mb, "MB", 150, cpu}};
  if (!seen.latency_ms.empty()) {
    auto middle = seen.latency_ms.begin() + static_cast<std::ptrdiff_t>(seen.latency_ms.size() / 2);
    std::nth_element(seen.latency_ms.begin(), middle, seen.latency_ms.end());
    out.push_back({"watch", "latency_p50_ms", *middle, "ms", 300, cpu});
  }
  return out;
}

std::vector<Line> slow_clients(const Settings& s) {
  const testing::TempFolder folder;
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  client::JobClient client(daemon.address());
  const std::string job = client.create(request_of(s.case_file)).job().name();
  while (client.get(job).latest_sequence() < 300) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  end_job(client, job);
  daemon.terminate();
  daemon.start();  // so that nothing that was used before is used again
  client.get(job);
  const double stalled = stalled_cost(daemon, job, 100);
  const double cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  return {{"slow_clients", "rss_mb_per_100", stalled, "MB", 5, cpu}};
}

/// Waits for the end of a run of so many samples; only a solver that makes them in no time has them within `seconds`.
void wait_for_samples(client::JobClient& client, const std::string& job, std::int64_t samples, double seconds) {
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  v1::Job now = client.get(job);
  for (; now.state() < v1::Job::STATE_SUCCEEDED && Clock::now() < deadline; now = client.get(job))
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  if (now.state() < v1::Job::STATE_SUCCEEDED)
    throw std::runtime_error("catch_up: " + std::to_string(now.latest_sequence()) + " of " + std::to_string(samples) + " samples after " +
                             std::to_string(std::llround(seconds)) + " s; give the stand-in (--seawayd, --seaway-run) or more --seconds");
  if (now.latest_sequence() != samples) throw std::runtime_error("catch_up: the run has another number of samples");
}

/// An hour at 50 Hz.
std::vector<Line> catch_up(const Settings& s) {
  const testing::TempFolder folder;
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  client::JobClient client(daemon.address());
  auto request = request_of(s.case_file);
  auto& stages = *request.mutable_case_()->mutable_cascade()->mutable_stages();
  const double dt = request.case_().time().dt_s();
  for (auto& stage : stages) stage.mutable_end()->mutable_time()->set_duration_s(180'000 * dt / stages.size());
  const std::string job = client.create(request).job().name();
  wait_for_samples(client, job, 180'000, s.seconds);
  std::int64_t last = 0;
  const auto began = Clock::now();
  client.watch(job, 0, [&](const v1::WatchSamplesResponse& m) {
    if (m.has_chunk()) last = m.chunk().first_sequence() + m.chunk().times_s_size() - 1;
    return last < 180'000;
  });
  const double took = std::chrono::duration<double>(Clock::now() - began).count();
  v1::ReadEnvelopeRequest whole;
  whole.set_job(job);
  whole.set_max_points(2000);
  const auto asked = Clock::now();
  const int points = client.envelope(whole).times_s_size();
  std::fprintf(stderr, "catch_up: the same as %d points in %.1f ms\n", points,
               std::chrono::duration<double, std::milli>(Clock::now() - asked).count());
  const double cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  return {{"watch", "catch_up_s", took, "s", 1, cpu}};
}

std::vector<Line> get_job(const Settings& s) {
  const testing::TempFolder folder;
  testing::Daemon daemon(s.seawayd, folder.path(), {}, daemon_arguments(s, folder.path()));
  daemon.start();
  client::JobClient client(daemon.address());
  const v1::Job job = client.create(request_of(s.case_file)).job();
  while (client.get(job.name()).latest_sequence() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::vector<double> ms;
  const auto deadline = Clock::now() + std::chrono::seconds(20);
  while (Clock::now() < deadline) {
    const auto began = Clock::now();
    const v1::Job now = client.get(job.name(), v1::JOB_VIEW_FULL);
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - began).count());
    if (now.state() != v1::Job::STATE_RUNNING) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const double cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  std::sort(ms.begin(), ms.end());
  const auto at = static_cast<std::size_t>(0.99 * static_cast<double>(ms.size() - 1));
  return {{"get_job", "p99_ms", ms[at], "ms", 5, cpu}};
}

}  // namespace seaway::stress
