// SPDX-License-Identifier: GPL-3.0-or-later
// The table of illegal calls. One line each: what, who, method, request, status, field, advice.
#include "tests/fault/illegal_requests.hpp"

namespace seaway::stress {
namespace {

using grpc::StatusCode;
constexpr auto invalid = StatusCode::INVALID_ARGUMENT, missing = StatusCode::NOT_FOUND, state = StatusCode::FAILED_PRECONDITION,
               range = StatusCode::OUT_OF_RANGE, denied = StatusCode::PERMISSION_DENIED, unknown = StatusCode::UNAUTHENTICATED;
constexpr auto nobody = Caller::nobody, stranger = Caller::stranger, viewer = Caller::viewer, submitter = Caller::submitter,
               admin = Caller::admin;

std::string x(std::size_t n) { return std::string(n, 'x'); }

std::string repeated(const std::string& text, int n) {
  std::string out;
  for (int i = 0; i < n; ++i)
    for (const char c : text) c == '#' ? out += std::to_string(i) : out += c;
  return out;
}

void add(std::vector<IllegalRequest>& to, std::vector<IllegalRequest> more) {
  for (auto& one : more) to.push_back(std::move(one));
}

/// A request of a job by its name: malformed and unknown names.
void add_names(std::vector<IllegalRequest>& out, const std::string& method, const std::string& field, const std::string& rest = "") {
  add(out, {{method + " without a name", admin, method, rest, invalid, field, "write jobs/ and the uid"},
            {method + " of an unknown job", admin, method, field + ": 'jobs/nosuchjob' " + rest, missing, "", "list the jobs"},
            {method + " of a path", admin, method, field + ": 'jobs/../../etc/passwd' " + rest, invalid, field, "write jobs/ and the uid"}});
}

std::vector<IllegalRequest> names() {
  std::vector<IllegalRequest> out;
  for (const char* method : {"GetJob", "CancelJob", "KillJob", "HoldJob", "ReleaseJob", "DeleteJob"})
    add_names(out, std::string("Jobs.") + method, "name");
  add_names(out, "Jobs.RetryJob", "name", "request_id: '$new'");
  for (const char* method : {"Telemetry.WatchSamples", "Telemetry.ReadSamples", "Telemetry.ReadEnvelope", "Stages.ListStages",
                             "Artifacts.ListArtifacts"})
    add_names(out, method, "job");
  add_names(out, "Artifacts.DownloadArtifact", "job", "artifact: 'a'");
  add(out, {{"no collection", admin, "Jobs.GetJob", "name: 'job/abc'", invalid, "name", "write jobs/ and the uid"},
            {"capitals", admin, "Jobs.GetJob", "name: 'jobs/ABC'", invalid, "name", "write jobs/ and the uid"},
            {"a long uid", admin, "Jobs.GetJob", "name: 'jobs/" + x(64) + "'", invalid, "name", "write jobs/ and the uid"},
            {"a NUL", admin, "Jobs.GetJob", "name: 'jobs/a\\000b'", invalid, "name", "write jobs/ and the uid"},
            {"a deleted job", admin, "Jobs.GetJob", "name: '$deleted'", missing, "", "list the jobs"},
            {"an unknown view", admin, "Jobs.GetJob", "name: '$done' view: 7", invalid, "view", "see JobView"}});
  return out;
}

std::vector<IllegalRequest> submits() {
  const std::string id = "$case request_id: '$new' ", m = "Jobs.CreateJob";
  return {
      {"no case", admin, m, "request_id: '$new'", invalid, "case", "send the case"},
      {"no request id", admin, m, "$case", invalid, "request_id", "make a new UUID"},
      {"a request id that is no UUID", admin, m, "$case request_id: 'my first job'", invalid, "request_id", "make a new UUID"},
      {"a known request id, another case", admin, m, "$case case { title: 'another' } request_id: '$done_id'", invalid, "title",
       "use a new one"},
      {"the request id of a deleted job", admin, m, "$case request_id: '$deleted_id'", state, "", "use a new request id"},
      {"too high a priority", admin, m, id + "priority: 101", invalid, "priority", "-100 to 100"},
      {"too low a priority", admin, m, id + "priority: -101", invalid, "priority", "-100 to 100"},
      {"a label without a key", admin, m, id + "labels { value: 'a' }", invalid, "labels", "1 to 63 of a-z"},
      {"a label key with capitals", admin, m, id + "labels { key: 'Ship' value: 'a' }", invalid, "labels", "1 to 63 of a-z"},
      {"a long label", admin, m, id + "labels { key: 'ship' value: '" + x(256) + "' }", invalid, "labels.ship", "at most 255"},
      {"a label of two lines", admin, m, id + "labels { key: 'ship' value: 'a\\nb' }", invalid, "labels.ship", "one line"},
      {"65 labels", admin, m, id + repeated("labels { key: 'k#' value: 'v' } ", 65), invalid, "labels", "at most 64"},
      {"a long note", admin, m, id + "note: '" + x(4001) + "'", invalid, "note", "at most 4000"},
      {"a note that steers terminals", admin, m, id + "note: 'a\\033[2Jb'", invalid, "note", "plain text"},
      {"a file without a name", admin, m, id + "files { content: 'a' }", invalid, "files[0].name", "write it as in the case"},
      {"a file that the case does not name", admin, m, id + "files { name: 'hull.stl' content: 'a' }", invalid, "files", "leave it out"},
      {"a file given twice", admin, m, id + repeated("files { name: 'a' content: 'b' } ", 2), invalid, "files[1].name", "send each file once"},
      {"17 files", admin, m, id + repeated("files { name: 'f#' content: 'b' } ", 17), invalid, "files", "at most 16"},
      {"a file over a mebibyte", admin, m, id + "files { name: 'a' content: '" + x((1 << 20) + 1) + "' }", invalid, "files[0].content",
       "at most 1048576"},
      {"a message over eight mebibytes", admin, m, id + "note: '" + x(9 << 20) + "'", StatusCode::RESOURCE_EXHAUSTED, "", "larger than max",
       "", true},
      {"no case to check", admin, "Cases.ValidateCase", "", invalid, "case", "send the case"},
      {"a wrong case to check", admin, "Cases.ValidateCase", "$case case { dimension: 4 }", invalid, "dimension", "2 for a section"},
      {"a wrong case, only to check", admin, m, "$case case { dimension: 4 } validate_only: true", invalid, "dimension", "2 for a section"}};
}

std::vector<IllegalRequest> lists() {
  const std::string m = "Jobs.ListJobs", token = "use next_page_token";
  return {{"a negative page", admin, m, "page_size: -1", invalid, "page_size", "0 to 1000"},
          {"a huge page", admin, m, "page_size: 1001", invalid, "page_size", "0 to 1000"},
          {"a token of nothing", admin, m, "page_token: 'zzz'", invalid, "page_token", token},
          {"a token without a filter", admin, m, "page_token: '1f'", invalid, "page_token", token},
          {"a negative token", admin, m, "page_token: '-1-0'", invalid, "page_token", token},
          {"a token with a tail", admin, m, "page_token: '$token!'", invalid, "page_token", token},
          {"a changed token", admin, m, "page_token: '1$token'", invalid, "page_token", token},
          {"a token of another filter", admin, m, "states: STATE_QUEUED page_token: '$held_token'", invalid, "page_token", token},
          {"a token without its filter", admin, m, "page_token: '$held_token'", invalid, "page_token", token},
          {"a long token", admin, m, "page_token: '" + x(5000) + "'", invalid, "page_token", token},
          {"state 0", admin, m, "states: STATE_HELD states: STATE_UNSPECIFIED", invalid, "states[1]", "see Job.State"},
          {"an unknown state", admin, m, "states: 99", invalid, "states[0]", "see Job.State"},
          {"a malformed label to list by", admin, m, "labels { key: 'A B' value: 'c' }", invalid, "labels", "1 to 63 of a-z"},
          {"a long label to list by", admin, m, "labels { key: 'a' value: '" + x(256) + "' }", invalid, "labels.a", "at most 255"},
          {"65 labels to list by", admin, m, repeated("labels { key: 'k#' value: 'v' } ", 65), invalid, "labels", "at most 64"}};
}

std::vector<IllegalRequest> moves() {
  const std::string retry = "Jobs.RetryJob", update = "Jobs.UpdateJob";
  return {
      {"cancel what has ended", admin, "Jobs.CancelJob", "name: '$done'", state, "", "retry it"},
      {"kill what has ended", admin, "Jobs.KillJob", "name: '$done'", state, "", "retry it"},
      {"hold what runs", admin, "Jobs.HoldJob", "name: '$running'", state, "", "only waiting jobs"},
      {"hold what has ended", admin, "Jobs.HoldJob", "name: '$done'", state, "", "only waiting jobs"},
      {"release what runs", admin, "Jobs.ReleaseJob", "name: '$running'", state, "", "only held jobs"},
      {"release what was cancelled", admin, "Jobs.ReleaseJob", "name: '$cancelled'", state, "", "only held jobs"},
      {"delete what runs", admin, "Jobs.DeleteJob", "name: '$running'", state, "", "cancel it first"},
      {"delete what waits", admin, "Jobs.DeleteJob", "name: '$held'", state, "", "cancel it first"},
      {"retry what runs", admin, retry, "name: '$running' request_id: '$new'", state, "", "cancel it first"},
      {"retry what waits", admin, retry, "name: '$held' request_id: '$new'", state, "", "cancel it first"},
      {"retry from a checkpoint that is not there", admin, retry, "name: '$cancelled' request_id: '$new' from: FROM_LAST_CHECKPOINT", state,
       "", "from the start"},
      {"retry without a request id", admin, retry, "name: '$done'", invalid, "request_id", "make a new UUID"},
      {"retry by the request of another job", admin, retry, "name: '$done' request_id: '$held_id'", invalid, "request_id", "use a new one"},
      {"retry from somewhere", admin, retry, "name: '$done' request_id: '$new' from: 9", invalid, "from", "see RetryJobRequest.From"},
      {"retry from a stage that the case has not", admin, retry, "name: '$done' request_id: '$new' from: FROM_STAGE stage: 2", invalid,
       "stage", "1 to 1"},
      {"retry from no stage", admin, retry, "name: '$cancelled' request_id: '$new' from: FROM_STAGE", invalid, "stage", "1 to 3"},
      {"retry from a stage that it has not reached", admin, retry, "name: '$cancelled' request_id: '$new' from: FROM_STAGE stage: 2", state, "",
       "from an earlier stage"},
      {"retry from the start and a stage", admin, retry, "name: '$done' request_id: '$new' from: FROM_START stage: 1", invalid, "stage",
       "FROM_STAGE"},
      {"update nobody", admin, update, "update_mask { paths: 'note' }", invalid, "job.name", "write jobs/ and the uid"},
      {"update an unknown job", admin, update, "job { name: 'jobs/nosuchjob' } update_mask { paths: 'note' }", missing, "", "list the jobs"},
      {"update nothing", admin, update, "job { name: '$held' note: 'a' }", invalid, "update_mask", "name what shall change"},
      {"update the state", admin, update, "job { name: '$held' state: STATE_SUCCEEDED } update_mask { paths: 'state' }", invalid,
       "update_mask", "allowed are priority, labels, note"},
      {"update to a wrong priority", admin, update, "job { name: '$held' priority: 1000 } update_mask { paths: 'priority' }", invalid,
       "job.priority", "-100 to 100"},
      {"update to a long note", admin, update, "job { name: '$held' note: '" + x(4001) + "' } update_mask { paths: 'note' }", invalid,
       "job.note", "at most 4000"},
      {"update to a wrong label", admin, update, "job { name: '$held' labels { key: 'a' value: '\\001' } } update_mask { paths: 'labels' }",
       invalid, "job.labels.a", "one line"}};
}

std::vector<IllegalRequest> reads() {
  const std::string envelope = "Telemetry.ReadEnvelope", samples = "Telemetry.ReadSamples", download = "Artifacts.DownloadArtifact";
  return {
      {"watch from before the beginning", admin, "Telemetry.WatchSamples", "job: '$done' after_sequence: -1", invalid, "after_sequence",
       "0 starts at the first"},
      {"watch from after the end", admin, "Telemetry.WatchSamples", "job: '$done' after_sequence: 1000000", range, "", "available are"},
      {"changes from before the beginning", admin, "Telemetry.WatchJobs", "after_revision: -1", invalid, "after_revision", "0 starts at"},
      {"changes from after the end", admin, "Telemetry.WatchJobs", "after_revision: 1000000", range, "", "list the jobs"},
      {"one point", admin, envelope, "job: '$done' max_points: 1", invalid, "max_points", "2 to 10000"},
      {"too many points", admin, envelope, "job: '$done' max_points: 10001", invalid, "max_points", "2 to 10000"},
      {"points from before the beginning", admin, envelope, "job: '$done' after_sequence: -1", invalid, "after_sequence", "0 starts at"},
      {"points up to before the beginning", admin, envelope, "job: '$done' until_sequence: -1", invalid, "until_sequence", "0 goes to"},
      {"points of an empty range", admin, envelope, "job: '$done' after_sequence: 5 until_sequence: 5", invalid, "until_sequence",
       "above after_sequence"},
      {"a negative page of samples", admin, samples, "job: '$done' page_size: -1", invalid, "page_size", "0 to 5000"},
      {"a huge page of samples", admin, samples, "job: '$done' page_size: 5001", invalid, "page_size", "0 to 5000"},
      {"samples from before the beginning", admin, samples, "job: '$done' after_sequence: -1", invalid, "after_sequence", "0 starts at"},
      {"no artifact", admin, download, "job: '$done'", invalid, "artifact", "ListArtifacts"},
      {"an unknown artifact", admin, download, "job: '$done' artifact: 'drawing.pdf'", missing, "", "ListArtifacts"},
      {"an artifact that is a path", admin, download, "job: '$done' artifact: '../../seaway.db'", missing, "", "ListArtifacts"},
      {"an artifact from before its beginning", admin, download, "job: '$done' artifact: 'drawing.pdf' offset: -1", invalid, "offset",
       "0 starts at"},
      {"no log level", admin, "Admin.SetLogLevel", "", invalid, "level", "allowed are trace"},
      {"an unknown log level", admin, "Admin.SetLogLevel", "level: 'loud'", invalid, "level", "allowed are trace"}};
}

std::vector<IllegalRequest> malformed() {
  std::vector<IllegalRequest> out;
  const auto bytes = [&](const std::string& what, const std::string& method, std::string content) {
    out.push_back({what, admin, method, "", invalid, "", "seaway/v1/job_service.proto", std::move(content)});
  };
  bytes("a cut message", "Jobs.GetJob", std::string("\x0a\x20jobs", 6));
  bytes("text that is not UTF-8", "Jobs.GetJob", std::string("\x0a\x06jobs/\xff", 8));
  bytes("a field number of 0", "Jobs.ListJobs", std::string("\x02\x01", 2));
  bytes("a declared gigabyte", "Jobs.CreateJob", std::string("\x0a\x80\x80\x80\x80\x04", 6));
  bytes("a cut message to a stream", "Telemetry.WatchSamples", std::string("\x0a\x20jobs", 6));
  bytes("an endless number", "Artifacts.DownloadArtifact", std::string(20, '\xff'));
  std::string nest;  // of groups, as unknown fields
  bytes("a deep nest", "Cases.ValidateCase", nest.assign(100'000, '\x7b'));
  out.push_back({"an unknown method", admin, "Jobs.ExplodeJob", "", StatusCode::UNIMPLEMENTED, "", "", " ", true});
  out.push_back({"an unknown service", admin, "Wishes.Grant", "", StatusCode::UNIMPLEMENTED, "", "", " ", true});
  return out;
}

std::vector<IllegalRequest> rights() {
  std::vector<IllegalRequest> out;
  const std::string named = "name: '$held'", of = "job: '$done'", retry = "name: '$done' request_id: '$new'";
  const std::string update = "job { name: '$held' note: 'a' } update_mask { paths: 'note' }";
  const std::vector<std::pair<std::string, std::string>> reading{
      {"Jobs.GetJob", named}, {"Jobs.ListJobs", ""}, {"Telemetry.WatchSamples", of}, {"Telemetry.WatchJobs", ""},
      {"Telemetry.ReadSamples", of}, {"Telemetry.ReadEnvelope", of}, {"Stages.ListStages", of}, {"Artifacts.ListArtifacts", of},
      {"Artifacts.DownloadArtifact", of}, {"Admin.GetServerInfo", ""}, {"Cases.ValidateCase", "$case"}};
  const std::vector<std::pair<std::string, std::string>> changing{
      {"Jobs.CreateJob", "$case request_id: '$new'"}, {"Jobs.CancelJob", named}, {"Jobs.KillJob", named}, {"Jobs.HoldJob", named},
      {"Jobs.ReleaseJob", named}, {"Jobs.RetryJob", retry}, {"Jobs.UpdateJob", update}};
  const std::vector<std::pair<std::string, std::string>> ruling{{"Jobs.DeleteJob", "name: '$cancelled'"}, {"Admin.SetLogLevel", "level: 'trace'"}};
  for (const auto* list : {&reading, &changing, &ruling})
    for (const auto& [method, request] : *list)
      out.push_back({"without a token", nobody, method, request, unknown, "", "--token-file"});
  for (const auto* list : {&changing, &ruling})
    for (const auto& [method, request] : *list)
      out.push_back({"by a viewer", viewer, method, request, denied, "", list == &ruling ? "role admin" : "role submitter"});
  for (const auto& [method, request] : ruling) out.push_back({"by a submitter", submitter, method, request, denied, "", "role admin"});
  out.push_back({"with a wrong token", stranger, "Jobs.ListJobs", "", unknown, "", "--token-file"});
  out.push_back({"a wrong request without a token", nobody, "Jobs.GetJob", "name: '../..'", unknown, "", "--token-file"});
  return out;
}

}  // namespace

std::vector<IllegalRequest> illegal_calls() {
  std::vector<IllegalRequest> out;
  for (auto part : {names, submits, lists, moves, reads, malformed, rights}) add(out, part());
  return out;
}

}  // namespace seaway::stress
