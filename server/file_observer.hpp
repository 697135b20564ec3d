// SPDX-License-Identifier: GPL-3.0-or-later
// Writes what a run reports into a folder: history.csv (as `seaway history` prints it), stages.json. Lines
// are written as samples come, so a killed run has lost none that precedes its last checkpoint.
#pragma once

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "core/sim/run_observer.hpp"
#include "seaway/v1/job.pb.h"
#include "seaway/v1/result.pb.h"

namespace seaway::server {

class FileObserver final : public sim::RunObserver {
 public:
  using Show = std::function<void(const sim::Progress&, const FileObserver&)>;
  /// Keeps the history that is in the folder already; a resumed run repeats or continues it.
  /// `show` is told of the progress.
  FileObserver(std::string folder, Show show);
  ~FileObserver() override;

  void on_channels(const std::vector<sim::Channel>& channels) override;
  void on_stage_started(const sim::StageInfo& info) override;
  void on_sample(const sim::Sample& sample) override;
  void on_progress(const sim::Progress& progress) override;
  void on_stage_finished(const sim::StageResult& result) override;
  void on_checkpoint(const std::string& path, std::int64_t sequence, double write_s) override;
  void on_artifact(const std::string& name, const std::string& path, const std::string& media_type) override;
  void on_event(const std::string& kind, const std::string& text) override;

  std::int64_t last_sequence() const { return static_cast<std::int64_t>(lines_.size()); }
  const std::vector<v1::StageReport>& stages() const { return stages_; }
  const std::vector<std::string>& artifacts() const { return artifacts_; }
  const std::vector<std::string>& events() const { return events_; }
  /// Last value of a channel in its edge unit; 0 if there is none.
  double last_value(const std::string& channel) const;

 private:
  void load_history();
  void load_stages();
  void write_stages() const;

  const std::string folder_;
  const Show show_;
  std::vector<sim::Channel> channels_;
  std::string header_;
  std::vector<std::size_t> lines_;  ///< hash of each line of the history, to check what is repeated
  std::vector<double> last_;
  int history_ = -1;                ///< file descriptor, appending
  std::vector<v1::StageReport> stages_;
  std::vector<std::string> artifacts_, events_;
  bool mismatch_told_ = false;
};

}  // namespace seaway::server
