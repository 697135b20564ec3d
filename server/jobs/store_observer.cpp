// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/jobs/store_observer.hpp"

#include <algorithm>
#include <filesystem>

#include "core/base/error.hpp"
#include "server/convert/result.hpp"
#include "server/jobs/workspace.hpp"

namespace seaway::jobs {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::milliseconds progress_interval{250};

store::Progress to_row(const sim::Progress& p) {
  return {p.stage, p.stage_count, p.time, p.fraction, p.remaining_s, p.held};
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() <= 100 && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
                  c == '.';
         });
}

}  // namespace

StoreObserver::StoreObserver(std::string uid, std::int64_t last_sequence, std::string folder, store::JobStore& store,
                             std::shared_ptr<spdlog::logger> log, metrics::Metrics* metrics,
                             std::function<Clock::time_point()> now)
    : uid_(std::move(uid)), folder_(std::move(folder)), store_(store), log_(std::move(log)), metrics_(metrics),
      now_(std::move(now)), next_(last_sequence + 1) {}

void StoreObserver::on_channels(const std::vector<sim::Channel>& channels) {
  std::vector<store::Channel> rows;
  for (const sim::Channel& c : channels) rows.push_back({c.name, c.unit});
  if (next_ > 1 && store_.channels(uid_) != rows)
    fail(ErrorCode::data_loss, "the run has other channels than its stored history; submit the case as a new job");
  store_.set_channels(uid_, std::move(rows));
}

void StoreObserver::put_stage(const v1::StageReport& r) {
  if (r.finished()) send_progress();
  cells_ = r.cell_count();
  if (r.finished() && metrics_ != nullptr) {
    std::map<std::string, double> phases;
    for (const v1::PhaseTiming& phase : r.phases()) phases[phase.phase()] = phase.cpu_s();
    metrics_->stage_finished(r.stage(), phases);
  }
  store_.put_stage(uid_, {r.stage(), r.SerializeAsString()});
  if (r.finished())
    log_->info("job={} stage={} event=stage_finished steps={} cpu_s={:.2f} converged={}", uid_, r.stage(), r.step_count(),
               r.cpu_s(), r.converged());
  else
    log_->info("job={} stage={} name={} event=stage_started cells={} levels={} h={} dt={}", uid_, r.stage(), r.name(),
               r.cell_count(), r.level_count(), r.finest_cell_m(), r.dt_s());
}

void StoreObserver::on_stage_started(const sim::StageInfo& info) { put_stage(convert::to_proto(info)); }

void StoreObserver::on_sample(const sim::Sample& s) {
  if (s.sequence > next_)
    fail(ErrorCode::data_loss, "sample {} came, {} was due: the run went on from a checkpoint that is newer than the "
         "stored history", s.sequence, next_);
  next_ = std::max(next_, s.sequence + 1);
  count_steps(s);
  store_.add_samples(uid_, {{s.sequence, s.stage, s.step, s.time, s.values}});
}

void StoreObserver::count_steps(const sim::Sample& s) {
  if (s.sequence == 1) step_ = 0;
  if (metrics_ != nullptr && step_ >= 0 && s.step > step_) metrics_->stepped(s.step - step_, cells_);
  step_ = s.step;
}

void StoreObserver::on_progress(const sim::Progress& progress) {
  const bool turned = progress.stage != progress_.stage || progress.held != progress_.held;
  progress_ = progress;
  progress_waits_ = true;
  if (turned || now_() - progress_sent_ >= progress_interval) send_progress();
}

void StoreObserver::on_stage_finished(const sim::StageResult& result) { put_stage(convert::to_proto(result)); }

void StoreObserver::on_checkpoint(const std::string& path, std::int64_t sequence, double write_s) {
  put_checkpoint(describe_checkpoint(path, sequence), write_s);
}

void StoreObserver::put_checkpoint(const store::Checkpoint& checkpoint, double write_s) {
  if (!is_in_folder(checkpoint.path) || checkpoint.sequence >= next_)
    fail(ErrorCode::internal, "checkpoint {} after sample {} is not one of this run", checkpoint.path, checkpoint.sequence);
  store_.add_checkpoint(uid_, checkpoint);
  if (metrics_ != nullptr) metrics_->checkpoint_written(write_s);
  log_->debug("job={} event=checkpoint sequence={}", uid_, checkpoint.sequence);
}

bool StoreObserver::is_in_folder(const std::string& absolute) const {
  const fs::path relative = fs::path(absolute).lexically_normal().lexically_relative(folder_);
  return !relative.empty() && *relative.begin() != ".." && *relative.begin() != ".";
}

void StoreObserver::on_artifact(const std::string& name, const std::string& path, const std::string& media_type) {
  const fs::path absolute = fs::absolute(path).lexically_normal();
  std::error_code error;
  const auto size = fs::file_size(absolute, error);
  if (!is_plain_name(name) || !is_in_folder(absolute.string()) || error)
    fail(ErrorCode::internal, "artifact '{}' at {} is not a file of this run", name, path);
  store_.add_artifact(uid_, {name, absolute.string(), media_type, static_cast<std::int64_t>(size), 0});
}

void StoreObserver::on_event(const std::string& kind, const std::string& text) {
  store_.add_event(uid_, kind, text);
  log_->info("job={} event={} text=\"{}\"", uid_, kind, text);
}

void StoreObserver::finish() { send_progress(); }

void StoreObserver::send_progress() {
  if (!progress_waits_) return;
  progress_waits_ = false;
  progress_sent_ = now_();
  store_.set_progress(uid_, to_row(progress_));
}

}  // namespace seaway::jobs
