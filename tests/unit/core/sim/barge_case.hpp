// Barges in small tanks: cases of a few thousand cells.
#pragma once

#include <string>
#include <vector>

#include "core/base/run_context.hpp"
#include "core/sim/cascade.hpp"
#include "core/sim/simulation.hpp"

namespace seaway::sim::testing {

/// A barge of 0.3 x 0.1 m at 50 mm draft in calm water, one stage, held.
inline Case barge(double hull_cell = 0.0125) {
  Case c;
  c.title = "barge";
  c.tank.lower = {0, -0.8, -0.4};
  c.tank.upper = {0, 0.8, 0.4};
  c.base_cell = 0.05;
  c.hull.shape = Hull::Shape::box;
  c.hull.beam = 0.3;
  c.hull.height = 0.1;
  c.body.mass = 15;
  c.body.draft = 0.05;
  c.body.cog = {0, 0, 0.05};
  c.body.gyradii = {0.1322, 0, 0};
  c.time.dt = 0.008;
  Stage s;
  s.name = "A";
  s.mesh.hull_cell = hull_cell;
  s.mesh.hull_sweep = 20 * degree;
  s.end.duration = 0.12;
  c.stages = {s};
  return c;
}

/// The barge freed at 10 degrees, first on a coarse, then on a finer mesh.
inline Case two_stages() {
  Case c = barge(0.025);
  c.body.free = {Dof::heave, Dof::roll};
  c.body.angles = {10 * degree, 0, 0};
  c.body.release = Body::Release::at_time;
  c.body.release_time = 0.04;
  c.outputs.gauges = {{"side", 0, 0.4}};
  Stage finer = c.stages[0];
  finer.name = "B";
  finer.mesh.hull_cell = 0.0125;
  c.stages.push_back(finer);
  return c;
}

inline std::unique_ptr<Simulation<2>> simulate(const Case& c, int threads = 1) {
  auto model = std::make_shared<Model<2>>(make_model<2>(c));
  auto forest = make_forest<2>(*model, c.stages[0].mesh, threads);
  auto simulation =
      std::make_unique<Simulation<2>>(model, std::move(forest), quiet_context(threads));
  simulation->initialise();
  return simulation;
}

/// Largest face velocity of the fluid that counts (w: hull and fluid).
inline double largest_velocity(const Simulation<2>& s) {
  double largest = 0;
  for (const int b : s.forest().leaves())
    for (int axis = 0; axis < 2; ++axis)
      for (int i = 0; i < mesh::BlockShape<2>::faces; ++i)
        largest = std::max(largest, std::abs(s.state().w.block(axis, b)[i]));
  return largest;
}

/// Keeps everything, and asks for a stop after `stop_after` samples of this attempt (0: never).
class Keeper : public RunObserver {
 public:
  explicit Keeper(int stop_after = 0) : stop_after_(stop_after) {}
  void on_channels(const std::vector<Channel>& c) override { channels = c; }
  void on_stage_started(const StageInfo& i) override { started.push_back(i); }
  void on_sample(const Sample& s) override {
    samples.push_back(s);
    if (stop_after_ > 0 && static_cast<int>(samples.size()) >= stop_after_) stop.request_stop();
  }
  void on_progress(const Progress& p) override { progress = p; }
  void on_stage_finished(const StageResult& r) override { finished.push_back(r); }
  void on_checkpoint(const std::string& path, std::int64_t sequence, double) override {
    checkpoints.emplace_back(path, sequence);
  }
  void on_artifact(const std::string&, const std::string& path, const std::string&) override {
    artifacts.push_back(path);
  }
  void on_event(const std::string& kind, const std::string& text) override {
    events.emplace_back(kind, text);
  }
  int count(const std::string& kind) const {
    int n = 0;
    for (const auto& e : events) n += e.first == kind;
    return n;
  }
  std::size_t channel(const std::string& name) const {
    for (std::size_t i = 0; i < channels.size(); ++i)
      if (channels[i].name == name) return i;
    return channels.size();
  }

  std::vector<Channel> channels;
  std::vector<StageInfo> started;
  std::vector<Sample> samples;
  std::vector<StageResult> finished;
  Progress progress;  ///< the latest
  std::vector<std::pair<std::string, std::int64_t>> checkpoints;
  std::vector<std::string> artifacts;
  std::vector<std::pair<std::string, std::string>> events;
  std::stop_source stop;

 private:
  int stop_after_;
};

inline RunOutcome run(const Case& c, const std::string& folder, Keeper& keeper, int threads = 1,
                      double checkpoint_interval = 0) {
  RunOptions options;
  options.folder = folder;
  options.checkpoint_interval = checkpoint_interval;
  options.case_digest = "digest";
  RunContext context = quiet_context(threads);
  context.stop = keeper.stop.get_token();
  return run_cascade(c, options, keeper, context);
}

}  // namespace seaway::sim::testing
