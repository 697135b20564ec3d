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

/// What changes something is recorded, with what came of it.
template <class Work>
grpc::ServerUnaryReactor* answer(const Backend& b, grpc::CallbackServerContext* context, Method method,
                                 const std::string& target, Work work) {
  return run_unary(context, b.registry, b.work, [b, context, method, target, work = std::move(work)]() mutable {
    const std::string who = b.access.check(*context, method.role, method.name, target);
    try {
      work();
    } catch (const std::exception& error) {
      if (method.role != Role::viewer) b.access.record(*context, who, method.name, target, error.what());
      throw;
    }
    if (method.role != Role::viewer) b.access.record(*context, who, method.name, target, "OK");
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
