// SPDX-License-Identifier: GPL-3.0-or-later
// watch: many clients at once see every sample; clients that stop reading cost little.
// get_job: answers while the solver works.
#include <grpcpp/client_context.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
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

/// Gaps that `clients` watchers see until the run ends or `seconds` are over.
int count_gaps(const std::string& address, const v1::Job& job, int clients, double seconds) {
  std::atomic<int> gaps{0};
  std::atomic<bool> over{false};
  std::vector<std::unique_ptr<Stream>> streams;
  for (int i = 0; i < clients; ++i) streams.push_back(std::make_unique<Stream>(own_channel(address), job.name()));
  std::vector<std::jthread> threads;
  std::atomic<int> left{clients};
  for (auto& stream : streams)
    threads.emplace_back([&, s = stream.get()] {
      v1::WatchSamplesResponse m;
      std::int64_t last = 0;
      while (s->reader->Read(&m)) {
        if (!m.has_chunk()) continue;
        if (m.chunk().first_sequence() != last + 1) ++gaps;
        last = m.chunk().first_sequence() + m.chunk().times_s_size() - 1;
      }
      const auto status = s->reader->Finish();
      if (!status.ok() && !over) ++gaps;  // cut off
      --left;
    });
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  while (left > 0 && Clock::now() < deadline) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  over = true;
  for (auto& stream : streams) stream->context.TryCancel();
  return gaps;
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
  const int gaps = count_gaps(daemon.address(), job, s.clients, s.seconds);
  if (client.get(job.name()).state() == v1::Job::STATE_RUNNING) client.cancel(job.name());
  while (client.get(job.name()).state() < v1::Job::STATE_SUCCEEDED) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const double watching_cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  daemon.start();  // so that nothing the watchers have left behind is used again
  client.get(job.name());
  const double stalled = stalled_cost(daemon, job.name(), s.clients);
  const double cpu = cpu_seconds(daemon.process().pid());
  daemon.terminate();
  return {{"watch", "gaps", static_cast<double>(gaps), "1", 0, watching_cpu}, {"watch", "rss_mb", stalled, "MB", 5, cpu}};
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
