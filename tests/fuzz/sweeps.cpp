// SPDX-License-Identifier: GPL-3.0-or-later
// Requests of Sweeps, through the queue into a small store, and options of Reports against a history that the input makes
// up. The first byte chooses.
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "core/base/error.hpp"
#include "seaway/v1/job_service.pb.h"
#include "server/convert/input_error.hpp"
#include "server/jobs/queue.hpp"
#include "server/reports/decay_report.hpp"
#include "server/reports/rao_report.hpp"
#include "server/store/sqlite_store.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace seaway {
namespace {

constexpr int room = 40;  ///< jobs that may wait

/// Queue and store in a folder that is gone from the disk with the process.
struct Place {
  std::string folder;
  std::unique_ptr<store::JobStore> store;
  std::unique_ptr<jobs::Workspace> workspace;
  std::unique_ptr<jobs::Queue> queue;
  Place() {
    const bool memory = std::filesystem::is_directory("/dev/shm");
    folder = ((memory ? "/dev/shm" : std::filesystem::temp_directory_path()) / std::filesystem::path("seaway-fuzz-XXXXXX")).string();
    fuzz::require(::mkdtemp(folder.data()) != nullptr, "no folder");
    store::SqliteOptions options;
    options.path = folder + "/seaway.db";
    options.readers = 1;
    store = store::open_sqlite_store(options);
    workspace = std::make_unique<jobs::Workspace>(folder);
    jobs::Solver solver;
    solver.check = [](const sim::Case&) { return sim::CaseReport{}; };
    const auto nothing = [](const std::string&) {};
    queue = std::make_unique<jobs::Queue>(jobs::QueueLimits{room, 0}, solver, *workspace, *store, [] {}, nothing, nothing);
  }
  ~Place() { std::filesystem::remove_all(folder); }
};

/// The request becomes a whole sweep whose jobs can be read, or nothing at all; asked again it is the same one.
void sweep(const std::string& bytes) {
  static Place place;
  v1::CreateSweepRequest request;
  if (!request.ParseFromString(bytes)) return;
  jobs::SubmittedSweep made;
  try {
    made = place.queue->submit_sweep(request);
  } catch (const Error&) {  // InputError too
    store::ListQuery all;
    all.limit = 1;
    fuzz::require(place.store->list(all).empty() && place.store->list_sweeps(0, 1).empty(), "a refused sweep has left something");
    return;
  }
  fuzz::require(made.has_sweep != request.validate_only(), "a check has made a sweep");
  if (!made.has_sweep) return;
  fuzz::require(made.sweep.members.size() == made.reports.size() && made.reports.size() <= room, "jobs without reports");
  for (const store::SweepMember& member : made.sweep.members) {
    const auto job = place.store->find(member.uid);
    fuzz::require(job.has_value() && job->labels.at("sweep") == made.sweep.uid, "a job is missing");
    jobs::bind_case(jobs::decode_spec(job->spec).case_(), jobs::decode_spec(job->spec).files(), *place.workspace);
  }
  fuzz::require(place.queue->submit_sweep(request).sweep.uid == made.sweep.uid, "one request, two sweeps");
  place.queue->cancel_sweep(made.sweep.uid);
  for (const store::SweepMember& member : made.sweep.members) place.queue->erase(member.uid);
  fuzz::require(!place.store->find_sweep(made.sweep.uid).has_value(), "a sweep without jobs is left");
  place.store->prune(0, std::int64_t{1} << 62);  // the request may come again
}

/// A run of this case, with the letters of the channel's name as its numbers.
reports::Run run_of(v1::Case message, const std::string& shape) {
  reports::Run run;
  run.source = "jobs/abc";
  run.has_case = true;
  run.message = std::move(message);
  run.history.channels = {{"roll", "deg", {}}, {"heave", "m", {}}};
  for (std::size_t i = 0; i < shape.size(); ++i) {
    run.history.stages.push_back(0);
    run.history.times.push_back(0.1 * static_cast<double>(i));
    const double value = shape[i] == '\x7f' ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(shape[i]) - 64;
    for (auto& channel : run.history.channels) channel.values.push_back(value);
  }
  return run;
}

void report(const std::string& bytes) {
  v1::DecayOptions decay;
  v1::RaoOptions rao;
  v1::Case message;
  std::string_view rest = bytes;
  if (!decay.ParseFromString(fuzz::take_part(rest)) || !rao.ParseFromString(fuzz::take_part(rest)) ||
      !message.ParseFromString(std::string(rest)))
    return;
  const reports::Run run = run_of(std::move(message), decay.channel());
  decay.clear_channel();
  try {
    const v1::DecayReport out = reports::make_decay_report(run, decay);
    fuzz::require(out.channel() == "roll" && std::isfinite(out.damped_cosine().period_s().value()), "a decay without a period");
  } catch (const Error&) {
  }
  try {
    reports::check_options(rao);
    const v1::RaoPoint point = reports::make_rao_point(run, rao);
    fuzz::require(point.motions_size() > 0 || !point.message().empty(), "an RAO without numbers and without a word");
  } catch (const convert::InputError&) {
  }
}

}  // namespace
}  // namespace seaway

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes(seaway::fuzz::view(data + 1, size - 1));
  if (data[0] % 2 == 0)
    seaway::sweep(bytes);
  else
    seaway::report(bytes);
  return 0;
}
