// SPDX-License-Identifier: GPL-3.0-or-later
// The promises of the service about streams: every sample once, in order, whatever happens to the connection.
#include <grpcpp/create_channel.h>
#include <grpcpp/grpcpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "server/jobs/workspace.hpp"
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

/// Streams that stay open, each on the connection that it is given.
class OpenStreams {
 public:
  /// Of a job made for them.
  explicit OpenStreams(JobClient& client) { request_.set_job(client.create(create_request(1, small_case())).job().name()); }
  ~OpenStreams() {
    while (!readers_.empty()) end_one();
  }
  /// The status that a new stream ends with at once; OK if it stays open.
  grpc::Status open(const std::shared_ptr<grpc::Channel>& channel, const std::string& token = "") {
    auto context = std::make_unique<grpc::ClientContext>();
    if (!token.empty()) context->AddMetadata("authorization", "Bearer " + token);
    auto reader = v1::Telemetry::NewStub(channel)->WatchSamples(context.get(), request_);
    v1::WatchSamplesResponse first;
    if (!reader->Read(&first)) return reader->Finish();
    contexts_.push_back(std::move(context));
    readers_.push_back(std::move(reader));
    return grpc::Status::OK;
  }
  void end_one() {
    contexts_.back()->TryCancel();
    readers_.back()->Finish();
    readers_.pop_back();
    contexts_.pop_back();
  }

 private:
  v1::WatchSamplesRequest request_;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts_;
  std::vector<std::unique_ptr<grpc::ClientReader<v1::WatchSamplesResponse>>> readers_;
};

std::shared_ptr<grpc::Channel> connection(const TestService& service) {
  grpc::ChannelArguments own;
  own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(service.server->address(), grpc::InsecureChannelCredentials(), own);
}

rpc::ServerSettings two_streams_per_caller() {
  rpc::ServerSettings settings;
  settings.max_streams_per_caller = 2;
  return settings;
}

void expect_refused(const grpc::Status& status, const std::string& text) {
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_THAT(status.error_message(), ::testing::HasSubstr(text));
  EXPECT_THAT(status.error_details(), ::testing::HasSubstr("RetryInfo"));
}

TEST(Watch, StreamsAreLimitedInAll) {
  rpc::ServerSettings settings;
  settings.max_streams = 3;
  TestService service(paused(0), settings);
  JobClient client(service.server->address());
  OpenStreams streams(client);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(streams.open(connection(service)).ok());
  expect_refused(streams.open(connection(service)), "limits.streams)");
  EXPECT_EQ(client.list({}).jobs_size(), 1) << "other calls go on";
}

TEST(Watch, StreamsOfOneConnectionAreLimitedAndTheirPlacesComeBack) {
  TestService service(paused(0), two_streams_per_caller());
  JobClient client(service.server->address());
  OpenStreams streams(client);
  const auto first = connection(service), second = connection(service);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(streams.open(first).ok());
  expect_refused(streams.open(first), "limits.streams_per_caller); end some");
  EXPECT_TRUE(streams.open(second).ok());
  for (int i = 0; i < 2; ++i) streams.end_one();
  grpc::Status again = streams.open(first);
  for (int i = 0; i < 500 && !again.ok(); ++i) {  // the server hears of the end a little later
    std::this_thread::sleep_for(std::chrono::milliseconds(10 * SEAWAY_SLOWDOWN));
    again = streams.open(first);
  }
  EXPECT_TRUE(again.ok()) << again.error_message();
}

TEST(Watch, StreamsOfOnePrincipalAreLimitedOverAllItsConnections) {
  rpc::ServerSettings settings = two_streams_per_caller();
  settings.access.principals = {{"ada", rpc::Role::admin, jobs::sha256_hex("a"), ""}, {"bob", rpc::Role::viewer, jobs::sha256_hex("b"), ""}};
  TestService service(paused(0), settings);
  JobClient client(connection(service), "a");
  OpenStreams streams(client);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(streams.open(connection(service), "a").ok());
  expect_refused(streams.open(connection(service), "a"), "ada holds 2 open streams");
  EXPECT_TRUE(streams.open(connection(service), "b").ok());
}

}  // namespace
}  // namespace seaway
