// SPDX-License-Identifier: GPL-3.0-or-later
// The promises of the service about streams: every sample once, in order, whatever happens to the connection.
#include <grpcpp/create_channel.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "tests/support/test_service.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using client::JobClient;

FakeOptions paused(std::int64_t steps) {
  FakeOptions fake;
  fake.allowed_steps = std::make_shared<std::atomic<std::int64_t>>(steps);
  return fake;
}

TEST(Watch, ResumesAfterAnySequence) {
  TestService service;
  JobClient client(service.server->address());
  const auto job = client.create(create_request(1, small_case(5))).job();
  Received got;
  for (int break_after = 1; got.mark.state() != v1::Job::STATE_SUCCEEDED; break_after = break_after * 2 + 1) {
    const std::int64_t until = got.last + break_after;
    client.watch(job.name(), got.last, [&](const auto& m) {
      got.take(m);
      return got.last < until;
    });
  }
  EXPECT_FALSE(got.gap);
  EXPECT_EQ(got.last, 1500);
}

TEST(Watch, GoesOnAcrossARestartOfTheServer) {
  rpc::ServerSettings settings;
  const FakeOptions fake = paused(100);
  TestService service(fake, settings);
  Received got;
  std::string name;
  {
    JobClient client(service.server->address());
    name = client.create(create_request(1, small_case())).job().name();
    std::jthread stopper([&] {
      wait_for_job(*service.store, name.substr(5), [](const auto& j) { return j.last_sequence == 100; });
      service.server->shutdown();
    });
    const auto status = client.watch(name, 0, [&](const auto& m) { got.take(m); return true; });
    EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
  }
  service.stop();
  *fake.allowed_steps = 1'000'000;
  service.start();
  JobClient client(service.server->address());
  EXPECT_TRUE(client.watch(name, got.last, [&](const auto& m) { got.take(m); return true; }).ok());
  EXPECT_FALSE(got.gap);
  EXPECT_EQ(got.last, 150);
  EXPECT_EQ(client.get(name).attempt(), 2);
}

TEST(Watch, HundredWatchersSeeNoGap) {
  const FakeOptions fake = paused(0);
  TestService service(fake);
  JobClient submitter(service.server->address());
  const auto job = submitter.create(create_request(1, small_case(5))).job();
  std::vector<Received> got(std::max(5, 100 / SEAWAY_SLOWDOWN));  // fewer under sanitizers: a stream that stands for a minute is cut
  std::atomic<int> connected{0};
  {
    std::vector<std::jthread> threads;
    for (auto& mine : got)
      threads.emplace_back([&] {
        JobClient client(service.server->address());
        client.watch(job.name(), 0, [&](const auto& m) {
          if (m.has_header() && mine.headers == 0 && ++connected == static_cast<int>(got.size())) *fake.allowed_steps = 1'000'000;
          mine.take(m);
          return true;
        });
      });
  }
  for (const auto& mine : got) {
    EXPECT_FALSE(mine.gap);
    EXPECT_EQ(mine.last, 1500);
    EXPECT_EQ(mine.heave, got.front().heave);
  }
}

TEST(Watch, ClientsThatDoNotReadDisturbNobody) {
  TestService service;
  JobClient client(service.server->address());
  const auto job = client.create(create_request(1, small_case(100))).job();
  auto channel = grpc::CreateChannel(service.server->address(), grpc::InsecureChannelCredentials());
  auto stub = v1::Telemetry::NewStub(channel);
  v1::WatchSamplesRequest request;
  request.set_job(job.name());
  struct Stalled {
    grpc::ClientContext context;
    std::unique_ptr<grpc::ClientReader<v1::WatchSamplesResponse>> reader;
  };
  std::vector<std::unique_ptr<Stalled>> stalled;
  for (int i = 0; i < 50; ++i) {
    auto s = std::make_unique<Stalled>();
    s->reader = stub->WatchSamples(&s->context, request);
    stalled.push_back(std::move(s));
  }
  Received got;
  EXPECT_TRUE(client.watch(job.name(), 0, [&](const auto& m) { got.take(m); return true; }).ok());
  EXPECT_EQ(got.last, 30000);
  EXPECT_FALSE(got.gap);
  const auto began = std::chrono::steady_clock::now();
  service.server->shutdown();  // with fifty messages that nobody fetches
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(8));
  for (auto& s : stalled) {
    s->context.TryCancel();
    s->reader->Finish();
  }
}

TEST(Watch, LiveCallsAreLimited) {
  const FakeOptions fake = paused(0);
  rpc::ServerSettings settings;
  settings.max_calls = 3;
  TestService service(fake, settings);
  JobClient client(service.server->address());
  const auto job = client.create(create_request(1, small_case())).job();
  auto channel = grpc::CreateChannel(service.server->address(), grpc::InsecureChannelCredentials());
  auto stub = v1::Telemetry::NewStub(channel);
  v1::WatchSamplesRequest request;
  request.set_job(job.name());
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReader<v1::WatchSamplesResponse>>> readers;
  int refused = 0;
  for (int i = 0; i < 6; ++i) {
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    readers.push_back(stub->WatchSamples(contexts.back().get(), request));
    v1::WatchSamplesResponse first;
    if (readers.back()->Read(&first)) continue;
    EXPECT_EQ(readers.back()->Finish().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    readers.pop_back();
    contexts.pop_back();
    ++refused;
  }
  EXPECT_GE(refused, 3);
  for (auto& context : contexts) context->TryCancel();
  for (auto& reader : readers) reader->Finish();
}

}  // namespace
}  // namespace seaway
