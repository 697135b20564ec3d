// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps: one request becomes many jobs that differ in wave or condition.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "server/convert/input_error.hpp"
#include "server/jobs/queue.hpp"
#include "server/jobs/requests.hpp"
#include "server/jobs/submission.hpp"

namespace seaway::jobs {
namespace {

constexpr std::size_t most_jobs = 1000;

using Values = google::protobuf::RepeatedField<double>;

std::string encode_sweep(const v1::CreateSweepRequest& request) {
  v1::CreateSweepRequest spec = request;
  spec.clear_request_id();
  spec.clear_validate_only();
  return serialise(spec);
}

void check_values(const std::string& field, const Values& values) {
  std::set<double> seen;
  for (int i = 0; i < values.size(); ++i) {
    const std::string path = fmt::format("{}[{}]", field, i);
    if (!std::isfinite(values[i])) refuse("INVALID_REQUEST", path, "is not finite", "give a number");
    if (!seen.insert(values[i]).second) refuse("INVALID_REQUEST", path, fmt::format("{} is there twice", values[i]), "give each value once");
  }
}

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 40 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  });
}

void check_request(const v1::CreateSweepRequest& r) {
  if (!r.validate_only() && !is_uuid(r.request_id()))
    refuse("INVALID_REQUEST", "request_id", r.request_id().empty() ? "is missing" : "is not a UUID",
           "make a new UUID for each sweep and send the same one again after a lost answer");
  check_traits("", r.priority(), {r.labels().begin(), r.labels().end()}, r.note());
  if (r.labels().contains("sweep")) refuse("INVALID_REQUEST", "labels.sweep", "is set by the service", "use another key");
  if (r.title().size() > 200) refuse("INVALID_REQUEST", "title", fmt::format("{} bytes", r.title().size()), "at most 200");
  if (!is_text(r.title())) refuse("INVALID_REQUEST", "title", "has control characters", "write one line of text");
  if (r.cases_size() == 0) refuse("INVALID_REQUEST", "cases", "is empty", "give at least one case in regular waves");
  std::set<std::string> names;
  for (int i = 0; i < r.cases_size(); ++i) {
    const std::string path = fmt::format("cases[{}]", i);
    if (!is_name(r.cases(i).name()))
      refuse("INVALID_REQUEST", path + ".name", r.cases(i).name().empty() ? "is missing" : "is no name", "1 to 40 letters, digits, _, - and dots");
    if (!names.insert(r.cases(i).name()).second) refuse("INVALID_REQUEST", path + ".name", "'" + r.cases(i).name() + "' is used twice", "give each case its own name");
    if (!r.cases(i).case_().wave().has_regular())
      refuse("INVALID_REQUEST", path + ".case.wave", "is no regular wave", "a sweep varies period, height and heading of wave.regular");
  }
  check_values("periods_s", r.periods_s());
  check_values("heights_m", r.heights_m());
  check_values("headings_deg", r.headings_deg());
  const auto ways = [](const Values& v) { return static_cast<std::size_t>(std::max(1, v.size())); };
  const std::size_t n = static_cast<std::size_t>(r.cases_size()) * ways(r.periods_s()) * ways(r.heights_m()) * ways(r.headings_deg());
  if (n > most_jobs) refuse("INVALID_REQUEST", "cases", fmt::format("{} jobs", n), fmt::format("at most {} in one sweep", most_jobs));
}

/// One job to be: the case as it will run, and what is particular about it.
struct Planned {
  v1::Case message;
  const Files* files;
  store::SweepPoint point;
  int base = 0;                                ///< which of the cases
  int heading = -1, height = -1, period = -1;  ///< which of the values; -1: what the case says
  std::string text = {};                       ///< what is particular, for people
};

store::SweepPoint point_of(const std::string& case_name, const v1::RegularWave& w) {
  const double period = w.has_period_s() ? w.period_s() : w.has_frequency_hz() && w.frequency_hz() > 0 ? 1 / w.frequency_hz() : 0;
  return {case_name, period, w.height_m(), w.has_heading_deg() ? w.heading_deg() : 90};
}

/// Applies the i-th value of each list that has any; -1: the list is empty.
Planned plan_one(const v1::CreateSweepRequest& r, int base_index, int heading, int height, int period) {
  const v1::SweepCase& base = r.cases(base_index);
  Planned out{base.case_(), &base.files(), {}, base_index, heading, height, period};
  v1::RegularWave& wave = *out.message.mutable_wave()->mutable_regular();
  std::string& text = out.text = r.cases_size() > 1 ? base.name() : "";
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (heading >= 0) {
    wave.set_heading_deg(r.headings_deg(heading));
    add(fmt::format("{:.6g} deg", r.headings_deg(heading)));
  }
  if (height >= 0) {
    wave.set_height_m(r.heights_m(height));
    add(fmt::format("H {:.6g} m", r.heights_m(height)));
  }
  if (period >= 0) {
    wave.clear_length_m();
    wave.clear_frequency_hz();
    wave.set_period_s(r.periods_s(period));
    add(fmt::format("T {:.6g} s", r.periods_s(period)));
  }
  if (!text.empty()) out.message.set_title(fmt::format("{} ({})", out.message.title().substr(0, 120), text));
  out.point = point_of(base.name(), wave);
  return out;
}

