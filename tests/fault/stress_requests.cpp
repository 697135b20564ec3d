// SPDX-License-Identifier: GPL-3.0-or-later
// requests: the tables of illegal requests, sent as bytes to the real server. Each has to get its status, the path of the
// field at fault and a word of advice, and none may change anything.
#include <google/protobuf/text_format.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <thread>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/jobs/workspace.hpp"
#include "tests/fault/illegal_requests.hpp"
#include "tests/fault/stress.hpp"
#include "tests/support/temp_folder.hpp"

namespace seaway::stress {
namespace {

using google::protobuf::Message;
using google::protobuf::TextFormat;
using Words = std::map<std::string, std::string>;

std::string token_of(Caller caller) {
  static const std::map<Caller, std::string> tokens{{Caller::nobody, ""}, {Caller::stranger, "stranger-token"}, {Caller::viewer, "viewer-token"},
                                                    {Caller::submitter, "submitter-token"}, {Caller::admin, "admin-token"}};
  return tokens.at(caller);
}

std::vector<std::string> guarded_arguments(const Settings& s, const std::string& folder) {
  const auto arguments = daemon_arguments(s, folder);
  std::ofstream config(folder + "/config.yaml", std::ios::app);
  config << "security:\n  principals:\n";
  for (const auto& [caller, role] : {std::pair{Caller::viewer, "viewer"}, {Caller::submitter, "submitter"}, {Caller::admin, "admin"}})
    config << "    - {name: " << role << ", role: " << role << ", token_sha256: " << jobs::sha256_hex(token_of(caller)) << "}\n";
  return arguments;
}

/// Takes a field out, given by its path; indices are not there.
void clear_field(Message& message, const std::string& path) {
  const std::size_t dot = path.find('.');
  const auto* field = message.GetDescriptor()->FindFieldByName(path.substr(0, dot));
  if (field == nullptr) throw std::runtime_error("requests: no field " + path);
  if (dot == path.npos)
    message.GetReflection()->ClearField(&message, field);
  else
    clear_field(*message.GetReflection()->MutableMessage(&message, field), path.substr(dot + 1));
}

void merge(Message& message, const std::string& text) {
  TextFormat::Parser parser;
  if (!parser.MergeFromString(text, &message)) throw std::runtime_error("requests: the table is wrong: " + text.substr(0, 200));
}

/// Method and request type of "Jobs.GetJob"; no type for what does not exist.
std::unique_ptr<Message> request_type(const std::string& method) {
  const auto* descriptor = google::protobuf::DescriptorPool::generated_pool()->FindMethodByName("seaway.v1." + method);
  if (descriptor == nullptr) return nullptr;
  return std::unique_ptr<Message>(google::protobuf::MessageFactory::generated_factory()->GetPrototype(descriptor->input_type())->New());
}

/// Sends bytes to any method and waits for its status; a stream that begins is left after its first message.
grpc::Status send(const std::shared_ptr<grpc::Channel>& channel, const std::string& token, const std::string& method, const std::string& bytes) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  if (!token.empty()) context.AddMetadata("authorization", "Bearer " + token);
  grpc::CompletionQueue events;
  const auto ok = [&events] {
    void* tag = nullptr;
    bool good = false;
    return events.Next(&tag, &good) && good;
  };
  const std::size_t dot = method.find('.');
  const auto call = stub.PrepareCall(&context, "/seaway.v1." + method.substr(0, dot) + "/" + method.substr(dot + 1), &events);
  call->StartCall(nullptr);
  ok();
  const grpc::Slice slice(bytes);
  call->WriteLast(grpc::ByteBuffer(&slice, 1), {}, nullptr);
  ok();
  grpc::ByteBuffer answer;
  call->Read(&answer, nullptr);
  const bool answered = ok();
  if (answered) context.TryCancel();
  grpc::Status status;
  call->Finish(&status, nullptr);
  ok();
  return answered ? grpc::Status::OK : status;
}

/// What is wrong with the answer; empty: nothing.
std::string complaint(const grpc::Status& status, const IllegalRequest& wanted) {
  if (status.error_code() != wanted.status)
    return "status " + std::to_string(status.error_code()) + " instead of " + std::to_string(wanted.status) + ": " + status.error_message().substr(0, 300);
  google::rpc::Status details;
  google::rpc::ErrorInfo info;
  google::rpc::BadRequest bad;
  details.ParseFromString(status.error_details());
  for (const auto& any : details.details()) {
    any.UnpackTo(&info);
    any.UnpackTo(&bad);
  }
  if (!wanted.by_grpc && (info.domain() != "seaway" || info.reason().empty())) return "no reason: " + status.error_message();
  std::string where, text = status.error_message();
  if (!wanted.field.empty()) {
    for (const auto& v : bad.field_violations()) {
      where += v.field() + " (" + v.description() + ") ";
      if (v.field() == wanted.field && v.description().find(wanted.advice) != std::string::npos) return "";
    }
    return "'" + wanted.field + "' with '" + wanted.advice + "' is not in: " + (where.empty() ? text : where);
  }
  if (bad.field_violations_size() > 0) return "a field is named: " + bad.field_violations(0).field();
  return text.find(wanted.advice) != std::string::npos ? "" : "'" + wanted.advice + "' is not in: " + text;
}

/// Jobs in all states to be wrong about.
class Scene {
 public:
  Scene(const Settings& s, const std::string& address)
      : client_(own_channel(address), token_of(Caller::admin)), good_(request_of(s.case_file).case_()) {
    v1::CreateJobRequest quick = request(false);
    auto& stages = *quick.mutable_case_()->mutable_cascade()->mutable_stages();
    stages.DeleteSubrange(0, stages.size() - 1);
    stages[0].clear_mapping();
    stages[0].mutable_end()->mutable_time()->set_duration_s(0.05);
    create("done", quick);
    wait_for(words_["done"], v1::Job::STATE_SUCCEEDED);
    for (const char* name : {"held", "cancelled", "deleted"}) create(name, request(true));
    client_.cancel(words_["cancelled"]);
    client_.cancel(words_["deleted"]);
    client_.erase(words_["deleted"]);
    create("another", request(true));  // a second page of held jobs
    create("running", request(false));
    wait_for(words_["running"], v1::Job::STATE_RUNNING);
    v1::ListJobsRequest page;
    page.set_page_size(1);
    words_["token"] = client_.list(page).next_page_token();
    page.add_states(v1::Job::STATE_HELD);
    words_["held_token"] = client_.list(page).next_page_token();
    create_sweeps();
    std::string text;
    TextFormat::PrintToString(good_, &text);
    words_["case"] = "case { " + text + " }";
  }
  const v1::Case& good() const { return good_; }

