// SPDX-License-Identifier: GPL-3.0-or-later
// What the methods of the services have in common: access, audit trail, names, pages.
#pragma once

#include <fmt/format.h>

#include <string>

#include "core/base/error.hpp"
#include "server/rpc/messages.hpp"
#include "server/rpc/services.hpp"
#include "server/rpc/unary.hpp"

namespace seaway::rpc {

/// Who may call what, and the name of it for the audit trail.
struct Method {
  Role role;
  const char* name;
};

inline std::string message_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const std::exception& e) {
    return e.what();
  }
}

/// As answer(), for work that calls the Finish that it is given when it is done.
template <class Work>
grpc::ServerUnaryReactor* answer_later(const Backend& b, grpc::CallbackServerContext* context, Method method,
                                       const std::string& target, Work work) {
  return run_unary(context, b.registry, b.work, [b, context, method, target, work = std::move(work)](Finish finish) mutable {
    const std::string who = b.access.check(*context, method.role, method.name, target);
    const Finish record = [b, context, method, target, who, finish](const std::exception_ptr& error) {
      if (method.role != Role::viewer) b.access.record(*context, who, method.name, target, error ? message_of(error) : "OK");
      finish(error);
    };
    try {
      work(record);
    } catch (...) {
      record(std::current_exception());
    }
  });
}

/// What changes something is recorded, with what came of it.
template <class Work>
grpc::ServerUnaryReactor* answer(const Backend& b, grpc::CallbackServerContext* context, Method method,
                                 const std::string& target, Work work) {
  return answer_later(b, context, method, target, [work = std::move(work)](const Finish& finish) mutable {
    work();
    finish(nullptr);
  });
}

inline store::Job find_job(const Backend& b, const std::string& name, const std::string& field) {
  const std::string uid = parse_job_name(name, field);
  auto job = b.store.find(uid);
  if (!job) fail(ErrorCode::not_found, "job {} does not exist; list the jobs to find its name", uid);
  return std::move(*job);
}

inline int page_size(int wanted, int normal, int largest) {
  if (wanted < 0 || wanted > largest)
    refuse_field("page_size", fmt::format("{} is not allowed", wanted), fmt::format("must be 0 to {}", largest));
  return wanted == 0 ? normal : wanted;
}

}  // namespace seaway::rpc
