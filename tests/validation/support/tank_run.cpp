#include "tests/validation/support/tank_run.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/error.hpp"
#include "core/transfer/map_flow.hpp"
#include "core/waves/wave_field.hpp"
#include "proto/yaml.hpp"
#include "server/convert/case.hpp"

namespace seaway::validation {

template <int Dim>
std::unique_ptr<sim::Simulation<Dim>> start(const std::shared_ptr<const sim::Model<Dim>>& model, int threads) {
  auto forest = sim::make_forest<Dim>(*model, model->description.stages.front().mesh, threads);
  auto run = std::make_unique<sim::Simulation<Dim>>(model, std::move(forest), quiet_context(threads));
  run->initialise();
  return run;
}

std::unique_ptr<Section> start(const sim::Case& c, int threads) {
  return start<2>(std::make_shared<const sim::Model<2>>(sim::make_model<2>(c)), threads);
}

template <int Dim>
sim::StepReport step(sim::Simulation<Dim>& run) {
  sim::StepReport report = run.step();
  if (report.failed) fail(ErrorCode::diverged, "t = {:.4f} s: {}", run.time(), report.failure);
  return report;
}

template <int Dim>
double max_velocity(const sim::Simulation<Dim>& run) {
  double largest = 0;
  for (int axis = 0; axis < Dim; ++axis)
    for (const int b : run.forest().leaves())
      for (int i = 0; i < mesh::BlockShape<Dim>::faces; ++i)
        largest = std::max(largest, std::abs(run.state().w.block(axis, b)[i]));
  return largest;
}

#define SEAWAY_INSTANTIATE(D)                                                                                     \
  template std::unique_ptr<sim::Simulation<D>> start(const std::shared_ptr<const sim::Model<D>>&, int);            \
  template sim::StepReport step(sim::Simulation<D>&);                                                             \
  template double max_velocity(const sim::Simulation<D>&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

motion::DofVector<2> displacement(const Section& run) {
  return motion::displacement<2>(run.body().pose, run.model().rest_cog);
}

MappedRun map_to_stage(Section& from, const sim::Stage& stage, int threads) {
  auto model = std::make_shared<sim::Model<2>>(from.model());
  auto forest = sim::make_forest<2>(*model, stage.mesh, threads);
  transfer::FlowFields<2> in, out;
  in.vof = std::move(from.state().vof);
  in.p = std::move(from.state().p);
  in.u = std::move(from.state().u);
  in.w = std::move(from.state().w);
  if (from.state().turbulent()) in.extra = {std::move(from.state().tke), std::move(from.state().epsilon)};
  const auto report = transfer::map_flow<2>({}, from.forest(), *forest, in, out);
  std::vector<char> new_cells(report.origin.size());
  for (std::size_t i = 0; i < new_cells.size(); ++i) new_cells[i] = report.origin[i] != 0;
  MappedRun mapped;
  mapped.run = std::make_unique<Section>(model, std::move(forest), quiet_context(threads));
  flow::FlowState<2> state(mapped.run->forest());
  state.vof = std::move(out.vof);
  state.p = std::move(out.p);
  state.u = std::move(out.u);
  state.w = std::move(out.w);
  if (out.extra.size() == 2) {
    state.tke = std::move(out.extra[0]);
    state.epsilon = std::move(out.extra[1]);
  }
  mapped.run->set_exchanged(from.exchanged());
  std::tie(mapped.divergence_before, mapped.divergence_after) =
      mapped.run->adopt(std::move(state), from.body(), from.time(), from.steps(), from.dt(),
                        from.reservoirs(), &new_cells);
  return mapped;
}

sim::Case barge_in_plain_tank(double h, double roll) {
  sim::Case c;
  c.title = "barge";
  // Whole blocks of base cells, so that the cells are squares of exactly h; 0.37 and 0.21 are no
  // fractions that the hull's sides, at multiples of 50 mm, could meet.
  c.base_cell = 0.04;
  c.tank.lower = {0, -3.52 + 0.37 * h, -0.90 + 0.21 * h};
  c.tank.upper = {0, 3.52 + 0.37 * h, 0.38 + 0.21 * h};
  c.hull.shape = sim::Hull::Shape::box;
  c.hull.beam = 0.3;
  c.hull.height = 0.1;
  c.body.mass = 15;
  c.body.cog = {0, 0, 0.05};
  c.body.gyradii = {std::sqrt(0.262 / 15), 0, 0};
  c.body.draft = 0.05;
  c.body.angles = {roll, 0, 0};
  sim::Stage stage;
  stage.name = "only";
  stage.mesh.hull_cell = h;
  stage.mesh.surface = {{2 * h, 0.06, 1.0}, {0.02, 0.06}};
  stage.end.duration = 1;
  c.stages = {stage};
  return c;
}

sim::Case barge_case(double h, double roll) {
  sim::Case c = barge_in_plain_tank(h, roll);
  c.zones.generation_length = c.zones.absorption_length = 1.5;  // towards calm water at both ends
  c.zones.rate = 6;
  return c;
}

sim::Case WaveBox::with_columns(int columns) {
  waves::RegularWaveSpec spec;
  spec.height = height;
  spec.period = period;
  spec.depth = depth;
  const double length = waves::make_wave(spec)->length();
  sim::Case c;
  c.base_cell = length / 48;
  c.tank.lower = {0, -length / 2, -depth};
  c.tank.upper = {0, length / 2, 1.05};
  c.tank.periodic = {false, true, false};
  c.wave.kind = sim::Wave::Kind::regular;
  c.wave.height = height;
  c.wave.length = length;
  sim::Stage stage;
  stage.mesh.surface = {{length / columns, 0.06}};
  c.stages = {stage};
  return c;
}

sim::Case example_case(const std::string& file) {
  const std::string folder = SEAWAY_EXAMPLES;
  v1::Case message;
  yaml::read_file(folder + "/" + file, message);
  sim::Case c = convert::to_core(message);
  c.folder = folder;
  return c;
}

namespace {

/// The rule of the example's last stage, all cells multiplied by `scale`.
sim::MeshRule scaled_mesh(double scale, double within) {
  sim::MeshRule rule;
  rule.hull_cell = 0.005 * scale;
  rule.surface = {
      {0.020 * scale, 0.12}, {0.010 * scale, 0.0915, 2 * within}, {0.005 * scale, 0.061, within}};
  return rule;
}

}  // namespace

sim::MeshRule example_mesh(std::int64_t cells) {
  const sim::Model<2> model = sim::make_model<2>(example_case());
  const auto count = [&](double scale, double within) {
    return sim::make_forest<2>(model, scaled_mesh(scale, within), 1)->n_cells();
  };
  const double shortest = 0.05, longest = 6;
  double scale = 4;
  while (scale > 1.0 / 16 && count(scale, longest) < cells) scale *= 0.5;
  double low = shortest, high = longest;
  while (high - low > 0.02) {
    const double middle = 0.5 * (low + high);
    (count(scale, middle) < cells ? low : high) = middle;
  }
  const auto miss = [&](double within) { return std::abs(count(scale, within) - cells); };
  return scaled_mesh(scale, miss(low) < miss(high) ? low : high);
}

}  // namespace seaway::validation