std::vector<Planned> plan(const v1::CreateSweepRequest& r) {
  std::vector<Planned> out;
  const auto first = [](const Values& v) { return v.empty() ? -1 : 0; };
  for (int base = 0; base < r.cases_size(); ++base)
    for (int heading = first(r.headings_deg()); heading < r.headings_deg_size(); ++heading)
      for (int height = first(r.heights_m()); height < r.heights_m_size(); ++height)
        for (int period = first(r.periods_s()); period < r.periods_s_size(); ++period)
          out.push_back(plan_one(r, base, heading, height, period));
  return out;
}

/// Where a field of a job's case stands in the request.
std::string field_in_request(const Planned& job, const std::string& field) {
  if (field == "wave.regular.heading_deg" && job.heading >= 0) return fmt::format("headings_deg[{}]", job.heading);
  if (field == "wave.regular.height_m" && job.height >= 0) return fmt::format("heights_m[{}]", job.height);
  if (field == "wave.regular.period_s" && job.period >= 0) return fmt::format("periods_s[{}]", job.period);
  return fmt::format("cases[{}].{}{}", job.base, field.starts_with("files") ? "" : "case.", field);
}

/// Problems of one job, with the job that they belong to.
[[noreturn]] void rethrow_for(const Planned& job, const convert::InputError& error) {
  std::vector<sim::Diagnostic> problems = error.problems();
  for (auto& p : problems) {
    p.field = field_in_request(job, p.field);
    if (!job.text.empty()) p.message += " (" + job.text + ")";
  }
  throw convert::InputError(error.reason(), std::move(problems));
}

}  // namespace

SubmittedSweep Queue::submit_sweep(const v1::CreateSweepRequest& request) {
  check_request(request);
  SubmittedSweep out;
  const std::vector<Planned> planned = plan(request);
  for (const Planned& job : planned) {
    try {
      check_files(*job.files);
      out.reports.push_back(report_of(job.message, *job.files, sha256_hex(encode_spec(job.message, *job.files))));
      if (!request.validate_only()) require_runnable(out.reports.back());
    } catch (const convert::InputError& error) {
      rethrow_for(job, error);
    }
  }
  if (request.validate_only()) return out;
  store::NewSweep sweep;
  sweep.uid = make_uid_();
  sweep.request_id = lower(request.request_id());
  sweep.title = request.title().empty() ? request.cases(0).case_().title() : request.title();
  sweep.spec = encode_sweep(request);
  sweep.digest = sha256_hex(sweep.spec);
  sweep.code_version = code_version();
  for (std::size_t i = 0; i < planned.size(); ++i) {
    store::NewJob job;
    job.uid = make_uid_();
    job.request_id = fmt::format("{}/{}", sweep.request_id, i);  // no client can send such a one
    job.title = planned[i].message.title();
    job.spec = encode_spec(planned[i].message, *planned[i].files);
    job.digest = sha256_hex(job.spec);
    job.code_version = sweep.code_version;
    job.priority = request.priority();
    job.labels = {request.labels().begin(), request.labels().end()};
    job.labels["sweep"] = sweep.uid;
    job.note = request.note();
    job.held = request.start_held();
    sweep.jobs.push_back(std::move(job));
    sweep.points.push_back(planned[i].point);
  }
  store::CreatedSweep created = store_.create_sweep(sweep, limits_.queued_jobs);
  if (created.existed && created.sweep.digest != sweep.digest)
    refuse("REQUEST_ID_REUSED", "request_id", "is in use by sweep " + created.sweep.uid + ", which asks for something else",
           "a request id belongs to one sweep: use a new one");
  if (!created.existed) wake_();
  out.has_sweep = true;
  out.sweep = std::move(created.sweep);
  return out;
}

store::Sweep Queue::cancel_sweep(const std::string& uid) {
  const auto sweep = store_.find_sweep(uid);
  if (!sweep) fail(ErrorCode::not_found, "sweep {} does not exist; list the sweeps to find its name", uid);
  // Backwards: what waits goes first, so that no worker takes it when the running one ends.
  for (auto member = sweep->members.rbegin(); member != sweep->members.rend(); ++member) {
    if (!member->exists || store::is_terminal(member->state)) continue;
    try {
      cancel(member->uid);
    } catch (const Error& error) {  // it has ended or was deleted in between
      if (error.code() != ErrorCode::failed_precondition && error.code() != ErrorCode::not_found) throw;
    }
  }
  return store_.find_sweep(uid).value_or(*sweep);  // its last job may have been deleted in between
}

}  // namespace seaway::jobs
