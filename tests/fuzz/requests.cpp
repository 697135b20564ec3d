// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes of requests, and of the records that a worker sends. The first byte chooses.
#include "core/base/error.hpp"
#include "seaway/v1/job_service.pb.h"
#include "seaway/worker/attempt.pb.h"
#include "server/convert/case.hpp"
#include "server/convert/input_error.hpp"
#include "server/jobs/frames.hpp"
#include "server/jobs/queue.hpp"
#include "server/jobs/requests.hpp"
#include "server/jobs/submission.hpp"
#include "server/rpc/messages.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace seaway {
namespace {

void submit(const std::string& bytes) {
  v1::CreateJobRequest request;
  if (!request.ParseFromString(bytes)) return;
  try {
    jobs::check_labels("labels", {request.labels().begin(), request.labels().end()});
    jobs::check_files(request.files());
    const std::string spec = jobs::encode_spec(request.case_(), request.files());
    const v1::CreateJobRequest stored = jobs::decode_spec(spec);
    fuzz::require(jobs::encode_spec(stored.case_(), stored.files()) == spec, "the digest of a stored case changes");
    fuzz::require(jobs::differing_fields(spec, spec).empty(), "a case differs from itself");
    convert::to_core(request.case_());
  } catch (const convert::InputError&) {
  }
}

void update(const std::string& bytes) {
  v1::UpdateJobRequest request;
  if (!request.ParseFromString(bytes)) return;
  try {
    jobs::check_labels("job.labels", {request.job().labels().begin(), request.job().labels().end()});
    const std::string uid = rpc::parse_job_name(request.job().name(), "job.name");
    fuzz::require(uid.find_first_of("/.\\") == uid.npos && uid.size() <= 63, "a uid that could be a path");
  } catch (const convert::InputError&) {
  }
}

void records(const std::string& bytes) {
  jobs::FrameReader frames;
  // In two pieces, as they come through a pipe; also as the content of a whole frame.
  try {
    frames.feed(std::string_view(bytes).substr(0, bytes.size() / 2));
    while (frames.next()) {
    }
    frames.feed(std::string_view(bytes).substr(bytes.size() / 2));
    while (frames.next()) {
    }
  } catch (const Error& error) {
    fuzz::require(error.code() == ErrorCode::data_loss, "a damaged record is something else");
  }
  jobs::FrameReader whole;
  whole.feed(jobs::make_frame(bytes));
  fuzz::require(whole.next() == bytes && whole.left_over() == 0, "a frame does not give back its content");
  worker::Record().ParseFromString(bytes);
}

}  // namespace
}  // namespace seaway

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes(seaway::fuzz::view(data + 1, size - 1));
  switch (data[0] % 3) {
    case 0: seaway::submit(bytes); break;
    case 1: seaway::update(bytes); break;
    default: seaway::records(bytes);
  }
  return 0;
}
