// SPDX-License-Identifier: GPL-3.0-or-later
// The filter of a list, down to its SQL: a ListJobsRequest against a small store.
#include <filesystem>
#include <memory>

#include "seaway/v1/job_service.pb.h"
#include "server/convert/input_error.hpp"
#include "server/jobs/queue.hpp"
#include "server/jobs/requests.hpp"
#include "server/rpc/messages.hpp"
#include "server/store/sqlite_store.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace seaway {
namespace {

std::unique_ptr<store::JobStore> make_store() {
  std::string folder = (std::filesystem::temp_directory_path() / "seaway-fuzz-XXXXXX").string();
  fuzz::require(::mkdtemp(folder.data()) != nullptr, "no folder");
  store::SqliteOptions options;
  options.path = folder + "/seaway.db";
  options.readers = 1;
  auto store = store::open_sqlite_store(options);
  for (int i = 0; i < 20; ++i) {
    store::NewJob job;
    job.uid = "job" + std::to_string(i);
    job.request_id = "request" + std::to_string(i);
    job.labels = {{"ship", i % 2 == 0 ? "a" : "b"}, {"n", std::to_string(i)}};
    job.held = i % 3 == 0;
    store->create(job);
  }
  std::filesystem::remove_all(folder);  // open files stay until the end
  return store;
}

}  // namespace
}  // namespace seaway

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seaway;
  static const std::unique_ptr<store::JobStore> store = make_store();
  v1::ListJobsRequest request;
  if (!request.ParseFromArray(data, static_cast<int>(size))) return 0;
  store::ListQuery query;
  query.labels = {request.labels().begin(), request.labels().end()};
  for (const int state : request.states())
    if (state >= v1::Job::STATE_QUEUED && state <= v1::Job::STATE_CANCELLED) query.states.push_back(static_cast<store::State>(state));
  try {
    jobs::check_labels("labels", query.labels);
    query.before_id = rpc::parse_page_token(request.page_token(), query);
  } catch (const convert::InputError&) {
    return 0;
  }
  for (const store::Job& job : store->list(query)) {
    for (const auto& [key, value] : query.labels) fuzz::require(job.labels.count(key) > 0 && job.labels.at(key) == value, "a job without the label");
    bool of_state = query.states.empty();
    for (const store::State state : query.states) of_state = of_state || job.state == state;
    fuzz::require(of_state, "a job of another state");
  }
  return 0;
}
