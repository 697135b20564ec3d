// SPDX-License-Identifier: GPL-3.0-or-later
// The promises of the service about jobs, and its answers to wrong requests.
#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "core/base/error.hpp"
#include "tests/support/test_service.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using client::JobClient;
using client::RpcError;
using grpc::StatusCode;

TEST(Service, RunsACaseFromSubmitToResults) {
  TestService service;
  JobClient client(service.server->address());
  const auto created = client.create(create_request(1, small_case()));
  EXPECT_EQ(created.report().stages_size(), 3);
  const std::string name = created.job().name();
  Received got;
  EXPECT_TRUE(client.watch(name, 0, [&](const auto& m) { got.take(m); return true; }).ok());
  EXPECT_EQ(got.last, 150);
  EXPECT_EQ(got.mark.state(), v1::Job::STATE_SUCCEEDED);
  EXPECT_EQ(client.stages(name).stages_size(), 3);
  EXPECT_EQ(client.artifacts(name).artifacts_size(), 3);
  const v1::Job job = client.get(name, v1::JOB_VIEW_FULL);
  EXPECT_EQ(job.case_().title(), small_case().title());
  EXPECT_GE(job.events_size(), 3);
  EXPECT_EQ(job.spec_digest().size(), 64u);
  int pages = 0;
  std::int64_t samples = 0;
  client.history(name, [&](const v1::ReadSamplesResponse& page) {
    ++pages;
    samples += page.chunk().times_s_size();
  });
  EXPECT_EQ(samples, 150);
  EXPECT_EQ(client.resolve("latest"), name);
}

TEST(Service, RepeatedSubmitIsOneJobAlsoAfterARestart) {
  TestService service;
  std::string name;
  {
    JobClient client(service.server->address());
    name = client.create(create_request(1, small_case())).job().name();
    EXPECT_EQ(client.create(create_request(1, small_case())).job().name(), name);
  }
  service.stop();
  service.start();
  JobClient client(service.server->address());
  EXPECT_EQ(client.create(create_request(1, small_case())).job().name(), name);
  try {
    client.create(create_request(1, small_case(0.7)));
    FAIL();
  } catch (const RpcError& error) {
    EXPECT_EQ(error.status(), StatusCode::INVALID_ARGUMENT);
    ASSERT_FALSE(error.violations().empty());
    EXPECT_EQ(error.violations()[0].first, "cascade.stages[0].end.time.duration_s");
  }
}