  /// With the words that begin with $ put in; longer words first.
  std::string fill(std::string text) {
    words_["new"] = client::new_request_id();
    for (auto word = words_.rbegin(); word != words_.rend(); ++word)
      for (std::size_t at = 0; (at = text.find("$" + word->first, at)) != text.npos; at += word->second.size())
        text.replace(at, word->first.size() + 1, word->second);
    return text;
  }
  /// States, priorities and notes of all jobs: what a refused request may not change.
  std::string everything() {
    std::string out = client_.info().log_level();
    const v1::ListJobsResponse all = client_.list({});
    for (const v1::Job& job : all.jobs())
      out += job.name() + std::to_string(job.state()) + std::to_string(job.priority()) + job.note() + std::to_string(job.labels_size()) + "\n";
    const v1::ListSweepsResponse sweeps = client_.list_sweeps({});
    for (const v1::Sweep& sweep : sweeps.sweeps()) out += sweep.name() + std::to_string(sweep.job_count()) + "\n";
    return out;
  }
  void end() { client_.kill(words_["running"]); }

 private:
  v1::CreateJobRequest request(bool held) {
    v1::CreateJobRequest out;
    *out.mutable_case_() = good_;
    out.set_request_id(client::new_request_id());
    out.set_start_held(held);
    return out;
  }
  void create(const std::string& name, const v1::CreateJobRequest& request) {
    words_[name] = client_.create(request).job().name();
    words_[name + "_id"] = request.request_id();
  }
  /// Three sweeps of one held job each, of which the first is deleted again.
  void create_sweeps() {
    for (const char* name : {"gone_sweep", "sweep", "another_sweep"}) {
      v1::CreateSweepRequest wanted;
      wanted.set_request_id(client::new_request_id());
      wanted.set_start_held(true);
      wanted.add_cases()->set_name("intact");
      *wanted.mutable_cases(0)->mutable_case_() = good_;
      const v1::Sweep made = client_.create_sweep(wanted).sweep();
      words_[name] = made.name();
      words_[name + std::string("_id")] = wanted.request_id();
      if (name != std::string("gone_sweep")) continue;
      client_.cancel_sweep(made.name());
      client_.erase(made.points(0).job());
    }
    v1::ListSweepsRequest page;
    page.set_page_size(1);
    words_["sweep_token"] = client_.list_sweeps(page).next_page_token();
  }
  void wait_for(const std::string& job, v1::Job::State state) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (client_.get(job).state() != state) {
      if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("requests: " + job + " is not as it should be");
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  client::JobClient client_;
  const v1::Case good_;
  Words words_;
};

/// The cases of the tables as submits.
std::vector<IllegalRequest> submits_of(const std::vector<IllegalCase>& table, const v1::Case& good) {
  std::vector<IllegalRequest> out;
  for (const IllegalCase& one : table) {
    v1::CreateJobRequest request;
    *request.mutable_case_() = good;
    request.set_request_id(client::new_request_id());
    for (const std::string& path : one.clear) clear_field(*request.mutable_case_(), path);
    merge(*request.mutable_case_(), one.change);
    out.push_back({one.what, Caller::admin, "Jobs.CreateJob", "", grpc::StatusCode::INVALID_ARGUMENT, one.field, one.advice,
                   request.SerializeAsString()});
  }
  return out;
}

}  // namespace

std::vector<Line> requests(const Settings& s) {
  const testing::TempFolder folder;
  testing::Daemon daemon(s.seawayd, folder.path(), {}, guarded_arguments(s, folder.path()));
  daemon.start();
  Scene scene(s, daemon.address());
  std::vector<IllegalRequest> table = illegal_calls();
  v1::Case sphere;
  merge(sphere, sphere_case());
  for (auto part : {illegal_sweeps(), submits_of(illegal_sections(), scene.good()), submits_of(illegal_ships(), sphere)})
    table.insert(table.end(), part.begin(), part.end());
  const auto channel = own_channel(daemon.address());
  std::string before = scene.everything();
  int wrong = 0;
  for (const IllegalRequest& one : table) {
    std::string bytes = one.bytes;
    if (bytes.empty()) {
      const auto message = request_type(one.method);
      if (message == nullptr) throw std::runtime_error("requests: no method " + one.method);
      merge(*message, scene.fill(one.request));
      bytes = message->SerializePartialAsString();
    }
    std::string why = complaint(send(channel, token_of(one.caller), one.method, bytes), one);
    if (const std::string now = scene.everything(); now != before) {
      why += " it has changed something: " + now;
      before = now;
    }
    if (why.empty()) continue;
    ++wrong;
    std::fprintf(stderr, "requests: %s, %s: %s\n", one.method.c_str(), one.what.c_str(), why.c_str());
  }
  scene.end();
  const double cpu = cpu_seconds(daemon.process().pid());
  if (daemon.terminate() != 0) throw std::runtime_error("requests: the server did not end well");
  Line count{"requests", "requests", static_cast<double>(table.size()), "1", 60, cpu};
  count.at_least = true;
  return {{"requests", "wrong_answers", static_cast<double>(wrong), "1", 0, cpu}, count};
}

}  // namespace seaway::stress
