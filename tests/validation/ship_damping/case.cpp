// [dtmb5415_damping] What turbulence and walls change in the ship's free roll; see README.md.
#include "tests/validation/cases.hpp"
#include "tests/validation/support/kept_runs.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

using Model = sim::Turbulence::Model;
using Walls = sim::Turbulence::Walls;

struct Variant {
  const char* name;
  Model model;
  Walls walls;
};

constexpr Variant variants[] = {{"slip", Model::laminar, Walls::slip},
                                {"no_slip", Model::laminar, Walls::no_slip},
                                {"standard", Model::standard, Walls::wall_function},
                                {"stabilised", Model::stabilised, Walls::wall_function},
                                {"non_equilibrium", Model::stabilised, Walls::non_equilibrium}};

constexpr double bilge_speed = 0.27;  // at the first upright position [m/s]: where k and epsilon start from

/// Roll of the example with the variant's flow, run or read.
void let_go(const std::string& condition, const Variant& variant, const Context& context, Results& results) {
  const std::string example = "dtmb5415_ship_" + condition + "_decay_demo.yaml";
  sim::Case c = example_case(example);
  c.turbulence.model = variant.model;
  c.turbulence.walls = variant.walls;
  c.turbulence.velocity = bilge_speed;
  const std::string of = "_" + condition + "_" + variant.name;
  const KeptRuns runs(context.results, "dtmb5415_damping");
  const RunRecord run = runs.finished("dtmb5415_damping" + of, example, c, context.threads, {});
  const analysis::Decay decay = run.roll_decay();
  const analysis::DecayCycle &first = cycle(decay, 1), &second = cycle(decay, 2);
  results.report("period" + of, 0.5 * (first.period + second.period), "s");
  results.report("damping_ratio_1" + of, first.damping_ratio, "1");
  results.report("damping_ratio_2" + of, second.damping_ratio, "1");
  results.report("peak_3" + of, second.angle, "deg");
  results.report("cpu_s_per_s" + of, run.total_cpu_s / run.end_time(), "1");
}

}  // namespace

void run_dtmb5415_damping(const Context& context, Results& results) {
  for (const char* condition : {"intact", "damaged"})
    for (const Variant& variant : variants) let_go(condition, variant, context, results);
}

}  // namespace seaway::validation
