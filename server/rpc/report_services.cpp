// SPDX-License-Identifier: GPL-3.0-or-later
// The methods of Reports and Sweeps.
#include <set>

#include "core/motion/pose.hpp"
#include "server/convert/result.hpp"
#include "server/jobs/submission.hpp"
#include "server/reports/decay_report.hpp"
#include "server/reports/rao_report.hpp"
#include "server/rpc/answer.hpp"

namespace seaway::rpc {
namespace {

constexpr int most_jobs_in_a_report = 1000;

/// A run out of the store, with those of its channels that are wanted.
reports::Run load_run(const Backend& b, const store::Job& job, const std::set<std::string>& wanted) {
  reports::Run run;
  run.source = "jobs/" + job.uid;
  run.title = job.title;
  run.message = jobs::decode_spec(job.spec).case_();
  run.has_case = true;
  const auto channels = b.store.channels(job.uid);
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (!wanted.contains(channels[c].name)) continue;
    columns.push_back(c);
    run.history.channels.push_back({channels[c].name, convert::edge_unit(channels[c].unit), {}});
  }
  for (std::int64_t after = 0;;) {
    const auto samples = b.store.samples(job.uid, after, 10'000);
    if (samples.empty()) return run;
    after = samples.back().sequence;
    for (const store::Sample& s : samples) {
      run.history.stages.push_back(s.stage);
      run.history.times.push_back(s.time);
      for (std::size_t k = 0; k < columns.size(); ++k)
        run.history.channels[k].values.push_back(convert::edge_value(channels[columns[k]].unit, s.values.at(columns[k])));
    }
  }
}

const std::set<std::string> motions(motion::dof_names.begin(), motion::dof_names.end());

store::Sweep find_sweep(const Backend& b, const std::string& name, const std::string& field) {
  const std::string uid = parse_sweep_name(name, field);
  auto sweep = b.store.find_sweep(uid);
  if (!sweep) fail(ErrorCode::not_found, "sweep {} does not exist; list the sweeps to find its name", uid);
  return std::move(*sweep);
}

/// A job that has not come to its end may still be in an early stage or grow: its numbers say so.
v1::RaoPoint rao_point(const reports::Run& run, const store::Job& job, const v1::RaoOptions& options) {
  v1::RaoPoint point = reports::make_rao_point(run, options);
  if (job.state != store::State::succeeded && point.motions_size() > 0)
    point.set_message(fmt::format("{}the job is {}, in stage {} of {}", point.message().empty() ? "" : point.message() + "; ",
                                  store::to_string(job.state), job.progress.stage + 1, job.progress.stage_count));
  return point;
}

v1::RaoReport rao_of_sweep(const Backend& b, const store::Sweep& sweep, const v1::RaoOptions& options) {
  std::vector<v1::RaoPoint> points;
  for (const store::SweepMember& member : sweep.members) {
    const auto job = b.store.find(member.uid);
    if (!job) continue;  // deleted
    reports::Run run = load_run(b, *job, motions);
    run.case_name = member.point.case_name;
    points.push_back(rao_point(run, *job, options));
  }
  return reports::make_rao_report(sweep.title, std::move(points));
}

v1::RaoReport rao_of_jobs(const Backend& b, const v1::GetRaoReportRequest& request) {
  std::vector<v1::RaoPoint> points;
  for (int i = 0; i < request.jobs_size(); ++i) {
    const store::Job job = find_job(b, request.jobs(i), fmt::format("jobs[{}]", i));
    points.push_back(rao_point(load_run(b, job, motions), job, request.options()));
  }
  const std::string title = points.size() == 1 ? points.front().title() : "";
  return reports::make_rao_report(title, std::move(points));
}

}  // namespace

grpc::ServerUnaryReactor* ReportsService::GetDecayReport(grpc::CallbackServerContext* context,
                                                         const v1::GetDecayReportRequest* request,
                                                         v1::DecayReport* response) {
  return answer(b_, context, {Role::viewer, "GetDecayReport"}, request->job(), [b = b_, request, response] {
    const v1::DecayOptions& options = request->options();
    reports::check_options(options);
    const store::Job job = find_job(b, request->job(), "job");
    std::vector<std::string> names;
    for (const store::Channel& channel : b.store.channels(job.uid)) names.push_back(channel.name);
    const std::string channel = reports::find_channel("jobs/" + job.uid, names, options);
    *response = reports::make_decay_report(load_run(b, job, {channel}), options);
  });
}

grpc::ServerUnaryReactor* ReportsService::GetRaoReport(grpc::CallbackServerContext* context,
                                                       const v1::GetRaoReportRequest* request, v1::RaoReport* response) {
  const std::string target = request->sweep().empty() ? "jobs" : request->sweep();
  return answer(b_, context, {Role::viewer, "GetRaoReport"}, target, [b = b_, request, response] {
    reports::check_options(request->options());
    if (request->sweep().empty() == (request->jobs_size() == 0))
      refuse_field("jobs", request->sweep().empty() ? "and sweep are both missing" : "and sweep are both given", "give one of them");
    if (request->jobs_size() > most_jobs_in_a_report)
      refuse_field("jobs", fmt::format("{} jobs", request->jobs_size()), fmt::format("at most {}", most_jobs_in_a_report));
    *response = request->sweep().empty() ? rao_of_jobs(b, *request)
                                         : rao_of_sweep(b, find_sweep(b, request->sweep(), "sweep"), request->options());
  });
}

grpc::ServerUnaryReactor* SweepsService::CreateSweep(grpc::CallbackServerContext* context,
                                                     const v1::CreateSweepRequest* request,
                                                     v1::CreateSweepResponse* response) {
  return answer(b_, context, {Role::submitter, "CreateSweep"}, "cases/" + request->title(), [b = b_, request, response] {
    jobs::SubmittedSweep submitted = b.queue.submit_sweep(*request);
    for (auto& report : submitted.reports) *response->add_reports() = std::move(report);
    if (submitted.has_sweep) *response->mutable_sweep() = to_proto(submitted.sweep, true);
  });
}

grpc::ServerUnaryReactor* SweepsService::GetSweep(grpc::CallbackServerContext* context, const v1::GetSweepRequest* request,
                                                  v1::Sweep* response) {
  return answer(b_, context, {Role::viewer, "GetSweep"}, request->name(),
                [b = b_, request, response] { *response = to_proto(find_sweep(b, request->name(), "name"), true); });
}

grpc::ServerUnaryReactor* SweepsService::ListSweeps(grpc::CallbackServerContext* context,
                                                    const v1::ListSweepsRequest* request, v1::ListSweepsResponse* response) {
  return answer(b_, context, {Role::viewer, "ListSweeps"}, "sweeps", [b = b_, request, response] {
    const int limit = page_size(request->page_size(), 50, 1000);
    const auto sweeps = b.store.list_sweeps(parse_sweep_token(request->page_token()), limit);
    for (const store::Sweep& sweep : sweeps) *response->add_sweeps() = to_proto(sweep, false);
    if (static_cast<int>(sweeps.size()) == limit) response->set_next_page_token(make_sweep_token(sweeps.back().id));
  });
}

grpc::ServerUnaryReactor* SweepsService::CancelSweep(grpc::CallbackServerContext* context,
                                                     const v1::CancelSweepRequest* request, v1::Sweep* response) {
  return answer(b_, context, {Role::submitter, "CancelSweep"}, request->name(), [b = b_, request, response] {
    *response = to_proto(b.queue.cancel_sweep(parse_sweep_name(request->name(), "name")), true);
  });
}

}  // namespace seaway::rpc
