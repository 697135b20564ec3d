// [barge_heave_decay] Light and heavy bodies in heave, without sub-iterations; see README.md.
#include <algorithm>
#include <cmath>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double h = 0.01;

sim::Case body_of(double density_ratio) {
  sim::Case c = barge_case(h, 0);
  c.body.mass = density_ratio * 1000 * 0.3 * 0.1;
  c.body.free = {sim::Dof::heave};
  return c;
}

struct Outcome {
  bool stable = false;
  Record heave;
};

/// Let go 20 mm above where it floats, in a tank so long that no wave comes back from its ends. A
/// swing is the way from one turning point to the next. Stable if each is smaller than the one
/// before, down to a fiftieth of the first: 0.5 mm, a twentieth of a cell, where waves that run
/// out over coarser cells leave ripples.
Outcome bob(double density_ratio, double duration, int threads) {
  sim::Case c = body_of(density_ratio);
  c.body.draft = 0.1 * density_ratio;
  c.body.offset = {0, 0, 0.02};
  c.tank.lower.y() *= 2;
  c.tank.upper.y() *= 2;
  const auto run = start(c, threads);
  Outcome out;
  while (run->time() < duration) {
    step(*run);
    out.heave.add(run->time(), displacement(*run)[1]);
  }
  out.stable = true;
  double before = 0.02, last_swing = 1e9, first_swing = 0;
  for (const TurningPoint& p : turning_points(out.heave)) {
    const double swing = std::abs(p.value - before);
    if (first_swing == 0) first_swing = swing;
    out.stable = out.stable && swing < std::max(last_swing, first_swing / 50);
    before = p.value;
    last_swing = swing;
  }
  return out;
}

/// Twice as heavy as water, let go 0.15 m under it: stable if it sinks ever deeper, and by
/// Newton's law with an added mass between none and twice that of a flat plate.
Outcome sink(double duration, int threads) {
  sim::Case c = body_of(2.0);
  c.body.draft = 0.1;
  c.body.offset = {0, 0, -0.15};
  c.stages.front().mesh.hull_heave = 0.4;
  c.stages.front().mesh.hull_sweep = 0;
  c.time.dt = 0.005;
  const auto run = start(c, threads);
  Outcome out;
  out.stable = true;
  double before = displacement(*run)[1];
  const double start_heave = before;
  while (run->time() < duration) {
    step(*run);
    const double now = displacement(*run)[1];
    out.heave.add(run->time(), now);
    out.stable = out.stable && now < before;
    before = now;
  }
  const double weight_in_water = (2.0 - 1.0) * 1000 * 0.03 * 9.81;
  const double plate = pi / 4 * 1000 * 0.3 * 0.3;  // added mass of a plate of the barge's breadth
  const double acceleration = 2 * (start_heave - before) / (run->time() * run->time());
  out.stable = out.stable && acceleration < weight_in_water / 60 &&
               acceleration > weight_in_water / (60 + 2 * plate);
  return out;
}

}  // namespace

void run_barge_heave_decay(const Context& context, Results& results) {
  int stable = 0;
  const double duration = context.quick() ? 1 : 3;
  const auto judge = [&](const std::string& name, auto&& run) {
    Outcome out;
    try {
      out = run();
    } catch (const std::exception& e) {
      std::fprintf(stderr, "barge_heave_decay: density %s: %s\n", name.c_str(), e.what());
    }
    stable += out.stable;
    const auto points = turning_points(out.heave);
    results.report("stable." + name, out.stable, "1");
    if (!points.empty()) results.report("first_peak." + name, points.front().value, "m");
  };
  for (const auto& [name, ratio] :
       {std::pair{"0.1", 0.1}, {"0.3", 0.3}, {"0.5", 0.5}, {"0.9", 0.9}})
    judge(name, [&, r = ratio] { return bob(r, duration, context.threads); });
  judge("2.0", [&] { return sink(0.5, context.threads); });
  // Each density is a case of its own kind; all of them have to work.
  results.expect_above("stable_cases", stable, "1", 5);
}

}  // namespace seaway::validation
