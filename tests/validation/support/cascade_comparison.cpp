#include "tests/validation/support/cascade_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::validation {
namespace {

/// A run at a time; for its answer, when its motions have converged: what a user waits for.
struct Answer {
  double time = 0, cpu_s = 0;  ///< [s]
  double roll = 0, heave = 0;  ///< amplitudes [rad], [m]
};

Answer answer_of(const RunRecord& run, double time, double period) {
  return {time, run.cpu_until(time), run.amplitude(run.roll, time, period), run.amplitude(run.heave, time, period)};
}

}  // namespace

sim::Case single_mesh(const sim::Case& cascade) {
  sim::Case c = cascade;
  sim::Stage answer = cascade.stages.back();
  answer.name = "answer";
  // It starts from a hull at rest: allow what the cascade allows in all its stages together.
  if (answer.end.kind == sim::EndRule::Kind::converged) {
    answer.end.max_periods = 0;
    for (const sim::Stage& s : cascade.stages) answer.end.max_periods += s.end.max_periods;
  }
  sim::Stage rest = answer;
  rest.name = "rest";
  rest.end = {};
  rest.end.duration = 1000;  // stopped when the cascade's end is reached
  c.stages = {answer, rest};
  return c;
}

void compare_cascade(const sim::Case& c, const RunRecord& cascade, const RunRecord& single, const CascadeBars& bars, Results& results) {
  const double period = c.wave.period, end = cascade.end_time(), cpu = cascade.total_cpu_s;
  const Answer last = answer_of(cascade, end, period), reference = answer_of(single, end, period);
  const Answer fast = answer_of(
      cascade, std::min(end, cascade.converged_at(cascade.stages.back().start, c.stages.back().end, period)), period);
  const Answer slow = answer_of(single, std::min(end, single.stages.front().end), period);
  const double saved_to_answer = 1 - fast.cpu_s / slow.cpu_s;
  results.expect_below("roll_difference", std::abs(last.roll / reference.roll - 1), "1", bars.difference);
  results.expect_below("heave_difference", std::abs(last.heave / reference.heave - 1), "1", bars.difference);
  results.expect_above("cpu_saved", 1 - cpu / single.cpu_until(end), "1", bars.cpu_saved);
  if (bars.cpu_saved_to_answer) results.expect_above("cpu_saved_to_answer", saved_to_answer, "1", *bars.cpu_saved_to_answer);
  else results.report("cpu_saved_to_answer", saved_to_answer, "1");
  results.expect_below("mapping_share", cascade.mapping_cpu_s() / cpu, "1", bars.mapping_share);
  results.report("roll_difference_of_answers", std::abs(fast.roll / slow.roll - 1), "1");
  results.report("heave_difference_of_answers", std::abs(fast.heave / slow.heave - 1), "1");
  results.report("roll_amplitude", last.roll / degree, "deg");
  results.report("heave_amplitude", last.heave, "m");
  results.report("end_time", end, "s");
  results.report("answer_time", fast.time, "s");
  results.report("answer_time_single", slow.time, "s");
  results.report("cpu_cascade", cpu, "s");
  results.report("cpu_cascade_to_answer", fast.cpu_s, "s");
  results.report("cpu_single", single.cpu_until(end), "s");
  results.report("cpu_single_to_answer", slow.cpu_s, "s");
}

}  // namespace seaway::validation
