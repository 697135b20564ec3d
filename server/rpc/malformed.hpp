// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes that are no message of the method: gRPC 1.51 answers them with UNIMPLEMENTED and without a text, as if the method
// did not exist. Here they get INVALID_ARGUMENT with advice.
#pragma once

#include <grpcpp/support/server_interceptor.h>

#include <memory>

namespace seaway::rpc {

/// Takes the place of a status UNIMPLEMENTED of our services, all methods of which are implemented.
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> make_malformed_answer();

}  // namespace seaway::rpc
