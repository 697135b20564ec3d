// SPDX-License-Identifier: GPL-3.0-or-later
// Health and reflection, as other programs ask for them: by the bytes of grpc.health.v1 and grpc.reflection.v1alpha.
#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include "server/jobs/workspace.hpp"
#include "tests/support/test_service.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;

struct Answer {
  grpc::Status status;
  std::string bytes;
};

Answer ask(const std::string& address, const std::string& method, const std::string& request) {
  grpc::GenericStub stub(grpc::CreateChannel(address, grpc::InsecureChannelCredentials()));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  grpc::CompletionQueue events;
  const auto wait = [&events] {
    void* tag = nullptr;
    bool ok = false;
    return events.Next(&tag, &ok) && ok;
  };
  const auto call = stub.PrepareCall(&context, method, &events);
  call->StartCall(nullptr);
  wait();
  const grpc::Slice slice(request);
  call->WriteLast(grpc::ByteBuffer(&slice, 1), {}, nullptr);
  wait();
  Answer out;
  grpc::ByteBuffer buffer;
  call->Read(&buffer, nullptr);
  if (wait()) {
    grpc::Slice whole;
    buffer.DumpToSingleSlice(&whole);
    out.bytes.assign(reinterpret_cast<const char*>(whole.begin()), whole.size());
  }
  call->Finish(&out.status, nullptr);
  wait();
  return out;
}

/// HealthCheckRequest{service}
Answer health(const std::string& address, const std::string& service) {
  return ask(address, "/grpc.health.v1.Health/Check", "\x0a" + std::string(1, static_cast<char>(service.size())) + service);
}

TEST(StandardServices, HealthKnowsTheServerItsServicesAndTheStorage) {
  rpc::ServerSettings settings;
  settings.access.principals = {{"ada", rpc::Role::admin, jobs::sha256_hex("a-token"), ""}};
  TestService service({}, settings);  // probes have no token
  const std::string address = service.server->address(), serving = "\x08\x01";
  for (const char* name : {"", "seaway.v1.Jobs", "seaway.v1.Telemetry", "seaway.v1.Stages", "seaway.v1.Artifacts", "seaway.v1.Admin",
                           "seaway.v1.Cases", "storage"})
    EXPECT_EQ(health(address, name).bytes, serving) << name;
  EXPECT_EQ(health(address, "wishes").status.error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST(StandardServices, ReflectionListsTheServices) {
  TestService service;
  const Answer list = ask(service.server->address(), "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", "\x3a\x01*");
  EXPECT_TRUE(list.status.ok()) << list.status.error_message();
  for (const char* name : {"seaway.v1.Jobs", "seaway.v1.Telemetry", "seaway.v1.Admin", "grpc.health.v1.Health"})
    EXPECT_THAT(list.bytes, ::testing::HasSubstr(name));
}

}  // namespace
}  // namespace seaway
