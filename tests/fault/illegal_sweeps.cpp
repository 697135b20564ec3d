// SPDX-License-Identifier: GPL-3.0-or-later
// The table of illegal calls, part two: Sweeps and Reports.
#include "tests/fault/illegal_requests.hpp"

namespace seaway::stress {
namespace {

using grpc::StatusCode;
constexpr auto invalid = StatusCode::INVALID_ARGUMENT, missing = StatusCode::NOT_FOUND, state = StatusCode::FAILED_PRECONDITION,
               denied = StatusCode::PERMISSION_DENIED, unknown = StatusCode::UNAUTHENTICATED;
constexpr auto nobody = Caller::nobody, viewer = Caller::viewer, admin = Caller::admin;

std::string x(std::size_t n) { return std::string(n, 'x'); }

/// 0, 1, 2, ... as entries of a list.
std::string entries(const std::string& field, int n) {
  std::string out;
  for (int i = 0; i < n; ++i) out += field + ": " + std::to_string(0.001 * (i + 1)) + " ";
  return out;
}

const std::string create = "Sweeps.CreateSweep", one = "cases { name: 'intact' $case } ", id = "request_id: '$new' ", good = id + one;

/// What a sweep asks for beside its cases.
std::vector<IllegalRequest> traits() {
  return {{"no request id", admin, create, one, invalid, "request_id", "make a new UUID"},
          {"a request id that is no UUID", admin, create, one + "request_id: 'my sweep'", invalid, "request_id", "make a new UUID"},
          {"a known request id, another sweep", admin, create, one + "periods_s: 1.3 request_id: '$sweep_id'", invalid, "request_id",
           "use a new one"},
          {"the request id of a deleted sweep", admin, create, one + "start_held: true request_id: '$gone_sweep_id'", state, "",
           "use a new request id"},
          {"a long title", admin, create, good + "title: '" + x(201) + "'", invalid, "title", "at most 200"},
          {"a title that steers terminals", admin, create, good + "title: 'a\\033[2Jb'", invalid, "title", "one line"},
          {"too high a priority", admin, create, good + "priority: 101", invalid, "priority", "-100 to 100"},
          {"a label key with capitals", admin, create, good + "labels { key: 'Ship' value: 'a' }", invalid, "labels", "1 to 63 of a-z"},
          {"a long label", admin, create, good + "labels { key: 'ship' value: '" + x(256) + "' }", invalid, "labels.ship", "at most 255"},
          {"the label that the service sets", admin, create, good + "labels { key: 'sweep' value: 'mine' }", invalid, "labels.sweep",
           "another key"},
          {"a long note", admin, create, good + "note: '" + x(4001) + "'", invalid, "note", "at most 4000"},
          {"a note that steers terminals", admin, create, good + "note: 'a\\033[2Jb'", invalid, "note", "plain text"},
          {"a sweep over eight mebibytes", admin, create, good + "note: '" + x(9 << 20) + "'", StatusCode::RESOURCE_EXHAUSTED, "",
           "larger than max", "", true}};
}

std::vector<IllegalRequest> cases() {
  const std::string two = good + "cases { name: 'damaged' $case ";
  return {{"no case", admin, create, id, invalid, "cases", "at least one case"},
          {"a case without a name", admin, create, id + "cases { $case }", invalid, "cases[0].name", "1 to 40 letters"},
          {"a case that is a path", admin, create, id + "cases { name: '../x' $case }", invalid, "cases[0].name", "1 to 40 letters"},
          {"a case whose name steers terminals", admin, create, id + "cases { name: 'a\\033[2J' $case }", invalid, "cases[0].name",
           "1 to 40 letters"},
          {"a case with a long name", admin, create, id + "cases { name: '" + x(41) + "' $case }", invalid, "cases[0].name", "1 to 40 letters"},
          {"two cases of a name", admin, create, good + one, invalid, "cases[1].name", "its own name"},
          {"a case without a case", admin, create, id + "cases { name: 'a' }", invalid, "cases[0].case.wave", "wave.regular"},
          {"a case in calm water", admin, create, two + "case { wave { calm {} } } }", invalid, "cases[1].case.wave", "wave.regular"},
          {"a wrong case", admin, create, two + "case { dimension: 4 } }", invalid, "cases[1].case.dimension", "2 for a section"},
          {"a wrong case, only to check", admin, create, two + "case { dimension: 4 } } validate_only: true", invalid,
           "cases[1].case.dimension", "2 for a section"},
          {"a case that its own mass sinks", admin, create, two + "case { body { mass_kg_per_m: 1500 } } }", invalid,
           "cases[1].case.body.mass_kg_per_m", "lower the mass"},
          {"a file that the case does not name", admin, create, two + "files { name: 'hull.stl' content: 'a' } }", invalid, "cases[1].files",
           "leave it out"},
          {"a file given twice", admin, create, two + "files { name: 'a' } files { name: 'a' } }", invalid, "cases[1].files[1].name",
           "send each file once"},
          {"a file without a name", admin, create, two + "files { content: 'a' } }", invalid, "cases[1].files[0].name", "as in the case"}};
}

std::vector<IllegalRequest> values() {
  return {{"a period twice", admin, create, good + "periods_s: 1.2 periods_s: 1.2", invalid, "periods_s[1]", "each value once"},
          {"a height twice", admin, create, good + "heights_m: .02 heights_m: .03 heights_m: .02", invalid, "heights_m[2]", "each value once"},
          {"a period that is not a number", admin, create, good + "periods_s: nan", invalid, "periods_s[0]", "give a number"},
          {"an endless height", admin, create, good + "heights_m: inf", invalid, "heights_m[0]", "give a number"},
          {"a heading that is not a number", admin, create, good + "headings_deg: 90 headings_deg: nan", invalid, "headings_deg[1]",
           "give a number"},
          {"a negative period", admin, create, good + "periods_s: 1.2 periods_s: -1", invalid, "periods_s[1]", "> 0"},
          {"no height", admin, create, good + "heights_m: .03 heights_m: 0", invalid, "heights_m[1]", "> 0"},
          {"a breaking wave", admin, create, good + "heights_m: .03 heights_m: .6", invalid, "heights_m[1]", "lower the wave"},
          {"a head sea in a section", admin, create, good + "headings_deg: 90 headings_deg: 180", invalid, "headings_deg[1]", "90"},
          {"a wave longer than the tank", admin, create, good + "periods_s: 1.2 periods_s: 9", invalid, "cases[0].case.tank.y_m",
           "lengthen the tank"},
          {"1001 jobs", admin, create, good + entries("periods_s", 77) + entries("heights_m", 13), invalid, "cases", "at most 1000"},
          {"more jobs than there are numbers", admin, create,
           good + entries("periods_s", 6000) + entries("heights_m", 6000) + entries("headings_deg", 6000), invalid, "cases", "at most 1000"}};
}

std::vector<IllegalRequest> sweep_names() {
  std::vector<IllegalRequest> out;
  for (const char* method : {"Sweeps.GetSweep", "Sweeps.CancelSweep"})
    for (const auto& [what, name] : {std::pair{"no name", ""}, {"a path", "sweeps/../../etc/passwd"}, {"a job", "$held"},
                                     {"capitals", "sweeps/ABC"}, {"a NUL", "sweeps/a\\000b"}})
      out.push_back({what, admin, method, "name: '" + std::string(name) + "'", invalid, "name", "write sweeps/ and the uid"});
  const std::string list = "Sweeps.ListSweeps", token = "use next_page_token";
  for (auto& more : std::vector<IllegalRequest>{
           {"an unknown sweep", admin, "Sweeps.GetSweep", "name: 'sweeps/nosuchsweep'", missing, "", "list the sweeps"},
           {"cancel an unknown sweep", admin, "Sweeps.CancelSweep", "name: 'sweeps/nosuchsweep'", missing, "", "list the sweeps"},
           {"a deleted sweep", admin, "Sweeps.GetSweep", "name: '$gone_sweep'", missing, "", "list the sweeps"},
           {"a sweep as a job", admin, "Jobs.GetJob", "name: '$sweep'", invalid, "name", "write jobs/ and the uid"},
           {"a negative page", admin, list, "page_size: -1", invalid, "page_size", "0 to 1000"},
           {"a huge page", admin, list, "page_size: 1001", invalid, "page_size", "0 to 1000"},
           {"a token of nothing", admin, list, "page_token: 'zzz'", invalid, "page_token", token},
           {"half a token", admin, list, "page_token: 's'", invalid, "page_token", token},
           {"a changed token", admin, list, "page_token: 's1$sweep_token'", invalid, "page_token", token},
           {"a token with a tail", admin, list, "page_token: '$sweep_token!'", invalid, "page_token", token},
           {"a token of the list of jobs", admin, list, "page_token: '$token'", invalid, "page_token", token},
           {"a token of the list of sweeps", admin, "Jobs.ListJobs", "page_token: '$sweep_token'", invalid, "page_token", token}})
    out.push_back(std::move(more));
  return out;
}

std::vector<IllegalRequest> reports() {
  const std::string decay = "Reports.GetDecayReport", rao = "Reports.GetRaoReport", done = "job: '$done' ", name = "write jobs/ and the uid";
  std::string many;
  for (int i = 0; i <= 1000; ++i) many += "jobs: '$done' ";
  return {
      {"a decay of no job", admin, decay, "", invalid, "job", name},
      {"a decay of a path", admin, decay, "job: 'jobs/../../etc/passwd'", invalid, "job", name},
      {"a decay of an unknown job", admin, decay, "job: 'jobs/nosuchjob'", missing, "", "list the jobs"},
      {"a decay of a sweep", admin, decay, "job: '$sweep'", invalid, "job", name},
      {"a decay of a job that has not run", admin, decay, "job: '$held'", state, "", "no samples yet"},
      {"a decay of a job that is too short", admin, decay, done, state, "", "run longer"},
      {"a decay of an unknown channel", admin, decay, done + "options { channel: 'rolling' }", invalid, "options.channel", "sway, heave, roll"},
      {"a decay of a channel that steers terminals", admin, decay, done + "options { channel: '\\033[2J' }", invalid, "options.channel",
       "one line"},
      {"a decay of a long channel", admin, decay, done + "options { channel: '" + x(61) + "' }", invalid, "options.channel", "at most 60"},
      {"a decay from no time", admin, decay, done + "options { from_s: nan }", invalid, "options.from_s", "finite"},
      {"a decay up to no time", admin, decay, done + "options { until_s: inf }", invalid, "options.until_s", "finite"},
      {"a decay backwards", admin, decay, done + "options { from_s: 2 until_s: 1 }", invalid, "options.until_s", "later"},
      {"a decay of all peaks", admin, decay, done + "options { smallest_peak: 0 }", invalid, "options.smallest_peak", ">= 0.001"},
      {"a decay of no peaks", admin, decay, done + "options { smallest_peak: 0.6 }", invalid, "options.smallest_peak", "<= 0.5"},
      {"a decay of nothing of an unknown job", admin, decay, "job: 'jobs/nosuchjob' options { smallest_peak: 0 }", invalid,
       "options.smallest_peak", ">= 0.001"},
      {"an RAO of nothing", admin, rao, "", invalid, "jobs", "give one of them"},
      {"an RAO of jobs and a sweep", admin, rao, "jobs: '$done' sweep: '$sweep'", invalid, "jobs", "give one of them"},
      {"an RAO of 1001 jobs", admin, rao, many, invalid, "jobs", "at most 1000"},
      {"an RAO of a path", admin, rao, "jobs: '$done' jobs: 'jobs/../x'", invalid, "jobs[1]", name},
      {"an RAO of an unknown job", admin, rao, "jobs: 'jobs/nosuchjob'", missing, "", "list the jobs"},
      {"an RAO of a job as a sweep", admin, rao, "sweep: '$done'", invalid, "sweep", "write sweeps/ and the uid"},
      {"an RAO of an unknown sweep", admin, rao, "sweep: 'sweeps/nosuchsweep'", missing, "", "list the sweeps"},
      {"an RAO of no periods", admin, rao, "jobs: '$done' options { period_count: 0 }", invalid, "options.period_count", "1 to 1000"},
      {"an RAO of endless periods", admin, rao, "jobs: '$done' options { period_count: 1001 }", invalid, "options.period_count", "1 to 1000"},
      {"an RAO of negative periods", admin, rao, "sweep: '$sweep' options { period_count: -5 }", invalid, "options.period_count", "1 to 1000"}};
}

std::vector<IllegalRequest> bytes_and_rights() {
  const std::vector<std::pair<std::string, std::string>> reading{{"Sweeps.GetSweep", "name: '$sweep'"}, {"Sweeps.ListSweeps", ""},
                                                                 {"Reports.GetDecayReport", "job: '$done'"},
                                                                 {"Reports.GetRaoReport", "jobs: '$done'"}};
  const std::vector<std::pair<std::string, std::string>> changing{{create, good}, {"Sweeps.CancelSweep", "name: '$sweep'"}};
  std::vector<IllegalRequest> out;
  for (const auto* list : {&reading, &changing})
    for (const auto& [method, request] : *list) {
      out.push_back({"without a token", nobody, method, request, unknown, "", "--token-file"});
      out.push_back({"a cut message", admin, method, "", invalid, "", "seaway/v1/job_service.proto", std::string("\x0a\x20jobs", 6)});
      out.push_back({"text that is not UTF-8", admin, method, "", invalid, "", "seaway/v1/job_service.proto",
                     method == "Sweeps.ListSweeps" ? std::string("\x12\x01\xff", 3) : std::string("\x0a\x06jobs/\xff", 8)});
    }
  for (const auto& [method, request] : changing)
    out.push_back({"by a viewer", viewer, method, request, denied, "", "role submitter"});
  return out;
}

}  // namespace

std::vector<IllegalRequest> illegal_sweeps() {
  std::vector<IllegalRequest> out;
  for (auto part : {traits, cases, values, sweep_names, reports, bytes_and_rights})
    for (auto& row : part()) out.push_back(std::move(row));
  return out;
}

}  // namespace seaway::stress