TEST(Service, ListsByPages) {
  FakeOptions fake;
  fake.allowed_steps = std::make_shared<std::atomic<std::int64_t>>(0);
  TestService service(fake);
  JobClient client(service.server->address());
  for (int i = 0; i < 7; ++i) client.create(create_request(i, small_case()));
  v1::ListJobsRequest request;
  request.set_page_size(3);
  std::vector<std::string> seen;
  do {
    const auto page = client.list(request);
    for (const auto& job : page.jobs()) seen.push_back(job.name());
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  EXPECT_EQ(seen.size(), 7u);
  request.set_page_token("0-0");
  EXPECT_EQ(status_of([&] { client.list(request); }), StatusCode::INVALID_ARGUMENT);
}

TEST(Service, CancelsInEveryState) {
  FakeOptions fake;
  fake.allowed_steps = std::make_shared<std::atomic<std::int64_t>>(20);
  TestService service(fake);
  JobClient client(service.server->address());
  const auto running = client.create(create_request(1, small_case())).job();
  const auto queued = client.create(create_request(2, small_case())).job();
  ASSERT_TRUE(wait_for_job(*service.store, running.uid(), [](const auto& j) { return j.last_sequence == 20; }));
  EXPECT_EQ(client.cancel(queued.name()).state(), v1::Job::STATE_CANCELLED);
  client.cancel(running.name());
  ASSERT_TRUE(wait_for_state(*service.store, running.uid(), store::State::cancelled));
  EXPECT_EQ(client.cancel(running.name()).state(), v1::Job::STATE_CANCELLED) << "again is fine";
  EXPECT_EQ(client.get(running.name()).checkpoint_sequence(), 20);
  *fake.allowed_steps = 1'000'000;
  const auto done = client.create(create_request(3, small_case())).job();
  ASSERT_TRUE(wait_for_state(*service.store, done.uid(), store::State::succeeded));
  EXPECT_EQ(status_of([&] { client.cancel(done.name()); }), StatusCode::FAILED_PRECONDITION);
}

TEST(Service, DeletesEndedJobsOnly) {
  FakeOptions fake;
  fake.allowed_steps = std::make_shared<std::atomic<std::int64_t>>(5);
  TestService service(fake);
  JobClient client(service.server->address());
  const auto job = client.create(create_request(1, small_case())).job();
  EXPECT_EQ(status_of([&] { client.erase(job.name()); }), StatusCode::FAILED_PRECONDITION);
  client.cancel(job.name());
  ASSERT_TRUE(wait_for_state(*service.store, job.uid(), store::State::cancelled));
  client.erase(job.name());
  EXPECT_EQ(status_of([&] { client.get(job.name()); }), StatusCode::NOT_FOUND);
}

TEST(Service, BlowUpFailsTheJobAndKeepsItsHistory) {
  TestService service;
  JobClient client(service.server->address());
  v1::Case m = small_case();
  m.set_title("diverge");
  const auto name = client.create(create_request(1, m)).job().name();
  Received got;
  client.watch(name, 0, [&](const auto& x) { got.take(x); return true; });
  EXPECT_EQ(got.mark.state(), v1::Job::STATE_FAILED);
  EXPECT_EQ(got.mark.state_reason(), v1::Job::REASON_DIVERGED);
  EXPECT_THAT(got.mark.state_message(), ::testing::HasSubstr("smaller time step"));
  EXPECT_EQ(got.last, 126);
  EXPECT_EQ(client.get(name).checkpoint_sequence(), 100);
}

TEST(Service, AnswersWrongRequestsWithTheRightStatus) {
  TestService service;
  JobClient client(service.server->address());
  EXPECT_EQ(status_of([&] { client.get("jobs/nobody"); }), StatusCode::NOT_FOUND);
  EXPECT_EQ(status_of([&] { client.get("nobody"); }), StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status_of([&] { client.get("jobs/../../etc"); }), StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status_of([&] { client.cancel("jobs/nobody"); }), StatusCode::NOT_FOUND);
  EXPECT_EQ(status_of([&] { client.erase("jobs/nobody"); }), StatusCode::NOT_FOUND);
  EXPECT_EQ(status_of([&] { client.stages("jobs/nobody"); }), StatusCode::NOT_FOUND);
  EXPECT_EQ(status_of([&] { client.artifacts("jobs/nobody"); }), StatusCode::NOT_FOUND);
  EXPECT_EQ(status_of([&] { client.download("jobs/nobody", "x", [](const auto&) {}); }), StatusCode::NOT_FOUND);
  EXPECT_EQ(status_of([&] { client.create({}); }), StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status_of([&] { client.validate({}); }), StatusCode::INVALID_ARGUMENT);
  v1::ListJobsRequest list;
  list.set_page_size(1001);
  EXPECT_EQ(status_of([&] { client.list(list); }), StatusCode::INVALID_ARGUMENT);
  list.set_page_size(1);
  list.add_states(static_cast<v1::Job::State>(99));
  EXPECT_EQ(status_of([&] { client.list(list); }), StatusCode::INVALID_ARGUMENT);
  auto huge = create_request(1, small_case());
  for (int i = 0; i < 10; ++i) huge.add_files()->set_content(std::string(1 << 20, 'x'));
  EXPECT_EQ(status_of([&] { client.create(huge); }), StatusCode::RESOURCE_EXHAUSTED) << "over 8 MiB";
  const auto ignore = [](const auto&) { return true; };
  EXPECT_EQ(client.watch("jobs/nobody", 0, ignore).error_code(), StatusCode::NOT_FOUND);
  EXPECT_EQ(client.watch("x", 0, ignore).error_code(), StatusCode::INVALID_ARGUMENT);
  const auto job = client.create(create_request(1, small_case())).job();
  EXPECT_EQ(client.watch(job.name(), -1, ignore).error_code(), StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(client.watch(job.name(), 1'000'000, ignore).error_code(), StatusCode::OUT_OF_RANGE);
  EXPECT_EQ(service.store->list({}).size(), 1u) << "nothing else was queued";
}

TEST(Service, RefusesBytesThatAreNoMessage) {
  TestService service;
  auto channel = grpc::CreateChannel(service.server->address(), grpc::InsecureChannelCredentials());
  grpc::GenericStub stub(channel);
  unsigned seed = 1;  // any: the bytes only have to be wrong
  for (int round = 0; round < 200; ++round) {
    std::string bytes;
    for (int i = 0; i < 1 + round; ++i) bytes += static_cast<char>((seed = seed * 1664525u + 1013904223u) >> 24);
    grpc::Slice slice(bytes);
    grpc::ByteBuffer request(&slice, 1), response;
    grpc::ClientContext context;
    grpc::CompletionQueue queue;
    auto call = stub.PrepareUnaryCall(&context, "/seaway.v1.Jobs/CreateJob", request, &queue);
    call->StartCall();
    grpc::Status status;
    call->Finish(&response, &status, &queue);
    void* tag = nullptr;
    bool ok = false;
    ASSERT_TRUE(queue.Next(&tag, &ok));
    EXPECT_FALSE(status.ok());
  }
  EXPECT_TRUE(service.store->list({}).empty());
}

TEST(Service, DownloadsFromAnyOffset) {
  TestService service;
  JobClient client(service.server->address());
  const auto job = client.create(create_request(1, small_case())).job();
  ASSERT_TRUE(wait_for_state(*service.store, job.uid(), store::State::succeeded));
  const auto list = client.artifacts(job.name());
  const v1::Artifact artifact = list.artifacts(0);
  std::string whole;
  client.download(job.name(), artifact.name(), [&](const std::string& piece) { whole += piece; });
  EXPECT_EQ(static_cast<std::int64_t>(whole.size()), artifact.size_bytes());
  auto channel = grpc::CreateChannel(service.server->address(), grpc::InsecureChannelCredentials());
  auto stub = v1::Artifacts::NewStub(channel);
  v1::DownloadArtifactRequest request;
  request.set_job(job.name());
  request.set_artifact(artifact.name());
  for (const std::int64_t offset : {std::int64_t{100}, artifact.size_bytes(), artifact.size_bytes() + 1}) {
    request.set_offset(offset);
    grpc::ClientContext context;
    auto reader = stub->DownloadArtifact(&context, request);
    v1::DownloadArtifactResponse response;
    std::string part;
    while (reader->Read(&response)) part += response.data();
    const auto status = reader->Finish();
    if (offset > artifact.size_bytes())
      EXPECT_EQ(status.error_code(), StatusCode::OUT_OF_RANGE);
    else
      EXPECT_EQ(part, whole.substr(static_cast<std::size_t>(offset)));
  }
}

TEST(Service, RefusesToListenElsewhere) {
  rpc::ServerSettings settings;
  settings.address = "0.0.0.0";
  try {
    TestService service({}, settings);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
  }
}

}  // namespace
}  // namespace seaway
