// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/access.hpp"

#include <arpa/inet.h>
#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>

#include <fstream>
#include <iterator>

#include "core/base/error.hpp"
#include "server/jobs/workspace.hpp"
#include "server/rpc/status.hpp"

namespace seaway::rpc {
namespace {

bool is_local(const std::string& address) {
  in_addr number{};  // a name that begins with 127 may stand for any machine
  const bool loopback = ::inet_pton(AF_INET, address.c_str(), &number) == 1 && (ntohl(number.s_addr) >> 24) == 127;
  return loopback || address == "localhost" || address == "::1" || address == "[::1]" || address.starts_with("unix:");
}

std::string read_pem(const std::string& field, const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  SEAWAY_CHECK(text.find("-----BEGIN") != text.npos, "security.{}: {} cannot be read or is no PEM file", field, file);
  return text;
}

/// In a time that does not tell where they differ.
bool same(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  return difference == 0;
}

}  // namespace

std::shared_ptr<grpc::ServerCredentials> Access::credentials(const std::string& address) const {
  const AccessSettings& s = settings_;
  SEAWAY_CHECK(s.certificate.empty() == s.key.empty(), "security: certificate and key belong together; give both or none");
  SEAWAY_CHECK(s.client_ca.empty() || !s.certificate.empty(), "security.client_ca needs certificate and key as well");
  if (!is_local(address))
    SEAWAY_CHECK(!s.certificate.empty() && !s.principals.empty(),
                 "listen.address {} is not local: others can reach it, so it needs security.certificate, key and principals "
                 "(tokens, or subjects with client_ca); or use 127.0.0.1 or unix:/path", address);
  for (const Principal& p : s.principals)
    SEAWAY_CHECK(p.subject.empty() || !s.client_ca.empty(), "security.principals: subject of {} needs client_ca", p.name);
  if (s.certificate.empty()) return grpc::InsecureServerCredentials();
  read_pem("key", s.key);
  read_pem("certificate", s.certificate);
  if (!s.client_ca.empty()) read_pem("client_ca", s.client_ca);
  // New handshakes take what is in the files; connections that stand are not touched.
  grpc::experimental::TlsServerCredentialsOptions options(std::make_shared<grpc::experimental::FileWatcherCertificateProvider>(
      s.key, s.certificate, s.client_ca, s.certificate_refresh_s));
  options.watch_identity_key_cert_pairs();
  options.set_cert_request_type(GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE);
  if (!s.client_ca.empty()) {
    options.watch_root_certs();
    options.set_cert_request_type(GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  }
  return grpc::experimental::TlsServerCredentials(options);
}

const Principal* Access::find(const grpc::ServerContextBase& context) const {
  std::string digest;
  const auto header = context.client_metadata().find("authorization");
  if (header != context.client_metadata().end()) {
    const std::string value(header->second.data(), header->second.size());
    if (value.starts_with("Bearer ")) digest = jobs::sha256_hex(std::string_view(value).substr(7));
  }
  std::string subject;
  if (const auto auth = context.auth_context(); auth != nullptr && auth->IsPeerAuthenticated())
    for (const auto& name : auth->FindPropertyValues("x509_common_name")) subject.assign(name.data(), name.size());
  const Principal* found = nullptr;
  for (const Principal& p : settings_.principals) {
    if (!p.token_sha256.empty() && same(p.token_sha256, digest)) found = &p;
    if (!p.subject.empty() && p.subject == subject && found == nullptr) found = &p;
  }
  return found;
}

std::string Access::check(const grpc::ServerContextBase& context, Role needed, const std::string& method,
                          const std::string& target) const {
  if (!asks()) return "local";
  const Principal* who = find(context);
  if (who != nullptr && who->role >= needed) return who->name;
  record(context, who != nullptr ? who->name : "", method, target, "DENIED");
  if (who == nullptr) throw Denied(false, "this server knows its callers by token or certificate; see --token-file and --cert");
  throw Denied(true, who->name + " may not do that; it needs the role " + (needed == Role::admin ? "admin" : "submitter"));
}

void Access::record(const grpc::ServerContextBase& context, const std::string& who, const std::string& method,
                    const std::string& target, const std::string& outcome) const {
  store_.add_audit({who, context.peer(), method, target.substr(0, 200), outcome, 0});
}

}  // namespace seaway::rpc
