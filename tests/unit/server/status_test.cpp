// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/status.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/convert/input_error.hpp"
#include "server/rpc/messages.hpp"

namespace seaway::rpc {
namespace {

template <class E>
grpc::Status status_of(const E& error) {
  return to_status(std::make_exception_ptr(error));
}

TEST(Status, MapsEveryErrorCode) {
  EXPECT_EQ(status_of(Error(ErrorCode::invalid_argument, "x")).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status_of(Error(ErrorCode::not_found, "x")).error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(status_of(Error(ErrorCode::failed_precondition, "x")).error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(status_of(Error(ErrorCode::unavailable, "x")).error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(status_of(Error(ErrorCode::resource_exhausted, "x")).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(status_of(Error(ErrorCode::data_loss, "x")).error_code(), grpc::StatusCode::DATA_LOSS);
  EXPECT_EQ(status_of(Error(ErrorCode::internal, "x")).error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_EQ(status_of(OutOfRange("x")).error_code(), grpc::StatusCode::OUT_OF_RANGE);
  EXPECT_EQ(status_of(std::runtime_error("x")).error_code(), grpc::StatusCode::INTERNAL);
}

TEST(Status, CarriesFieldsAndReason) {
  const convert::InputError error("INVALID_CASE", {{sim::Diagnostic::Severity::error, "tank.y_m", "is missing", "give it"}});
  const grpc::Status status = status_of(error);
  google::rpc::Status details;
  ASSERT_TRUE(details.ParseFromString(status.error_details()));
  google::rpc::ErrorInfo info;
  google::rpc::BadRequest bad;
  ASSERT_TRUE(details.details(0).UnpackTo(&info));
  ASSERT_TRUE(details.details(1).UnpackTo(&bad));
  EXPECT_EQ(info.reason(), "INVALID_CASE");
  EXPECT_EQ(info.domain(), "seaway");
  EXPECT_EQ(bad.field_violations(0).field(), "tank.y_m");
  EXPECT_EQ(bad.field_violations(0).description(), "is missing; give it");
}

TEST(Status, StaysSmallHoweverMuchIsWrong) {
  std::vector<sim::Diagnostic> many(100, {sim::Diagnostic::Severity::error, std::string(500, 'f'), std::string(2000, 'm'), ""});
  const grpc::Status status = status_of(convert::InputError("INVALID_CASE", many));
  EXPECT_LT(status.error_message().size() + status.error_details().size(), 5500u);  // 8 KiB of headers in gRPC, less base64 (4/3)
}

TEST(Messages, PageTokensBelongToTheirFilter) {
  store::ListQuery running, labelled;
  running.states = {store::State::running};
  labelled.states = running.states;
  labelled.labels = {{"ship", "dtmb"}};
  const std::string token = make_page_token(42, running);
  EXPECT_EQ(parse_page_token(token, running), 42);
  EXPECT_EQ(parse_page_token("", running), 0);
  EXPECT_THROW(parse_page_token(token, {}), convert::InputError);
  EXPECT_THROW(parse_page_token(token, labelled), convert::InputError);
  EXPECT_EQ(parse_sweep_token(make_sweep_token(42)), 42);
  EXPECT_EQ(parse_sweep_token(""), 0);
  EXPECT_THROW(parse_sweep_token(make_page_token(42, {})), convert::InputError) << "of the jobs";
  EXPECT_THROW(parse_page_token(make_sweep_token(42), {}), convert::InputError);
  for (const char* bad : {"x", "-", "1", "1-", "-1-0", "zz-0", "1-0x", "s", "s-", "s1-0"}) {
    EXPECT_THROW(parse_page_token(bad, {}), convert::InputError) << bad;
    EXPECT_THROW(parse_sweep_token(bad), convert::InputError) << bad;
  }
}

TEST(Messages, JobNamesAreStrict) {
  EXPECT_EQ(parse_job_name("jobs/abc", "name"), "abc");
  for (const char* bad : {"", "abc", "jobs/", "jobs/../x", "jobs/ABC", "jobs/a/b"}) EXPECT_THROW(parse_job_name(bad, "name"), convert::InputError);
}

}  // namespace
}  // namespace seaway::rpc
