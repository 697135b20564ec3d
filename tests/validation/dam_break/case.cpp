// [dam_break] Surge front of a collapsing column of water; see README.md beside this file.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "core/field/restrict.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double width = 0.05715;  // a, 2.25 in; the column is 2 a high
constexpr double gate = 1.44;      // front / a from which times count: gates open in finite time
constexpr double last = 4;

/// Column of water in the lower left corner of a tank filled with air.
void fill_column(Section& run) {
  using mesh::BlockShape;
  run.forest().for_each_leaf([&](int b) {
    const auto& block = run.forest().block(b);
    field::for_box<2>(field::filled<2>(0), field::cells_upper<2>(), [&](const IVec<2>& i) {
      const Vec2 lower = block.cell_centre(i) - 0.5 * block.h;
      double part = 1;
      for (int a = 0; a < 2; ++a)
        part *= std::clamp(((a + 1) * width - lower[a]) / block.h[a], 0.0, 1.0);
      run.state().vof.block(b)[field::offset<2>(i, field::cell_strides<2>())] = part;
    });
  });
  field::restrict_cells<double, 2>(run.forest(), run.state().vof);
}

/// Where the volume fraction of the cells on the floor falls through one half.
double front(const Section& run) {
  const auto& grid = run.forest().grid();
  const double h = run.forest().finest_cell();
  double before = 1;
  for (double y = grid.lower[0] + 0.5 * h; y < grid.upper[0]; y += h) {
    const int b = run.forest().find_leaf({y, grid.lower[1] + 0.5 * h});
    const auto& block = run.forest().block(b);
    const int i =
        std::min(static_cast<int>((y - block.origin[0]) / block.h[0]), mesh::BlockShape<2>::n - 1);
    const double vof = run.state().vof.block(b)[i];
    if (vof < 0.5) return y - h + h * (before - 0.5) / (before - vof);
    before = vof;
  }
  return grid.upper[0];
}

/// Two columns with a line of names above.
Record read_record(const std::string& path) {
  std::ifstream file(path);
  SEAWAY_CHECK(file, "cannot read {}", path);
  Record out;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    double t = 0, v = 0;
    if (numbers >> t >> v) out.add(t, v);
  }
  return out;
}

/// Time at which a rising record reaches a value.
double time_of(const Record& r, double value) {
  for (std::size_t i = 1; i < r.t.size(); ++i)
    if (r.value[i] >= value)
      return r.t[i - 1] +
             (r.t[i] - r.t[i - 1]) * (value - r.value[i - 1]) / (r.value[i] - r.value[i - 1]);
  return std::nan("");
}

double value_at(const Record& r, double t) {
  for (std::size_t i = 1; i < r.t.size(); ++i)
    if (r.t[i] >= t)
      return r.value[i - 1] +
             (r.value[i] - r.value[i - 1]) * (t - r.t[i - 1]) / (r.t[i] - r.t[i - 1]);
  return std::nan("");
}

/// Front over time, both in the experiment's units.
Record collapse(int cells_per_width, int threads) {
  sim::Case c;
  c.base_cell = width / 8;
  c.tank.lower = {0, 0, 0};
  c.tank.upper = {0, 8 * width, 4 * width};
  c.tank.open_top = false;
  c.time.dt = 0.0008 * 32 / cells_per_width;  // a Courant number of about 1 at the front
  sim::Stage stage;
  stage.mesh.boxes = {{width / cells_per_width, {0, 0, 0}, {0, 5 * width, 2.5 * width}}};
  c.stages = {stage};
  const auto run = start(c, threads);
  fill_column(*run);
  Record out;
  const double unit = std::sqrt(2 * c.fluids.gravity / width);
  out.add(0, front(*run) / width);
  while (out.value.back() < last + 0.3 && run->time() < 0.5) {
    step(*run);
    out.add(run->time() * unit, front(*run) / width);
  }
  return out;
}

/// Mean of |Z - Z_measured| / Z_measured over the measured curve from the gate to the last value,
/// times shifted so that both agree at the gate.
double front_error(const Record& computed, const Record& measured) {
  const double shift = time_of(computed, gate) - time_of(measured, gate);
  double sum = 0;
  int count = 0;
  for (double z = gate; z <= last; z += 0.01, ++count)
    sum += std::abs(value_at(computed, time_of(measured, z) + shift) / z - 1);
  return sum / count;
}

}  // namespace

void run_dam_break(const Context& context, Results& results) {
  const Record measured = read_record(std::string(SEAWAY_VALIDATION) + "/dam_break/front.csv");
  const int finest = context.quick() ? 32 : 64;
  std::vector<Curve> curves;
  for (int cells = finest / 2; cells <= finest; cells *= 2) {
    const Record computed = collapse(cells, context.threads);
    const double error = front_error(computed, measured);
    Curve shifted{fmt::format("a/{}", cells), computed.t, computed.value, false};
    const double shift = time_of(computed, gate) - time_of(measured, gate);
    for (double& t : shifted.x) t -= shift;
    curves.push_back(shifted);
    // Digitised from a printed figure, and codes without friction run a few per cent ahead.
    if (cells == finest)
      results.expect_below("front_error", error, "1", 0.05);
    else
      results.report("front_error_half_resolution", error, "1");
  }
  Curve points{"Martin & Moyce", {}, {}, true};
  for (std::size_t i = 0; i < measured.t.size() && measured.value[i] < 6; ++i) {
    points.x.push_back(measured.t[i]);
    points.y.push_back(measured.value[i]);
  }
  curves.push_back(points);
  results.plot({"surge front, times equal at Z = 1.44", "t sqrt(2 g / a)", "Z", curves});
}

}  // namespace seaway::validation
