// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/file_observer.hpp"

#include <fcntl.h>
#include <google/protobuf/util/json_util.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "core/base/error.hpp"
#include "proto/history_csv.hpp"
#include "proto/json.hpp"
#include "seaway/v1/job_service.pb.h"
#include "server/convert/result.hpp"

namespace seaway::server {
namespace {

std::size_t hash_of(std::string_view line) { return std::hash<std::string_view>{}(line); }

}  // namespace

FileObserver::FileObserver(std::string folder, Show show) : folder_(std::move(folder)), show_(std::move(show)) {
  load_history();
  load_stages();
}

FileObserver::~FileObserver() {
  if (history_ >= 0) ::close(history_);
}

void FileObserver::load_history() {
  const std::string path = folder_ + "/history.csv";
  std::string text;
  {
    std::ifstream in(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;  // without a torn line
  std::size_t at = 0;
  while (at < whole) {
    const std::size_t end = text.find('\n', at) + 1;
    if (at == 0)
      header_ = text.substr(0, end);
    else
      lines_.push_back(hash_of(std::string_view(text).substr(at, end - at)));
    at = end;
  }
  history_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (history_ < 0 || ::ftruncate(history_, static_cast<off_t>(whole)) != 0)
    fail(ErrorCode::unavailable, "{}: {}", path, std::strerror(errno));
}

void FileObserver::load_stages() {
  std::ifstream in(folder_ + "/stages.json");
  std::stringstream text;
  text << in.rdbuf();
  v1::ListStagesResponse known;
  if (!google::protobuf::util::JsonStringToMessage(text.str(), &known).ok()) return;
  for (const auto& stage : known.stages())
    if (stage.finished()) stages_.push_back(stage);
}

void FileObserver::write_stages() const {
  v1::ListStagesResponse all;
  for (const auto& stage : stages_) *all.add_stages() = stage;
  const std::string path = folder_ + "/stages.json";
  std::ofstream(path + ".new") << to_json(all, true);
  std::filesystem::rename(path + ".new", path);
}

void FileObserver::on_channels(const std::vector<sim::Channel>& channels) {
  channels_ = channels;
  google::protobuf::RepeatedPtrField<v1::ChannelSchema> schema;
  for (const sim::Channel& c : channels) *schema.Add() = convert::to_proto(c);
  const std::string header = history_csv::header(schema);
  if (!header_.empty() && header_ != header)
    fail(ErrorCode::failed_precondition, "{}/history.csv has other channels; choose another folder or --fresh", folder_);
  if (header_.empty() && ::write(history_, header.data(), header.size()) != static_cast<ssize_t>(header.size()))
    fail(ErrorCode::unavailable, "{}/history.csv: {}", folder_, std::strerror(errno));
  header_ = header;
}

void FileObserver::on_stage_started(const sim::StageInfo& info) {
  std::erase_if(stages_, [&](const auto& s) { return s.stage() >= info.stage; });
  stages_.push_back(convert::to_proto(info));
  write_stages();
}

void FileObserver::on_sample(const sim::Sample& sample) {
  v1::SampleChunk chunk;
  convert::append(sample, channels_, chunk);
  std::string line;
  history_csv::append(chunk, line);
  last_.clear();
  for (const auto& column : chunk.columns()) last_.push_back(column.values(0));
  const auto index = static_cast<std::size_t>(sample.sequence - 1);
  if (index < lines_.size()) {
    if (lines_[index] != hash_of(line) && !std::exchange(mismatch_told_, true))
      on_event("REPLAY_MISMATCH", "sample " + std::to_string(sample.sequence) + " came out differently; the first one stays");
    return;
  }
  if (index > lines_.size())
    fail(ErrorCode::data_loss, "sample {} came, {} was due: {}/history.csv is older than the checkpoint; run again with --fresh",
         sample.sequence, lines_.size() + 1, folder_);
  if (::write(history_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    fail(ErrorCode::unavailable, "{}/history.csv: {}", folder_, std::strerror(errno));
  lines_.push_back(hash_of(line));
}

void FileObserver::on_progress(const sim::Progress& progress) {
  if (show_) show_(progress, *this);
}

void FileObserver::on_stage_finished(const sim::StageResult& result) {
  std::erase_if(stages_, [&](const auto& s) { return s.stage() >= result.info.stage; });
  stages_.push_back(convert::to_proto(result));
  write_stages();
}

void FileObserver::on_checkpoint(const std::string&, std::int64_t, double) { ::fdatasync(history_); }

void FileObserver::on_artifact(const std::string& name, const std::string&, const std::string&) {
  if (std::find(artifacts_.begin(), artifacts_.end(), name) == artifacts_.end()) artifacts_.push_back(name);
}

void FileObserver::on_event(const std::string& kind, const std::string& text) { events_.push_back(kind + ": " + text); }

double FileObserver::last_value(const std::string& channel) const {
  for (std::size_t i = 0; i < std::min(channels_.size(), last_.size()); ++i)
    if (channels_[i].name == channel) return last_[i];
  return 0;
}

}  // namespace seaway::server
