// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/malformed.hpp"

#include <grpcpp/support/interceptor.h>

#include <string_view>

#include "server/rpc/status.hpp"

namespace seaway::rpc {
namespace {

using grpc::experimental::InterceptionHookPoints;

class MalformedAnswer final : public grpc::experimental::Interceptor {
 public:
  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::PRE_SEND_STATUS) &&
        methods->GetSendStatus().error_code() == grpc::StatusCode::UNIMPLEMENTED)
      methods->ModifySendStatus(make_status(grpc::StatusCode::INVALID_ARGUMENT, "MALFORMED",
                                            "the bytes are not a request of this method; build the message from "
                                            "seaway/v1/job_service.proto, with texts in UTF-8"));
    methods->Proceed();
  }
};

class Factory final : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  grpc::experimental::Interceptor* CreateServerInterceptor(grpc::experimental::ServerRpcInfo* info) override {
    // Methods that do not exist come as streams in both directions, of which we have none.
    const bool ours = std::string_view(info->method()).starts_with("/seaway.") && info->type() != grpc::experimental::ServerRpcInfo::Type::BIDI_STREAMING;
    return ours ? new MalformedAnswer : nullptr;  // gRPC deletes it
  }
};

}  // namespace

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> make_malformed_answer() { return std::make_unique<Factory>(); }

}  // namespace seaway::rpc
