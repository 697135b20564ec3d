// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/watch.hpp"

#include "core/base/error.hpp"
#include "server/rpc/messages.hpp"

namespace seaway::rpc {

void WatchCall::join() {
  uid_ = parse_job_name(request_.job(), "job");
  if (request_.after_sequence() < 0) refuse_field("after_sequence", "is negative", "0 starts at the first sample");
  cursor_ = request_.after_sequence();
  feed_ = feeds_.join(uid_, this, std::static_pointer_cast<WatchCall>(shared_from_this()));
  joined_ = true;
}

std::int64_t WatchCall::lag() {
  if (!joined_) return 0;
  try {
    return feed_->snapshot()->job.last_sequence - cursor_;
  } catch (const Error&) {
    return 0;  // the job has been deleted: the stream ends soon
  }
}

void WatchCall::check_cursor(const Snapshot& now) {
  if (cursor_ > now.job.last_sequence)
    throw OutOfRange("after_sequence " + std::to_string(cursor_.load()) + " is beyond the latest sample " +
                     std::to_string(now.job.last_sequence) + "; available are samples from 1 on");
}

StreamCall<v1::WatchSamplesResponse>::Next WatchCall::next(v1::WatchSamplesResponse& response, bool idle) {
  if (feed_ == nullptr) join();
  const auto now = feed_->snapshot();
  if (header_attempt_ != now->job.attempt || header_channels_ != now->channels.size()) {
    if (header_attempt_ < 0) check_cursor(*now);
    header_attempt_ = now->job.attempt;
    header_channels_ = now->channels.size();
    v1::StreamHeader& header = *response.mutable_header();
    header.set_first_available(1);
    header.set_latest(now->job.last_sequence);
    header.set_attempt(now->job.attempt);
    *header.mutable_channels() = to_proto(now->channels);
    return Next::message;
  }
  if (const auto chunk = feed_->chunk(cursor_, *now)) {
    *response.mutable_chunk() = *chunk;
    cursor_ = chunk->first_sequence() + chunk->times_s_size() - 1;
    return Next::message;
  }
  v1::ProgressMark& mark = *response.mutable_mark();
  mark.set_sequence(cursor_);
  mark.set_state(static_cast<v1::Job::State>(now->job.state));
  mark.set_state_reason(static_cast<v1::Job::Reason>(now->job.reason));
  mark.set_state_message(now->job.message);
  *mark.mutable_progress() = to_proto(now->job.progress);
  std::string bytes = mark.SerializeAsString();
  if (bytes != last_mark_ || idle) {
    last_mark_ = std::move(bytes);
    return Next::message;
  }
  return store::is_terminal(now->job.state) ? Next::end : Next::nothing;
}

void WatchCall::on_done() {
  if (feed_ != nullptr) feeds_.leave(uid_, this);
}

}  // namespace seaway::rpc
