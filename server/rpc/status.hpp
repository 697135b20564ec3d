// SPDX-License-Identifier: GPL-3.0-or-later
// Failures -> gRPC statuses with details, in one place.
#pragma once

#include <grpcpp/support/status.h>

#include <exception>
#include <stdexcept>
#include <string>

namespace seaway::rpc {

/// A sequence number that does not exist; becomes OUT_OF_RANGE.
class OutOfRange : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Becomes UNAUTHENTICATED (nobody knows who calls) or PERMISSION_DENIED (it is known, and may not).
class Denied : public std::runtime_error {
 public:
  Denied(bool known, const std::string& message) : std::runtime_error(message), known_(known) {}
  bool known() const { return known_; }

 private:
  bool known_;
};

/// Of the exception in flight or given: code, text, ErrorInfo, BadRequest for wrong input, RetryInfo where
/// trying again helps.
grpc::Status to_status(const std::exception_ptr& error);

/// For what no exception stands for: CANCELLED, DEADLINE_EXCEEDED, ...
grpc::Status make_status(grpc::StatusCode code, const std::string& reason, const std::string& message);

}  // namespace seaway::rpc
