// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of clients and of keeping house, by their numbers in tests/fault/README.md, with the service in this process.
#include <arpa/inet.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "tests/support/test_service.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using client::JobClient;
using grpc::StatusCode;

/// Seed of all random choices here; change it to search elsewhere.
constexpr unsigned seed = 20240611;

TEST(F11, AThousandReconnectsGiveEverySampleOnceAndAlwaysTheSame) {
  FakeOptions fake;
  fake.step = std::chrono::microseconds(300);
  TestService service(fake);
  JobClient submitter(service.server->address());
  const std::string name = submitter.create(create_request(1, small_case(10))).job().name();  // 3000 samples
  constexpr int clients = 8, reconnects = 125;
  std::vector<std::map<std::int64_t, double>> seen(clients);
  std::atomic<int> gaps{0};
  {
    std::vector<std::jthread> threads;
    for (int k = 0; k < clients; ++k)
      threads.emplace_back([&, k] {
        std::mt19937 random(seed + static_cast<unsigned>(k));
        JobClient client(service.server->address());
        std::int64_t latest = 0;
        for (int i = 0; i < reconnects || latest < 2000; ++i) {  // on a busy machine the run is slower than they are
          std::int64_t last = latest == 0 ? 0 : static_cast<std::int64_t>(random()) % (latest + 1);
          const std::int64_t enough = last + 1 + static_cast<std::int64_t>(random() % 200);
          client.watch(name, last, [&](const v1::WatchSamplesResponse& m) {
            if (!m.has_chunk()) return m.has_header();  // at a mark there is nothing more for now
            if (m.chunk().first_sequence() != last + 1) ++gaps;
            for (int s = 0; s < m.chunk().times_s_size(); ++s) {
              const double value = m.chunk().columns(0).values(s);
              const auto [known, fresh] = seen[static_cast<std::size_t>(k)].emplace(++last, value);
              if (!fresh && known->second != value) ++gaps;
            }
            return last < enough;
          });
          latest = std::max(latest, last);
        }
      });
  }
  EXPECT_EQ(gaps, 0) << "seed " << seed;
  ASSERT_TRUE(wait_for_state(*service.store, name.substr(5), store::State::succeeded));
  Received whole;
  submitter.watch(name, 0, [&](const auto& m) {
    whole.take(m);
    return true;
  });
  ASSERT_EQ(whole.heave.size(), 3000u);
  std::size_t values = 0;
  for (const auto& mine : seen) {
    values += mine.size();
    for (const auto& [sequence, value] : mine) ASSERT_EQ(value, whole.heave[static_cast<std::size_t>(sequence - 1)]) << sequence;
  }
  EXPECT_GT(values, 3000u) << "the clients have seen little";
}

TEST(F13, SixtyFourCallsWithOneRequestIdMakeOneJob) {
  TestService service;
  std::vector<std::string> names(64);
  {
    std::vector<std::jthread> threads;
    for (auto& name : names)
      threads.emplace_back([&] { name = JobClient(service.server->address()).create(create_request(7, small_case())).job().name(); });
  }
  for (const std::string& name : names) EXPECT_EQ(name, names.front());
  JobClient client(service.server->address());
  EXPECT_EQ(client.list({}).jobs_size(), 1);
  auto other = create_request(7, small_case());
  other.mutable_case_()->mutable_tank()->set_z_m(0, -1.1);
  EXPECT_EQ(status_of([&] { client.create(other); }), StatusCode::INVALID_ARGUMENT);
}

std::size_t resident_megabytes() {
  std::ifstream in("/proc/self/statm");
  std::size_t pages = 0;
  in >> pages >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) >> 20;
}

/// Sends bytes that are no call, and reads what comes back until the other side closes or a little time has passed.
void send_garbage(const std::string& address, const std::string& bytes) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  const timeval patience{0, 20'000};
  ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::send(fd, bytes.data() + at, std::min<std::size_t>(bytes.size() - at, 65536), MSG_NOSIGNAL);
    if (n <= 0) break;  // it has hung up, which is an answer
    at += static_cast<std::size_t>(n);
  }
  char answer[4096];
  while (::recv(fd, answer, sizeof answer, 0) > 0) {
  }
  ::close(fd);
}

