// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/submission.hpp"

#include <fmt/format.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/field_comparator.h>
#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <map>
#include <set>

#include "server/convert/case.hpp"
#include "server/convert/input_error.hpp"
#include "server/convert/result.hpp"

namespace seaway::jobs {
namespace {

constexpr int max_files = 16;
constexpr std::size_t max_file_bytes = 1 << 20;

std::map<std::string, const v1::CaseFile*> by_name(const Files& files) {
  std::vector<sim::Diagnostic> problems;
  const auto wrong = [&](std::string field, std::string message, std::string hint) {
    problems.push_back({sim::Diagnostic::Severity::error, std::move(field), std::move(message), std::move(hint)});
  };
  std::map<std::string, const v1::CaseFile*> out;
  if (files.size() > max_files) wrong("files", fmt::format("{} files", files.size()), "at most 16");
  for (int i = 0; i < files.size(); ++i) {
    const v1::CaseFile& file = files[i];
    if (file.name().empty() || file.name().size() > 1000)
      wrong(fmt::format("files[{}].name", i), "is empty or too long", "write it as in the case");
    if (file.content().size() > max_file_bytes)
      wrong(fmt::format("files[{}].content", i), fmt::format("{} bytes", file.content().size()), "at most 1048576");
    if (!out.emplace(file.name(), &file).second)
      wrong(fmt::format("files[{}].name", i), "is given twice", "send each file once");
  }
  if (!problems.empty()) throw convert::InputError("INVALID_FILES", std::move(problems));
  return out;
}

/// A field of the case that names a file.
struct NamedFile {
  const char* field;
  std::string* name;
};

std::vector<NamedFile> files_of(sim::Case& c) {
  std::vector<NamedFile> out;
  if (!c.hull.offsets_file.empty())
    out.push_back({c.dim == 2                                    ? "hull.offsets_section.file"
                   : c.hull.shape == sim::Hull::Shape::stl ? "hull.stl.file"
                                                                  : "hull.offsets_hull.file",
                   &c.hull.offsets_file});
  if (!c.wave.file.empty()) out.push_back({"wave.time_series.file", &c.wave.file});
  return out;
}

/// Collects the paths at which two messages differ.
class PathReporter final : public google::protobuf::util::MessageDifferencer::Reporter {
 public:
  using Path = std::vector<google::protobuf::util::MessageDifferencer::SpecificField>;
  void ReportAdded(const google::protobuf::Message&, const google::protobuf::Message&, const Path& path) override { add(path); }
  void ReportDeleted(const google::protobuf::Message&, const google::protobuf::Message&, const Path& path) override { add(path); }
  void ReportModified(const google::protobuf::Message&, const google::protobuf::Message&, const Path& path) override { add(path); }
  std::vector<std::string> take() { return std::move(paths_); }

 private:
  void add(const Path& path) {
    std::string text;
    for (const auto& part : path) {
      if (part.field == nullptr) continue;
      if (text.empty() && part.field->name() == "case") continue;  // paths begin inside the case
      if (!text.empty()) text += '.';
      text += part.field->name();
      const int index = part.index >= 0 ? part.index : part.new_index;
      if (part.field->is_repeated() && index >= 0) text += fmt::format("[{}]", index);
    }
    if (text.ends_with(".content")) text.erase(text.size() - 8);
    if (paths_.size() < 12 && std::find(paths_.begin(), paths_.end(), text) == paths_.end()) paths_.push_back(text);
  }
  std::vector<std::string> paths_;
};

}  // namespace

std::string serialise(const google::protobuf::Message& message) {
  std::string out;
  {
    google::protobuf::io::StringOutputStream stream(&out);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    message.SerializeToCodedStream(&coded);
  }
  return out;
}

std::string encode_spec(const v1::Case& message, const Files& files) {
  v1::CreateJobRequest spec;
  *spec.mutable_case_() = message;
  std::map<std::string, const v1::CaseFile*> sorted;
  for (const v1::CaseFile& file : files) sorted.emplace(file.name(), &file);
  for (const auto& [name, file] : sorted) *spec.add_files() = *file;
  return serialise(spec);
}

v1::CreateJobRequest decode_spec(const std::string& bytes) {
  v1::CreateJobRequest spec;
  if (!spec.ParseFromString(bytes)) fail(ErrorCode::data_loss, "the stored case cannot be read");
  return spec;
}

sim::Case bind_case(const v1::Case& message, const Files& files, const Workspace& workspace) {
  auto known = by_name(files);
  sim::Case core = convert::to_core(message);
  std::set<std::string> used;
  for (const NamedFile& named : files_of(core)) {
    const auto file = known.find(*named.name);
    if (file == known.end())
      throw convert::InputError("INVALID_FILES", {{sim::Diagnostic::Severity::error, named.field,
                                                   fmt::format("'{}' did not come with the case", *named.name),
                                                   "send it in files, under the same name"}});
    used.insert(*named.name);
    *named.name = workspace.keep_file(file->second->content());
  }
  for (const std::string& name : used) known.erase(name);
  if (!known.empty())
    throw convert::InputError("INVALID_FILES", {{sim::Diagnostic::Severity::error, "files",
                                                 fmt::format("'{}' is named nowhere in the case", known.begin()->first),
                                                 "leave it out, or name it in the case"}});
  return core;
}

void check_files(const Files& files) { by_name(files); }

v1::CaseReport check_case(const v1::Case& message, const Files& files, const Workspace& workspace, const Solver& solver) {
  return convert::to_proto(solver.check(bind_case(message, files, workspace)));
}

std::vector<std::string> differing_fields(const std::string& spec_a, const std::string& spec_b) {
  PathReporter reporter;
  google::protobuf::util::MessageDifferencer differencer;
  google::protobuf::util::DefaultFieldComparator numbers;
  numbers.set_treat_nan_as_equal(true);
  differencer.set_field_comparator(&numbers);
  differencer.ReportDifferencesTo(&reporter);
  differencer.Compare(decode_spec(spec_a), decode_spec(spec_b));
  return reporter.take();
}

}  // namespace seaway::jobs
