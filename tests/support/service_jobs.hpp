// SPDX-License-Identifier: GPL-3.0-or-later
// Cases and waiting, for tests of the service.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>

#include "proto/yaml.hpp"
#include "seaway/v1/job_service.pb.h"
#include "server/store/sqlite_store.hpp"

namespace seaway::testing {

/// tests/e2e/small.yaml with other stage lengths [s]; a step is 0.01 s.
inline v1::Case small_case(double duration_s = 0.5) {
  v1::Case m;
  yaml::read_file(SEAWAY_SOURCE_DIR "/tests/e2e/small.yaml", m);
  for (auto& stage : *m.mutable_cascade()->mutable_stages()) stage.mutable_end()->mutable_time()->set_duration_s(duration_s);
  return m;
}

/// A UUID out of a number.
inline std::string request_id(int n) {
  const std::string digits = std::to_string(n);
  return "00000000-0000-4000-8000-" + std::string(12 - digits.size(), '0') + digits;
}

inline v1::CreateJobRequest create_request(int id, const v1::Case& m) {
  v1::CreateJobRequest request;
  *request.mutable_case_() = m;
  request.set_request_id(request_id(id));
  return request;
}

/// A store in this folder that commits quickly.
inline std::unique_ptr<store::JobStore> open_store(const std::string& folder) {
  store::SqliteOptions options;
  options.path = folder + "/seaway.db";
  options.commit_interval = std::chrono::milliseconds(5);
  return store::open_sqlite_store(options);
}

/// Waits for commits until `done` holds for the job; false after 30 s.
inline bool wait_for_job(store::JobStore& store, const std::string& uid, const std::function<bool(const store::Job&)>& done) {
  std::mutex mutex;
  std::condition_variable wake;
  int commits = 0;
  const auto unsubscribe = store.subscribe([&](const std::set<std::string>&) {
    const std::lock_guard lock(mutex);
    ++commits;
    wake.notify_all();
  });
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  bool ok = false;
  for (;;) {
    int seen = 0;
    {
      const std::lock_guard lock(mutex);
      seen = commits;
    }
    const auto job = store.find(uid);
    if ((ok = job && done(*job))) break;
    std::unique_lock lock(mutex);
    if (!wake.wait_until(lock, deadline, [&] { return commits != seen; })) break;
  }
  unsubscribe();
  return ok;
}

inline bool wait_for_state(store::JobStore& store, const std::string& uid, store::State state) {
  return wait_for_job(store, uid, [&](const store::Job& job) { return job.state == state; });
}

}  // namespace seaway::testing