TEST(F15, BytesThatAreNoCallEndTheirConnectionAlone) {
  TestService service;
  JobClient client(service.server->address());
  const std::string name = client.create(create_request(1, small_case())).job().name();
  const std::string preface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", settings("\0\0\0\4\0\0\0\0\0", 9);
  std::mt19937 random(seed);
  const std::size_t before = resident_megabytes();
  for (int i = 0; i < 200; ++i) {
    std::string bytes;
    for (std::size_t n = random() % 4000; n > 0; --n) bytes += static_cast<char>(random());
    switch (i % 4) {
      case 0: break;
      case 1: bytes = preface + settings + bytes; break;
      case 2: bytes = "POST /seaway.v1.Jobs/GetJob HTTP/1.1\r\nContent-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n" + bytes; break;
      default:  // a header frame that declares 16 MiB and brings a few bytes
        bytes = preface + settings + std::string("\xff\xff\xff\1\4\0\0\0\1", 9) + bytes;
    }
    send_garbage(service.server->address(), bytes);
    if (HasFatalFailure()) return;
  }
  send_garbage(service.server->address(), preface + settings + std::string("\0\x40\0\1\4\0\0\0\1", 9) + std::string(8 << 20, 'x'));
  EXPECT_LT(resident_megabytes(), before + 100);
  EXPECT_EQ(client.get(name).name(), name) << "others are not disturbed, seed " << seed;
  EXPECT_TRUE(wait_for_state(*service.store, name.substr(5), store::State::succeeded));
}

/// A stream that is read one message at a time.
struct SlowStream {
  SlowStream(const std::string& address, const std::string& name) {
    grpc::ChannelArguments own;
    own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    own.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);  // the window stays as small as it is: what is not read is not sent
    stub = v1::Telemetry::NewStub(grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), own));
    v1::WatchSamplesRequest request;
    request.set_job(name);
    reader = stub->WatchSamples(&context, request);
  }
  bool read(Received& to) {
    v1::WatchSamplesResponse m;
    if (!reader->Read(&m)) return false;
    to.take(m);
    return true;
  }
  std::unique_ptr<v1::Telemetry::Stub> stub;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReader<v1::WatchSamplesResponse>> reader;
};

TEST(F24, AJobDeletedUnderAStreamEndsItWithoutAGap) {
  TestService service;
  JobClient client(service.server->address());
  const std::string name = client.create(create_request(1, small_case(100))).job().name();
  ASSERT_TRUE(wait_for_state(*service.store, name.substr(5), store::State::succeeded));
  SlowStream slow(service.server->address(), name);
  Received got;
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(slow.read(got));
  client.erase(name);
  while (slow.read(got)) {
  }
  EXPECT_FALSE(got.gap);
  EXPECT_LT(got.last, 30'000) << "the whole history had been sent before the job was deleted: nothing is tested";
  EXPECT_NE(got.mark.state(), v1::Job::STATE_SUCCEEDED) << "the end of a job that has not been sent whole";
  EXPECT_EQ(slow.reader->Finish().error_code(), StatusCode::NOT_FOUND);
  EXPECT_EQ(client.watch(name, got.last, [](const auto&) { return true; }).error_code(), StatusCode::NOT_FOUND);
}

TEST(F24, ChangesThatAreNotKeptAreOutOfRange) {
  TestService service;
  JobClient client(service.server->address());
  for (int i = 0; i < 300; ++i) {
    auto held = create_request(i, small_case());
    held.set_start_held(true);
    client.create(held);
  }
  grpc::ClientContext context;
  const auto stub = v1::Telemetry::NewStub(grpc::CreateChannel(service.server->address(), grpc::InsecureChannelCredentials()));
  const auto reader = stub->WatchJobs(&context, v1::WatchJobsRequest{});
  v1::WatchJobsResponse m;
  std::int64_t last = 0;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(reader->Read(&m));
    if (m.has_change()) last = m.change().revision();
  }
  service.store->prune(2, 0);
  service.store->flush();
  bool gap = false;
  while (reader->Read(&m)) {
    if (!m.has_change()) break;  // it has come to the end, having read all before they went
    gap = gap || m.change().revision() != last + 1;
    last = m.change().revision();
  }
  EXPECT_FALSE(gap);
  if (last < 300) {
    EXPECT_EQ(reader->Finish().error_code(), StatusCode::OUT_OF_RANGE);
  }
  context.TryCancel();
  v1::WatchJobsRequest late;
  late.set_after_revision(1);
  grpc::ClientContext again;
  const auto refused = stub->WatchJobs(&again, late);
  EXPECT_FALSE(refused->Read(&m));
  EXPECT_EQ(refused->Finish().error_code(), StatusCode::OUT_OF_RANGE);
}

}  // namespace
}  // namespace seaway
