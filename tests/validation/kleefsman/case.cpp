// [kleefsman] Dam break on a box: SPHERIC test 2; see README.md beside this file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/field/restrict.hpp"
#include "core/sim/simulation.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

using Tank3 = sim::Simulation<3>;

// [kleefsman2005]; half of the tank, cut by its middle plane y = 0.5 m.
constexpr double column_from = 1.992, column_height = 0.55;
constexpr double front = 0.8245, box_length = 0.161, box_half_width = 0.2015, box_height = 0.161;
constexpr double measured_peak = 8127;    // [Pa], first peak of P2
constexpr double measured_arrival = 0.41;  // [s], a quarter of the peak
constexpr double below = 0.1;             // the obstacle goes on through the floor [m]

struct Mesh {
  int per_metre = 0;  ///< cells
  double dt = 0;      ///< [s]
};

sim::Case tank_with_box(const Mesh& mesh) {
  sim::Case c;
  c.dim = 3;
  c.title = "dam break on a box";
  c.base_cell = 1.0 / mesh.per_metre;
  c.tank.lower = {0, 0, 0};
  c.tank.upper = {3.22, 0.5, 1.0};
  c.hull.shape = sim::Hull::Shape::box;
  c.hull.length = box_length;
  c.hull.beam = 2 * box_half_width;
  c.hull.height = below + box_height;
  c.body.mass = 1000;  // means nothing: it is fixed
  c.body.gyradii = {0.1, 0.1, 0.1};
  c.body.draft = 0.01;
  // Its middle plane in that of the tank, its top at 0.161 m.
  c.body.offset = {front - 0.5 * box_length, 0.5, c.body.draft - below};
  c.time.dt = mesh.dt;
  const double p_y = 0.471;
  c.outputs.probes = {{"p1", false, {front, p_y, 0.021}}, {"p2", false, {front, p_y, 0.061}},
                      {"p3", false, {front, p_y, 0.101}}, {"p4", false, {front, p_y, 0.141}}};
  sim::Stage stage;
  stage.end.duration = 1;
  c.stages = {stage};
  return c;
}

void fill_column(Tank3& run) {
  run.forest().for_each_leaf([&](int b) {
    const auto& block = run.forest().block(b);
    field::for_box<3>(field::filled<3>(0), field::cells_upper<3>(), [&](const IVec<3>& i) {
      const Vec3 lower = block.cell_centre(i) - 0.5 * block.h;
      const double along = std::clamp((lower.x() + block.h.x() - column_from) / block.h.x(), 0.0, 1.0);
      const double up = std::clamp((column_height - lower.z()) / block.h.z(), 0.0, 1.0);
      run.state().vof.block(b)[field::offset<3>(i, field::cell_strides<3>())] = along * up;
    });
  });
  field::restrict_cells<double, 3>(run.forest(), run.state().vof);
}

struct Flood {
  std::vector<Record> pressures;
  std::int64_t cells = 0;
  double water_error = 0;
};

Flood break_dam(const Mesh& mesh, double duration, int threads) {
  const sim::Case c = tank_with_box(mesh);
  const auto started = start<3>(std::make_shared<const sim::Model<3>>(sim::make_model<3>(c)), threads);
  Tank3& run = *started;
  fill_column(run);
  const double water = run.water().visible;
  Flood out;
  out.cells = run.forest().n_cells();
  out.pressures.resize(c.outputs.probes.size());
  while (run.time() < duration) {
    step(run);
    for (std::size_t i = 0; i < out.pressures.size(); ++i) out.pressures[i].add(run.time(), run.pressure(c.outputs.probes[i]));
    const sim::WaterBalance balance = run.water();
    out.water_error = std::max(out.water_error, std::abs((balance.visible + balance.reservoir) / water - 1));
  }
  return out;
}

double largest(const Record& r) { return *std::max_element(r.value.begin(), r.value.end()); }

/// When a quarter of the measured peak is first exceeded.
double arrival(const Record& r) {
  for (std::size_t i = 1; i < r.t.size(); ++i)
    if (const double a = r.value[i - 1], b = r.value[i], level = 0.25 * measured_peak; b >= level)
      return r.t[i - 1] + (r.t[i] - r.t[i - 1]) * (level - a) / (b - a);
  return std::nan("");
}

}  // namespace

void run_kleefsman(const Context& context, Results& results) {
  const double u_peak = 0.05 * measured_peak, u_arrival = 0.005;  // see README.md
  std::vector<Mesh> meshes{{32, 0.003}, {48, 0.002}, {64, 0.0015}};
  if (context.quick()) meshes.resize(1);
  Refinement peaks{"p2_peak", "Pa", {}, {}, 1, measured_peak, u_peak};
  Refinement arrivals{"p2_arrival", "s", {}, {}, 1, measured_arrival, u_arrival};
  Plot plot{"pressure at P2", "t, s", "Pa", {}};
  for (const Mesh& mesh : meshes) {
    const Flood flood = break_dam(mesh, context.quick() ? 0.5 : 0.65, context.threads);
    const Record& p2 = flood.pressures[1];
    const double peak = largest(p2) / measured_peak - 1, came = arrival(p2) / measured_arrival - 1;
    const std::string suffix = fmt::format("_1/{}", mesh.per_metre);
    if (mesh.per_metre == meshes.back().per_metre) {
      results.expect_near("p2_peak_error", peak, "1", 0, 0.10);
      results.expect_near("p2_arrival_error", came, "1", 0, 0.05);
    } else {
      results.report("p2_peak_error" + suffix, peak, "1");
      results.report("p2_arrival_error" + suffix, came, "1");
    }
    // What the pressure solve leaves in a step, some hundred times.
    results.expect_below("water_error" + suffix, flood.water_error, "1", 1e-3);
    results.report("cells" + suffix, static_cast<double>(flood.cells), "1");
    peaks.h.push_back(1.0 / mesh.per_metre);
    peaks.value.push_back(largest(p2));
    arrivals.h.push_back(1.0 / mesh.per_metre);
    arrivals.value.push_back(arrival(p2));
    plot.curves.push_back({fmt::format("1/{} m", mesh.per_metre), p2.t, p2.value});
  }
  plot.curves.push_back({"measured arrival and peak", {measured_arrival, measured_arrival}, {0.25 * measured_peak, measured_peak}, true});
  results.plot(plot);
  results.refinement(peaks);
  results.refinement(arrivals);
}

}  // namespace seaway::validation
