// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/status.hpp"

#include "core/base/error.hpp"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/convert/input_error.hpp"

namespace seaway::rpc {
namespace {

struct Mapped {
  grpc::StatusCode code;
  const char* reason;
  int retry_s;  ///< 0: trying the same again does not help
};

Mapped map_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_argument: return {grpc::StatusCode::INVALID_ARGUMENT, "INVALID_ARGUMENT", 0};
    case ErrorCode::not_found: return {grpc::StatusCode::NOT_FOUND, "NOT_FOUND", 0};
    case ErrorCode::failed_precondition: return {grpc::StatusCode::FAILED_PRECONDITION, "WRONG_STATE", 0};
    case ErrorCode::unavailable: return {grpc::StatusCode::UNAVAILABLE, "UNAVAILABLE", 1};
    case ErrorCode::resource_exhausted: return {grpc::StatusCode::RESOURCE_EXHAUSTED, "LIMIT_REACHED", 10};
    case ErrorCode::data_loss: return {grpc::StatusCode::DATA_LOSS, "DATA_LOSS", 0};
    case ErrorCode::diverged: return {grpc::StatusCode::ABORTED, "DIVERGED", 0};
    case ErrorCode::internal: return {grpc::StatusCode::INTERNAL, "INTERNAL", 0};
  }
  return {grpc::StatusCode::INTERNAL, "INTERNAL", 0};
}

// gRPC sends texts as headers, whose whole size is limited to 8 KiB by default.
constexpr std::size_t max_text = 700;
constexpr int max_violations = 8;

std::string cut(std::string text, std::size_t limit) {
  if (text.size() <= limit) return text;
  text.resize(limit);
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
  if (!text.empty() && (static_cast<unsigned char>(text.back()) & 0x80) != 0) text.pop_back();
  return text + " ...";
}

grpc::Status build(grpc::StatusCode code, const std::string& reason, const std::string& message, int retry_s,
                   const std::vector<sim::Diagnostic>& problems) {
  google::rpc::Status details;
  details.set_code(code);
  details.set_message(cut(message, max_text));
  google::rpc::ErrorInfo info;
  info.set_reason(reason);
  info.set_domain("seaway");
  details.add_details()->PackFrom(info);
  if (!problems.empty()) {
    google::rpc::BadRequest bad;
    for (const sim::Diagnostic& p : problems) {
      if (bad.field_violations_size() >= max_violations) break;
      auto& violation = *bad.add_field_violations();
      violation.set_field(cut(p.field, 120));
      violation.set_description(cut(p.hint.empty() ? p.message : p.message + "; " + p.hint, 240));
    }
    details.add_details()->PackFrom(bad);
  }
  if (retry_s > 0) {
    google::rpc::RetryInfo retry;
    retry.mutable_retry_delay()->set_seconds(retry_s);
    details.add_details()->PackFrom(retry);
  }
  return {code, details.message(), details.SerializeAsString()};
}

}  // namespace

grpc::Status to_status(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const convert::InputError& e) {
    return build(grpc::StatusCode::INVALID_ARGUMENT, e.reason(), e.what(), 0, e.problems());
  } catch (const Error& e) {
    const Mapped mapped = map_code(e.code());
    return build(mapped.code, mapped.reason, e.what(), mapped.retry_s, {});
  } catch (const OutOfRange& e) {
    return build(grpc::StatusCode::OUT_OF_RANGE, "SEQUENCE_OUT_OF_RANGE", e.what(), 0, {});
  } catch (const Denied& e) {
    return e.known() ? build(grpc::StatusCode::PERMISSION_DENIED, "ROLE", e.what(), 0, {})
                     : build(grpc::StatusCode::UNAUTHENTICATED, "WHO", e.what(), 0, {});
  } catch (const std::bad_alloc&) {
    return build(grpc::StatusCode::RESOURCE_EXHAUSTED, "MEMORY", "the server is out of memory", 10, {});
  } catch (const std::exception& e) {
    return build(grpc::StatusCode::INTERNAL, "INTERNAL", e.what(), 0, {});
  }
}

grpc::Status make_status(grpc::StatusCode code, const std::string& reason, const std::string& message) {
  return build(code, reason, message, 0, {});
}

}  // namespace seaway::rpc
