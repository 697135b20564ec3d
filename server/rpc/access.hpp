// SPDX-License-Identifier: GPL-3.0-or-later
// Who calls, and whether that is allowed: roles, tokens, client certificates, and the audit trail. Safe from any
// thread after construction.
#pragma once

#include <grpcpp/security/server_credentials.h>
#include <grpcpp/server_context.h>

#include <memory>
#include <string>
#include <vector>

#include "server/store/job_store.hpp"

namespace seaway::rpc {

/// Each may do what the ones before it may.
enum class Role { viewer = 1, submitter = 2, admin = 3 };

struct Principal {
  std::string name;
  Role role = Role::viewer;
  std::string token_sha256;  ///< lower-case hexadecimal; or
  std::string subject;       ///< common name of the client's certificate
};

struct AccessSettings {
  std::string certificate, key, client_ca;  ///< PEM files; no certificate: no TLS
  unsigned certificate_refresh_s = 30;      ///< how often they are read again
  std::vector<Principal> principals;        ///< none: everybody may do everything
};

class Access {
 public:
  Access(AccessSettings settings, store::JobStore& store) : settings_(std::move(settings)), store_(store) {}

  /// Credentials to listen with at `address`. Throws Error(invalid_argument) for an address that others can
  /// reach without TLS and principals, and for files that cannot be read.
  std::shared_ptr<grpc::ServerCredentials> credentials(const std::string& address) const;
  /// Whether callers must say who they are.
  bool asks() const { return !settings_.principals.empty(); }
  /// Name of who calls. Throws Denied if there is no such principal or its role is too small; that is recorded.
  std::string check(const grpc::ServerContextBase& context, Role needed, const std::string& method,
                    const std::string& target) const;
  /// Records what somebody did, or could not do.
  void record(const grpc::ServerContextBase& context, const std::string& who, const std::string& method,
              const std::string& target, const std::string& outcome) const;

 private:
  const Principal* find(const grpc::ServerContextBase& context) const;
  const AccessSettings settings_;
  store::JobStore& store_;
};

}  // namespace seaway::rpc
