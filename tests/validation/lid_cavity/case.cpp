// [lid_cavity] Flow in a square driven by its lid, Re 100, against Ghia et al.; see README.md beside this file.
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/one_fluid.hpp"

namespace seaway::validation {
namespace {

constexpr double reynolds = 100;

/// Largest deviation of the computed velocity from a table of (place along the centre line, velocity).
double profile_error(const Section& run, const std::string& file, int axis, Results& results) {
  std::ifstream in(std::string(SEAWAY_VALIDATION) + "/lid_cavity/" + file);
  SEAWAY_CHECK(in.good(), "cannot read {}", file);
  std::string line;
  std::getline(in, line);
  double largest = 0;
  Curve table{"Ghia et al.", {}, {}, true};
  while (std::getline(in, line)) {
    double place = 0, value = 0;
    char comma = 0;
    std::istringstream(line) >> place >> comma >> value;
    if (place <= 0 || place >= 1) continue;  // the walls themselves
    const Vec2 x = axis == 0 ? Vec2(0.5, place - 1) : Vec2(place, -0.5);
    largest = std::max(largest, std::abs(velocity_at(run, axis, x) - value));
    table.x.push_back(place);
    table.y.push_back(value);
  }
  Curve computed{"computed", {}, {}, false};
  for (double place = 0.01; place < 0.995; place += 0.01) {
    computed.x.push_back(place);
    computed.y.push_back(velocity_at(run, axis, axis == 0 ? Vec2(0.5, place - 1) : Vec2(place, -0.5)));
  }
  results.plot({axis == 0 ? "u on the vertical centre line" : "v on the horizontal centre line", "place", "velocity / lid",
                {computed, table}});
  return largest;
}

}  // namespace

void run_lid_cavity(const Context& context, Results& results) {
  const int cells = context.quick() ? 32 : 64;
  sim::Case c = one_fluid_tank(0, -1, cells, cells, 1.0 / cells, 1 / reynolds);
  c.tank.no_slip = {{1, false, {0, 0, 0}}, {1, true, {0, 0, 0}}, {2, false, {0, 0, 0}}, {2, true, {0, 1, 0}}};
  c.time.dt = 0.5 / cells;
  const auto run = start(c, context.threads);
  const double duration = context.quick() ? 15 : 40;
  double before = 0;
  while (run->time() < duration) {
    before = velocity_at(*run, 0, Vec2(0.5, -0.5));
    step(*run);
  }
  const double change = std::abs(velocity_at(*run, 0, Vec2(0.5, -0.5)) - before) / run->dt();
  // Bar of the project: 1 % of the lid's speed at 64 cells; half the cells, twice that.
  const double u = profile_error(*run, "u_re100.csv", 0, results), v = profile_error(*run, "v_re100.csv", 1, results);
  results.expect_below("profile_error", std::max(u, v), "1", context.quick() ? 0.02 : 0.01);
  results.report("u_error", u, "1");
  results.report("v_error", v, "1");
  results.report("change_per_s", change, "1/s");
}

}  // namespace seaway::validation
