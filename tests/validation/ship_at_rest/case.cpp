// [ship_at_rest] The DTMB 5415, intact and damaged, let go in calm water: draft and heel; see README.md beside this file.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/base/constants.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double duration = 3.2, averaged = 1.4;  // [s]: the end, one period of roll
constexpr double too_high = 0.003;                // [m]

struct Rest {
  double draft = 0;          ///< amidships, mean over the end [m]
  double heel = 0;           ///< mean over the end [rad]
  double hydrostatics = 0;   ///< draft of the same polyhedron by core/hull [m]
  double swing = 0;          ///< of the draft, largest less smallest at the end [m]
  double roll = 0;           ///< the same of the roll [rad]
  double cells = 0;
};

/// Mean over the end, and largest less smallest there.
struct End {
  double mean = 0, swing = 0;
};

End end_of(const Record& r) {
  const auto first = r.value.begin() + (std::upper_bound(r.t.begin(), r.t.end(), duration - averaged) - r.t.begin());
  const auto [smallest, largest] = std::minmax_element(first, r.value.end());
  return {std::accumulate(first, r.value.end(), 0.0) / static_cast<double>(r.value.end() - first), *largest - *smallest};
}

/// `lift`: how much too high it starts [m].
Rest settle(const std::string& example, double lift, int threads) {
  sim::Case c = example_case(example);
  c.body.angles = {0, 0, 0};
  c.body.offset = {0, 0, lift};
  // It hardly moves: the region of the hull's cells need not cover a roll of 22 degrees.
  c.stages.front().mesh.hull_sweep = 2 * degree;
  c.stages.front().mesh.hull_heave = 0.01;
  const auto model = std::make_shared<const sim::Model<3>>(sim::make_model<3>(c));
  const auto run = start<3>(model, threads);
  Rest rest;
  rest.cells = static_cast<double>(run->forest().n_cells());
  rest.hydrostatics = c.body.cog.z() - model->rest_cog.z();
  Record draft, heel;
  while (run->time() < duration) {
    step<3>(*run);
    const auto moved = motion::displacement<3>(run->body().pose, model->rest_cog);
    draft.add(run->time(), rest.hydrostatics - moved[2]);
    heel.add(run->time(), moved[3]);
  }
  const End sunk = end_of(draft), heeled = end_of(heel);
  rest.draft = sunk.mean;
  rest.swing = sunk.swing;
  rest.heel = heeled.mean;
  rest.roll = heeled.swing;
  return rest;
}

/// One condition: let go where it floats, and a little higher.
double report_condition(const std::string& name, const std::string& example, double measured, double bar, int threads,
                        Results& results) {
  const Rest afloat = settle(example, 0, threads), high = settle(example, too_high, threads);
  results.expect_below("draft_error_" + name, std::abs(afloat.draft / measured - 1), "1", bar);
  results.expect_below("draft_error_" + name + "_from_above", std::abs(high.draft / measured - 1), "1", bar);
  results.report("draft_" + name, afloat.draft, "m");
  results.report("draft_" + name + "_from_above", high.draft, "m");
  results.report("draft_" + name + "_hydrostatics", afloat.hydrostatics, "m");
  results.report("swing_" + name, afloat.swing, "m");
  results.report("swing_" + name + "_from_above", high.swing, "m");
  results.report("heel_" + name, afloat.heel / degree, "deg");
  results.report("heel_" + name + "_from_above", high.heel / degree, "deg");
  results.report("swing_of_roll_" + name, afloat.roll / degree, "deg");
  results.report("swing_of_roll_" + name + "_from_above", high.roll / degree, "deg");
  results.report("cells_" + name, afloat.cells, "1");
  return std::max(std::abs(afloat.heel), std::abs(high.heel));
}

}  // namespace

void run_ship_at_rest(const Context& context, Results& results) {
  const double intact = report_condition("intact", "dtmb5415_ship_intact_decay_demo.yaml", 0.1206, 0.003, context.threads, results);
  const double damaged =
      report_condition("damaged", "dtmb5415_ship_damaged_decay_demo.yaml", 7.41 / 51, 0.01, context.threads, results);
  results.expect_below("heel_deg", std::max(intact, damaged) / degree, "deg", 0.2);
}

}  // namespace seaway::validation
