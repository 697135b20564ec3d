// SPDX-License-Identifier: GPL-3.0-or-later
// Requests that the service has to refuse, each with what it has to answer.
#pragma once

#include <grpcpp/support/status.h>

#include <string>
#include <vector>

namespace seaway::stress {

/// Who sends it: without a token, with an unknown one, or with that of a role.
enum class Caller { nobody, stranger, viewer, submitter, admin };

struct IllegalRequest {
  std::string what;
  Caller caller = Caller::admin;
  std::string method;         ///< for example Jobs.GetJob
  /// The message as protobuf text. $case: a good case; $new: a new request id; $done, $running, $held, $cancelled,
  /// $deleted: names of such jobs, $done_id ... their request ids; $token, $held_token: page tokens of all jobs and
  /// of the held ones; $sweep, $gone_sweep: a held sweep and a deleted one, $sweep_id ...; $sweep_token: a page token.
  std::string request;
  grpc::StatusCode status = grpc::StatusCode::INVALID_ARGUMENT;
  std::string field;          ///< that is named; empty: none is at fault
  std::string advice;         ///< a part of what the user is told about it
  std::string bytes = {};     ///< sent as they are instead of `request`
  bool by_grpc = false;       ///< gRPC itself answers: without our details
};
/// Every RPC: malformed, too large, unknown names, wrong states, wrong pages, no right.
std::vector<IllegalRequest> illegal_calls();
/// The same of Sweeps and Reports.
std::vector<IllegalRequest> illegal_sweeps();

/// A change that makes a good case a wrong one.
struct IllegalCase {
  std::string what;
  std::vector<std::string> clear;  ///< fields that go, for example tank.y_m
  std::string change;              ///< merged into the case, protobuf text
  std::string field, advice;       ///< as above
};
/// Of a section in waves with a hull and a compartment (tests/e2e/small.yaml).
std::vector<IllegalCase> illegal_sections();
/// Of `sphere_case()`.
std::vector<IllegalCase> illegal_ships();
/// A good case in three dimensions, protobuf text.
std::string sphere_case();

}  // namespace seaway::stress
