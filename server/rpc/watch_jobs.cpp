// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/rpc/watch_jobs.hpp"

#include "core/base/error.hpp"
#include "server/rpc/messages.hpp"

namespace seaway::rpc {

void WatchJobsCall::join(v1::WatchJobsResponse& response) {
  if (request_.after_revision() < 0) refuse_field("after_revision", "is negative", "0 starts at the first that is kept");
  feeds_.join_all(this, std::static_pointer_cast<WatchJobsCall>(shared_from_this()));
  joined_ = true;
  const store::ChangeRange range = store_.change_range();
  cursor_ = request_.after_revision() == 0 ? range.first - 1 : request_.after_revision();
  if (cursor_ > range.latest || cursor_ < range.first - 1)
    throw OutOfRange("after_revision " + std::to_string(cursor_) + "; kept are changes " + std::to_string(range.first) + " to " +
                     std::to_string(range.latest) + ": list the jobs and begin anew");
  response.mutable_header()->set_first_available(range.first);
  response.mutable_header()->set_latest(range.latest);
}

StreamCall<v1::WatchJobsResponse>::Next WatchJobsCall::next(v1::WatchJobsResponse& response, bool idle) {
  if (!joined_) {
    join(response);
    return Next::message;
  }
  if (ready_.empty())
    for (store::Change& change : store_.changes(cursor_, 100)) ready_.push_back(std::move(change));
  if (ready_.empty()) {
    if (!idle) return Next::nothing;
    response.set_mark(cursor_);
    return Next::message;
  }
  const store::Change change = std::move(ready_.front());
  ready_.pop_front();
  // Old changes are pruned while a slow client reads them: better to end than to leave some out.
  if (change.revision != cursor_ + 1)
    throw OutOfRange("change " + std::to_string(cursor_ + 1) + " is not kept any more: list the jobs and begin anew");
  cursor_ = change.revision;
  auto& m = *response.mutable_change();
  m.set_revision(change.revision);
  m.set_kind(change.kind);
  m.set_name("jobs/" + change.uid);
  m.set_state(static_cast<v1::Job::State>(change.state));
  m.mutable_time()->set_seconds(change.time_ns / 1'000'000'000);
  m.mutable_time()->set_nanos(static_cast<std::int32_t>(change.time_ns % 1'000'000'000));
  if (auto job = store_.find(change.uid)) *m.mutable_job() = to_proto(*job);
  return Next::message;
}

void WatchJobsCall::on_done() { feeds_.leave_all(this); }

}  // namespace seaway::rpc
