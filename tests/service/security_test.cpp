// SPDX-License-Identifier: GPL-3.0-or-later
// Who gets in, and what they may do (F22 of the fault tests).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "core/base/error.hpp"
#include "server/jobs/workspace.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/test_service.hpp"

namespace seaway {
namespace {

using namespace seaway::testing;
using client::Credentials;
using client::JobClient;
using grpc::StatusCode;

class Security : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name) << content;
    return folder_ / name;
  }
  Credentials caller(const std::string& token) {
    Credentials out;
    out.token = token;
    return out;
  }
  static rpc::Principal by_token(const std::string& name, rpc::Role role, const std::string& token) {
    return {name, role, jobs::sha256_hex(token), ""};
  }
  TempFolder folder_;
};

TEST_F(Security, RolesDecideWhatACallerMayDo) {
  rpc::ServerSettings settings;
  settings.access.principals = {by_token("vera", rpc::Role::viewer, "v-token"), by_token("sam", rpc::Role::submitter, "s-token"),
                                by_token("ada", rpc::Role::admin, "a-token")};
  TestService service({}, settings);
  const std::string address = service.server->address();
  JobClient nobody(address), wrong(address, caller("v-tokem")), vera(address, caller("v-token")), sam(address, caller("s-token")),
      ada(address, caller("a-token"));
  EXPECT_EQ(status_of([&] { nobody.list({}); }), StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(status_of([&] { wrong.list({}); }), StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(status_of([&] { vera.list({}); }), StatusCode::OK);
  EXPECT_EQ(status_of([&] { vera.create(create_request(1, small_case())); }), StatusCode::PERMISSION_DENIED);
  const std::string name = sam.create(create_request(2, small_case())).job().name();
  ASSERT_TRUE(wait_for_state(*service.store, name.substr(5), store::State::succeeded));
  EXPECT_EQ(nobody.watch(name, 0, [](const auto&) { return true; }).error_code(), StatusCode::UNAUTHENTICATED);
  EXPECT_TRUE(vera.watch(name, 0, [](const auto&) { return true; }).ok());
  EXPECT_EQ(status_of([&] { sam.erase(name); }), StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(status_of([&] { sam.set_log_level("debug"); }), StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(status_of([&] { ada.erase(name); }), StatusCode::OK);
  service.store->flush();
  std::vector<std::string> trail;
  for (const auto& row : service.store->audit(100)) {
    trail.push_back(row.principal + " " + row.method + " " + row.outcome);
    EXPECT_EQ((row.principal + row.target + row.outcome).find("token"), std::string::npos) << "secrets are not kept";
  }
  EXPECT_THAT(trail, ::testing::IsSupersetOf({"ada DeleteJob OK", "sam DeleteJob DENIED", "sam CreateJob OK", "vera CreateJob DENIED",
                                              " ListJobs DENIED", " WatchSamples DENIED"}));
}

TEST_F(Security, MutualTlsKnowsCallersByTheirCertificate) {
  const Pem authority = make_certificate("test authority"), stranger_authority = make_certificate("other authority");
  const Pem server = make_certificate("server", &authority), client = make_certificate("sam", &authority),
            unknown = make_certificate("unknown", &authority), stranger = make_certificate("sam", &stranger_authority);
  rpc::ServerSettings settings;
  settings.address = "0.0.0.0";  // reachable by others: only with all of this
  settings.access.certificate = file("server.pem", server.certificate);
  settings.access.key = file("server.key", server.key);
  settings.access.client_ca = file("ca.pem", authority.certificate);
  settings.access.principals = {{"sam", rpc::Role::submitter, "", "sam"}};
  TestService service({}, settings);
  const std::string port = service.server->address().substr(service.server->address().rfind(':'));
  const auto with = [&](const std::string& name, const Pem& pem) {
    Credentials out;
    out.ca = file("ca.pem", authority.certificate);
    if (!pem.key.empty()) out.certificate = file(name + ".pem", pem.certificate), out.key = file(name + ".key", pem.key);
    return out;
  };
  JobClient sam("127.0.0.1" + port, with("sam", client));
  EXPECT_EQ(status_of([&] { sam.create(create_request(1, small_case())); }), StatusCode::OK);
  JobClient without_role("127.0.0.1" + port, with("unknown", unknown));
  EXPECT_EQ(status_of([&] { without_role.list({}); }), StatusCode::UNAUTHENTICATED);
  JobClient other("127.0.0.1" + port, with("stranger", stranger));
  EXPECT_EQ(status_of([&] { other.list({}); }), StatusCode::UNAVAILABLE) << "no handshake";
  JobClient anonymous("127.0.0.1" + port, with("", {}));
  EXPECT_EQ(status_of([&] { anonymous.list({}); }), StatusCode::UNAVAILABLE);
  JobClient plain("127.0.0.1" + port);
  EXPECT_EQ(status_of([&] { plain.list({}); }), StatusCode::UNAVAILABLE);
}

// F22: what a server with mutual TLS says to certificates that are not good (any more), and when its own are changed.
class F22 : public Security {
 protected:
  F22() {
    settings_.access.certificate = folder_ / "server.pem";
    settings_.access.key = folder_ / "server.key";
    settings_.access.client_ca = folder_ / "clients.pem";
    settings_.access.principals = {{"sam", rpc::Role::submitter, "", "sam"}};
    settings_.access.certificate_refresh_s = 1;
    install(authority_);
  }
  /// Certificates of the server, and whose clients it takes, in files that are renamed into their place.
  void install(const Pem& authority) {
    const Pem server = make_certificate("server", &authority);
    for (const auto& [name, content] : {std::pair{"server.pem", server.certificate}, {"server.key", server.key}, {"clients.pem", authority.certificate}}) {
      file(std::string(name) + ".new", content);
      std::filesystem::rename(folder_ / (std::string(name) + ".new"), folder_ / name);
    }
  }
  /// A client of one authority that expects the server to be of another one, or of the same.
  Credentials client(const std::string& name, const Pem& own, const Pem& authority) {
    Credentials out;
    out.ca = file(name + ".ca.pem", authority.certificate);
    out.certificate = file(name + ".pem", own.certificate);
    out.key = file(name + ".key", own.key);
    return out;
  }
  const Pem authority_ = make_certificate("test authority");
  rpc::ServerSettings settings_;
};

TEST_F(F22, AnExpiredCertificateGetsNoHandshake) {
  TestService service({}, settings_);
  JobClient late(service.server->address(), client("late", make_certificate("sam", &authority_, -60), authority_));
  EXPECT_EQ(status_of([&] { late.list({}); }), StatusCode::UNAVAILABLE);
  JobClient good(service.server->address(), client("good", make_certificate("sam", &authority_), authority_));
  EXPECT_EQ(status_of([&] { good.list({}); }), StatusCode::OK);
}

TEST_F(F22, CertificatesChangeUnderLoadAndNoStreamIsDropped) {
  FakeOptions fake;
  fake.allowed_steps = std::make_shared<std::atomic<std::int64_t>>(100);
  TestService service(fake, settings_);
  const std::string address = service.server->address();
  const Pem next_authority = make_certificate("next authority");
  JobClient before(address, client("before", make_certificate("sam", &authority_), authority_));
  const std::string name = before.create(create_request(1, small_case(10))).job().name();
  Received got;
  grpc::Status end;
  std::atomic<bool> watching{false};
  std::jthread watcher([&] {
    end = before.watch(name, 0, [&](const auto& m) {
      got.take(m);
      watching = true;
      return true;
    });
  });
  while (!watching) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  install(next_authority);
  // Those who have the new certificates get in, soon; those who bring old ones do not.
  bool in = false;
  for (int i = 0; i < 100 && !in; ++i) {
    JobClient after(address, client("after" + std::to_string(i), make_certificate("sam", &next_authority), next_authority));
    in = status_of([&] { after.list({}); }) == StatusCode::OK;
  }
  EXPECT_TRUE(in);
  JobClient old(address, client("old", make_certificate("sam", &authority_), authority_));
  EXPECT_EQ(status_of([&] { old.list({}); }), StatusCode::UNAVAILABLE);
  *fake.allowed_steps = 1'000'000;
  watcher.join();
  EXPECT_TRUE(end.ok()) << end.error_message();
  EXPECT_EQ(got.last, 3000);
  EXPECT_FALSE(got.gap);
}

TEST_F(F22, TokensAreNotFoundByTryingAndEachTryIsRecorded) {
  rpc::ServerSettings settings;
  settings.access.principals = {by_token("ada", rpc::Role::admin, "a-token")};
  TestService service({}, settings);
  for (int i = 0; i < 200; ++i) {
    JobClient guess(service.server->address(), caller("a-toke" + std::to_string(i)));
    ASSERT_EQ(status_of([&] { guess.list({}); }), StatusCode::UNAUTHENTICATED);
  }
  service.store->flush();
  EXPECT_EQ(service.store->audit(1000).size(), 200u);
}

TEST_F(Security, OtherAddressesNeedTlsAndPrincipals) {
  const Pem authority = make_certificate("test authority"), server = make_certificate("server", &authority);
  const auto why = [&](rpc::AccessSettings access, const std::string& address = "0.0.0.0") -> std::string {
    rpc::ServerSettings settings;
    settings.address = address;
    settings.access = std::move(access);
    try {
      TestService service({}, settings);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
      return error.what();
    }
    return "started";
  };
  rpc::AccessSettings access;
  EXPECT_THAT(why(access), ::testing::HasSubstr("needs security.certificate"));
  for (const char* name : {"127.example.org", "127.0.0.1.example.org", "127.1", "::", "example.org"})
    EXPECT_THAT(why(access, name), ::testing::HasSubstr("needs security.certificate")) << name << " is anybody's";
  EXPECT_EQ(why(access, "127.0.0.2"), "started");
  access.principals = {by_token("ada", rpc::Role::admin, "a-token")};
  EXPECT_THAT(why(access), ::testing::HasSubstr("needs security.certificate")) << "tokens never go over an open line";
  access.certificate = file("server.pem", server.certificate);
  EXPECT_THAT(why(access), ::testing::HasSubstr("belong together"));
  access.key = folder_ / "missing.key";
  EXPECT_THAT(why(access), ::testing::HasSubstr("cannot be read"));
  access.key = file("server.key", server.key);
  EXPECT_EQ(why(access), "started");
  access.principals = {{"sam", rpc::Role::viewer, "", "sam"}};
  EXPECT_THAT(why(access), ::testing::HasSubstr("needs client_ca"));
  access.principals.clear();
  EXPECT_THAT(why(access), ::testing::HasSubstr("needs security.certificate"));
}

}  // namespace
}  // namespace seaway
