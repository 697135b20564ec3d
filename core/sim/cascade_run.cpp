#include "core/sim/cascade_run.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/sim/ship_snapshot.hpp"
#include "core/sim/snapshot.hpp"

namespace seaway::sim {
namespace {

double seconds_since(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

/// Water this slow counts as still: the hull may be released in calm water [m/s].
constexpr double still_velocity = 2e-3;

/// Of the free surface seen from above: enough for a picture, about 0.3 MB of text.
constexpr int plan_squares = 40000;

transfer::MapOptions map_options(const Mapping& m) {
  transfer::MapOptions options;
  switch (m.method) {
    case Mapping::Method::local_rbf: options.method = transfer::MapMethod::local_rbf; break;
    case Mapping::Method::linear: options.method = transfer::MapMethod::linear; break;
    case Mapping::Method::prbf: options.method = transfer::MapMethod::prbf; break;
  }
  options.prbf.k = m.k;
  options.prbf.subsets = m.subsets;
  options.prbf.kernel = static_cast<transfer::Kernel>(m.kernel);
  options.prbf.shape = m.shape;
  options.prbf.tail_degree = m.tail_degree;
  options.prbf.ordering = static_cast<transfer::Ordering>(m.ordering);
  options.prbf.seed = m.seed;
  options.prbf.evaluate_all = m.evaluate_all;
  return options;
}

}  // namespace

template <int Dim>
CascadeRun<Dim>::CascadeRun(const Case& c, const RunOptions& options, RunObserver& observer,
                            const RunContext& context)
    : case_(c), options_(options), observer_(observer), context_(context),
      model_(std::make_shared<Model<Dim>>(make_model<Dim>(c))), recorder_(*model_) {
  for (const Stage& stage : case_.stages) stage_cells_.push_back(make_forest(*model_, stage.mesh, 1)->n_cells());
}

template <int Dim>
RunOutcome CascadeRun<Dim>::run() {
  observer_.on_channels(recorder_.channels());
  run_begun_ = last_checkpoint_ = last_progress_ = stage_begun_ = Clock::now();
  if (!options_.resume) discard_checkpoints();
  if (!options_.resume || !resume()) start();
  for (;;) {
    if (!stage_.finished) {
      if (auto outcome = run_stage()) return *outcome;
      finish_stage();
    }
    if (stage_.index + 1 == static_cast<int>(case_.stages.size())) break;
    map_to_stage(stage_.index + 1);
  }
  report_progress(true);
  return {StopReason::finished, ""};
}

template <int Dim>
void CascadeRun<Dim>::make_simulation(std::unique_ptr<Forest<Dim>> forest, int stage) {
  simulation_ = std::make_unique<Simulation<Dim>>(model_, std::move(forest), context_);
  simulation_->want_step(model_->stage_dt[static_cast<std::size_t>(stage)]);
}

template <int Dim>
void CascadeRun<Dim>::start() {
  make_simulation(make_forest(*model_, case_.stages[0].mesh, context_.threads), 0);
  simulation_->initialise();
  initial_water_ = simulation_->water().visible;
  begin_stage(0);
  flow_monitor_ = CycleMonitor(0.0, model_->period, recorder_.channels().size());
  if (simulation_->body().released) start_motion_monitor();
}

template <int Dim>
void CascadeRun<Dim>::begin_stage(int index) {
  stage_ = {};
  stage_.index = index;
  stage_.start_time = simulation_->time();
  stage_.start_step = simulation_->steps();
  stage_begun_ = Clock::now();
  next_snapshot_ = simulation_->time() + case_.outputs.snapshot_interval;
  observer_.on_stage_started(info());
  context_.log->info("stage={} name={} cells={} finest={:.4g} t={:.4g} dt={:.4g}", index, case_.stages[static_cast<std::size_t>(index)].name,
                     simulation_->forest().n_cells(), simulation_->forest().finest_cell(), simulation_->time(),
                     simulation_->dt());
}

template <int Dim>
void CascadeRun<Dim>::start_motion_monitor() {
  motion_monitor_ = CycleMonitor(simulation_->time(), model_->period, recorder_.channels().size());
}

template <int Dim>
StageInfo CascadeRun<Dim>::info() const {
  const auto& forest = simulation_->forest();
  return {stage_.index, case_.stages[static_cast<std::size_t>(stage_.index)].name, forest.n_cells(),
          forest.n_levels(), forest.finest_cell(), stage_.start_time, model_->stage_dt[static_cast<std::size_t>(stage_.index)]};
}

template <int Dim>
std::optional<RunOutcome> CascadeRun<Dim>::run_stage() {
  while (!stage_is_over()) {
    if (context_.stop.stop_requested()) {
      write_checkpoint();
      return RunOutcome{StopReason::cancelled, "stopped on request"};
    }
    take_step();
    if (failed_) {
      const std::string message = fmt::format(
          "{} (stage {}, step {}); the last good checkpoint is kept; use a smaller time.dt_s, a finer hull cell or "
          "check mass and inertia",
          last_step_.failure, case_.stages[static_cast<std::size_t>(stage_.index)].name, simulation_->steps());
      context_.log->error("diverged: {}", message);
      return RunOutcome{StopReason::diverged, message};
    }
    if (options_.checkpoint_interval > 0 && seconds_since(last_checkpoint_) > options_.checkpoint_interval)
      write_checkpoint();
    report_progress(false);
  }
  return std::nullopt;
}

template <int Dim>
void CascadeRun<Dim>::take_step() {
  last_step_ = simulation_->step();
  if (!last_step_.failed && !last_step_.pressure.converged) {
    last_step_.failed = true;
    last_step_.failure = fmt::format("the pressure solve stopped after {} iterations with a residual of {:.3g}",
                                     last_step_.pressure.iterations, last_step_.pressure.residual_after);
  }
  if (last_step_.failed) {
    failed_ = true;
    return;
  }
  stage_.iterations += last_step_.pressure.iterations;
  stage_.max_iterations = std::max(stage_.max_iterations, last_step_.pressure.iterations);
  work_done_ += static_cast<double>(simulation_->forest().n_cells());
  const double t = simulation_->time();
  const std::vector<double> values = recorder_.values(*simulation_, last_step_, initial_water_);
  if (simulation_->body().released) motion_monitor_.add(t, values);
  else flow_monitor_.add(t, values);
  if (t >= next_sample_ - 1e-9) {
    Sample sample;
    sample.sequence = ++sequence_;
    sample.stage = stage_.index;
    sample.step = simulation_->steps();
    sample.time = t;
    sample.values = values;
    observer_.on_sample(sample);
    next_sample_ = case_.outputs.sample_interval > 0 ? next_sample_ + case_.outputs.sample_interval : t;
  }
  if (case_.outputs.snapshot_interval > 0 && t >= next_snapshot_ - 1e-9) {
    snapshot();
    next_snapshot_ += case_.outputs.snapshot_interval;
  }
  if (!simulation_->body().released) watch_release();
  context_.log->debug("stage={} step={} t={:.4f} dt={:.5f} cfl={:.2f} p_iter={} p_res={:.2e}", stage_.index,
                      simulation_->steps(), t, simulation_->dt(), last_step_.courant, last_step_.pressure.iterations,
                      last_step_.pressure.residual_after);
}

/// Frees the hull when its rule says so.
template <int Dim>
void CascadeRun<Dim>::watch_release() {
  if (!model_->hull) return;
  const Body& body = case_.body;
  const double t = simulation_->time();
  bool release = false;
  std::string why;
  if (body.release == Body::Release::at_time) {
    release = t >= body.release_time - 0.5 * simulation_->dt();
    why = "its time has come";
  } else if (body.release == Body::Release::converged) {
    const double elapsed = model_->period > 0 ? t / model_->period : t;
    if (model_->wave) {
      const auto count = static_cast<int>(flow_monitor_.count());
      const double change = flow_monitor_.amplitude_change(recorder_.release_loads(), 1);
      release = (count >= body.release_min_periods && change < body.release_tolerance) ||
                count >= body.release_max_periods;
      why = fmt::format("force and moment changed by {:.2g} in the last of {} periods", change, count);
    } else {
      const double v = simulation_->rms_water_velocity();
      release = (elapsed >= 0.5 && v < still_velocity) || elapsed >= body.release_max_periods;
      why = fmt::format("the water's rms velocity is {:.2g} m/s", v);
    }
  }
  if (!release) return;
  simulation_->release();
  start_motion_monitor();
  const std::string text = fmt::format("hull released at t = {:.3f} s: {}", t, why);
  context_.log->info("{}", text);
  observer_.on_event("released", text);
}

template <int Dim>
bool CascadeRun<Dim>::stage_is_over() const {
  const EndRule& end = case_.stages[static_cast<std::size_t>(stage_.index)].end;
  const double elapsed = simulation_->time() - stage_.start_time;
  if (end.kind == EndRule::Kind::time) return elapsed >= end.duration - 0.5 * simulation_->dt();
  if (model_->hull && !simulation_->body().released) return false;
  if (static_cast<double>(motion_monitor_.count()) >= end.max_periods) return true;
  return motion_monitor_.repeats(recorder_.free_motions(), end.tolerance, end.min_periods);
}

template <int Dim>
StageResult CascadeRun<Dim>::result() const {
  const Stage& stage = case_.stages[static_cast<std::size_t>(stage_.index)];
  StageResult r;
  r.info = info();
  r.end_time = simulation_->time();
  r.steps = simulation_->steps() - stage_.start_step;
  r.phases = simulation_->clock().times();
  for (const auto& [phase, seconds] : stage_.phases) r.phases[phase] += seconds;
  for (const auto& [phase, seconds] : r.phases) r.cpu_s += seconds;
  r.wall_s = stage_.wall_s + seconds_since(stage_begun_);
  r.mean_pressure_iterations = r.steps > 0 ? static_cast<double>(stage_.iterations) / static_cast<double>(r.steps) : 0;
  r.max_pressure_iterations = stage_.max_iterations;
  const WaterBalance water = simulation_->water();
  const double scale = model_->displacement > 0 ? model_->displacement : initial_water_;
  r.volume_drift = scale > 0 ? (water.visible - initial_water_ - water.exchanged) / scale : 0;
  r.has_mapping = stage_.has_mapping;
  r.mapping = stage_.mapping;
  for (const auto& [space, range] : simulation_->y_plus()) {
    if (!(range.weight > 0)) continue;
    const std::string name = space > 0 ? model_->compartments[static_cast<std::size_t>(space - 1)] : "hull";
    r.walls.push_back({name, range.smallest, range.mean(), range.largest});
  }
  const double change = motion_monitor_.motion_change(recorder_.free_motions(), 2);
  r.converged = stage.end.kind == EndRule::Kind::time || change < stage.end.tolerance;
  for (const std::size_t k : recorder_.motions()) {
    const auto mean = motion_monitor_.average(k, 3);
    const double own = std::find(recorder_.free_motions().begin(), recorder_.free_motions().end(), k) !=
                               recorder_.free_motions().end()
                           ? motion_monitor_.motion_change({k}, 2)
                           : 0.0;
    r.motions.push_back({recorder_.channels()[k].name, mean.amplitude, mean.mean, motion_monitor_.signal_period(k, 3),
                         std::isfinite(own) ? own : -1});
  }
  return r;
}

template <int Dim>
void CascadeRun<Dim>::finish_stage() {
  snapshot();
  simulation_->clock().charge("output");
  stage_.finished = true;
  observer_.on_stage_finished(result());
  write_checkpoint();
}

template <int Dim>
void CascadeRun<Dim>::snapshot() {
  const std::string at = fmt::format("{}_{:09.4f}", stage_.index, simulation_->time());
  const auto file = [&](const std::string& name, const char* type, const auto& write) {
    write(options_.folder + "/" + name);
    observer_.on_artifact(name, options_.folder + "/" + name, type);
  };
  if constexpr (Dim == 2) {
    file("section_" + at + ".json", "application/json",
         [&](const std::string& path) { write_section(*simulation_, stage_.index, path); });
  } else {
    const double amidships = simulation_->body().pose.cog.x();
    file("section_" + at + ".json", "application/json",
         [&](const std::string& path) { write_section(*simulation_, amidships, stage_.index, path); });
    file("plan_" + at + ".json", "application/json",
         [&](const std::string& path) { write_plan(*simulation_, stage_.index, plan_squares, path); });
    file("surface_" + at + ".vtp", "application/octet-stream",
         [&](const std::string& path) { io::write_vtp(free_surface(*simulation_), path); });
    if (model_->hull)
      file("hull_" + at + ".vtp", "application/octet-stream",
           [&](const std::string& path) { io::write_vtp(hull_mesh(*simulation_), path); });
  }
  simulation_->clock().charge("output");
}

/// The flow goes on on the next stage's mesh.
template <int Dim>
void CascadeRun<Dim>::map_to_stage(int index) {
  const Stage& stage = case_.stages[static_cast<std::size_t>(index)];
  const double cpu_before = process_cpu_seconds();
  auto old = std::move(simulation_);
  old->polish();
  const WaterBalance water_before = old->water();
  const std::vector<double> compartments_before = old->compartment_volumes();
  auto forest = make_forest(*model_, stage.mesh, context_.threads);
  transfer::FlowFields<Dim> from, to;
  from.vof = std::move(old->state().vof);
  from.p = std::move(old->state().p);
  from.u = std::move(old->state().u);
  from.w = std::move(old->state().w);
  if (old->state().turbulent()) from.extra = {std::move(old->state().tke), std::move(old->state().epsilon)};
  const transfer::MapReport report = transfer::map_flow<Dim>(map_options(stage.mapping), old->forest(), *forest, from, to);
  std::vector<char> free_cells(report.origin.size());
  for (std::size_t i = 0; i < free_cells.size(); ++i) free_cells[i] = report.origin[i] != 0;
  make_simulation(std::move(forest), index);
  flow::FlowState<Dim> state(simulation_->forest());
  state.vof = std::move(to.vof);
  state.p = std::move(to.p);
  state.u = std::move(to.u);
  state.w = std::move(to.w);
  if (to.extra.size() == 2) {
    state.tke = std::move(to.extra[0]);
    state.epsilon = std::move(to.extra[1]);
  }
  simulation_->set_exchanged(old->exchanged());
  const auto [before, after] = simulation_->adopt(std::move(state), old->body(), old->time(), old->steps(),
                                                  old->dt(), old->reservoirs(), &free_cells);
  // The cells at the hull are filled anew on the new mesh and show a little more or less water than before.
  double of_sea = water_before.visible - simulation_->water().visible;
  const std::vector<double> compartments_after = simulation_->compartment_volumes();
  for (std::size_t i = 0; i < compartments_before.size(); ++i) {
    const double lost = compartments_before[i] - compartments_after[i];
    simulation_->owe(1 + static_cast<int>(i), lost);
    of_sea -= lost;
  }
  simulation_->owe(0, of_sea);
  begin_stage(index);
  stage_.has_mapping = true;
  stage_.mapping = {report.method, process_cpu_seconds() - cpu_before, report.vof_min, report.vof_max,
                    report.water_before, report.water_after, before, after, report.kept_cells, report.new_cells,
                    report.fall_backs};
  // All that happened here is mapping: the new simulation's own mesh and mapping times included.
  for (auto& [phase, seconds] : stage_.phases) seconds = 0;
  stage_.phases["mapping"] = stage_.mapping.cpu_s;
  simulation_->clock().restart();
  if (simulation_->body().released) start_motion_monitor();
  observer_.on_event("mapped", fmt::format("{} cells kept, {} new, {:.2f} CPU s, dt |div w| {:.1e} -> {:.1e}",
                                           report.kept_cells, report.new_cells, stage_.mapping.cpu_s, before, after));
}

template <int Dim>
double CascadeRun<Dim>::expected_duration(int index) const {
  const EndRule& end = case_.stages[static_cast<std::size_t>(index)].end;
  if (end.kind == EndRule::Kind::time) return end.duration;
  const double period = model_->period;
  double periods = std::clamp(6.0, end.min_periods, end.max_periods);
  double held = 0;
  if (index == 0 && model_->hull) {
    if (case_.body.release == Body::Release::converged) held = (case_.body.release_min_periods + 1) * period;
    if (case_.body.release == Body::Release::at_time) held = case_.body.release_time;
  }
  return held + periods * period;
}

template <int Dim>
void CascadeRun<Dim>::report_progress(bool force) {
  if (!force && seconds_since(last_progress_) < 0.25) return;
  last_progress_ = Clock::now();
  Progress progress;
  progress.stage = stage_.index;
  progress.stage_count = static_cast<int>(case_.stages.size());
  progress.time = simulation_->time();
  progress.held = model_->hull && !simulation_->body().released;
  double done = 0, total = 0;  // cell-steps
  for (int s = 0; s < progress.stage_count; ++s) {
    const double cells_per_dt = static_cast<double>(stage_cells_[static_cast<std::size_t>(s)]) / model_->stage_dt[static_cast<std::size_t>(s)];
    double duration = expected_duration(s);
    double elapsed = s < stage_.index ? duration : 0;
    if (s == stage_.index) {
      elapsed = simulation_->time() - stage_.start_time;
      duration = stage_.finished ? elapsed : std::max(duration, elapsed * 1.05);
    }
    total += cells_per_dt * duration;
    done += cells_per_dt * elapsed;
  }
  progress.fraction = total > 0 ? std::min(1.0, done / total) : 0;
  const double wall = seconds_since(run_begun_);
  if (done == total)
    progress.remaining_s = 0;
  else if (work_done_ > 0 && wall > 1)
    progress.remaining_s = (total - done) * wall / work_done_;
  observer_.on_progress(progress);
}

template class CascadeRun<2>;
template class CascadeRun<3>;

}  // namespace seaway::sim
