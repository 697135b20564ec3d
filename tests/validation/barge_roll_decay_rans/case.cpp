// [barge_roll_decay_rans] The barge of Jung et al. with k-epsilon and walls; see README.md beside this file.
#include <algorithm>
#include <cmath>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

using Model = sim::Turbulence::Model;
using Walls = sim::Turbulence::Walls;

constexpr double experimental_period = 0.93;  // Jung, Chang & Jung (2006), as in README.md
constexpr std::array<double, 5> body_fitted{-12.7, 9.7, -7.5, 6.0, -5.0};  // [deg], README.md

struct Decay {
  Record roll;
  sim::PhaseTimes phases;
  double cpu = 0;
  flow::YPlusRange y_plus;

  /// Mean of the cycles 2 to 4 between zero crossings, the first quarter swing not counted.
  double period() const {
    const std::vector<double> crossings = zero_crossings(roll);
    return crossings.size() < 9 ? std::nan("") : (crossings[8] - crossings[2]) / 3;
  }
  double peak(std::size_t i) const {
    const std::vector<TurningPoint> points = turning_points(roll);
    return points.size() < i ? std::nan("") : points[i - 1].value;
  }
  /// Of critical, from the first and the fifth turning point.
  double damping_ratio() const {
    const double decrement = std::log(std::abs(peak(1) / peak(5))) / 4;  // by half cycle
    return decrement / std::sqrt(pi * pi + decrement * decrement);
  }
};

Decay let_go(double h, double dt, Model model, Walls walls, int threads) {
  sim::Case c = barge_case(h, 15 * degree);
  c.body.free = {sim::Dof::roll};
  c.time.dt = dt;
  c.turbulence.model = model;
  c.turbulence.walls = walls;
  c.turbulence.velocity = 0.28;  // of the corners at the first upright position
  const auto run = start(c, threads);
  Decay out;
  const double cpu = process_cpu_seconds();
  out.roll.add(0, 15);
  while (run->time() < 4.2) {
    step(*run);
    out.roll.add(run->time(), displacement(*run)[2] / degree);
  }
  out.cpu = process_cpu_seconds() - cpu;
  out.phases = run->clock().times();
  const auto ranges = run->y_plus();
  if (const auto found = ranges.find(0); found != ranges.end()) out.y_plus = found->second;
  return out;
}

void report(const std::string& name, const Decay& decay, Results& results) {
  results.report("period_" + name, decay.period(), "s");
  results.report("peak_5_" + name, decay.peak(5), "deg");
  results.report("damping_ratio_" + name, decay.damping_ratio(), "1");
}

}  // namespace

void run_barge_roll_decay_rans(const Context& context, Results& results) {
  const double h = context.quick() ? 0.010 : 0.005, dt = 0.008;
  const Decay decay = let_go(h, dt, Model::stabilised, Walls::wall_function, context.threads);
  // Bar of the project for cells of 5 mm and lower; 10 mm are 0.5 % shorter by their resolution.
  results.expect_near("period", decay.period(), "s", experimental_period,
                      (context.quick() ? 0.02 : 0.015) * experimental_period);
  for (std::size_t i = 1; i <= 5; ++i) {
    results.report("peak_" + std::to_string(i), decay.peak(i), "deg");
    results.report("peak_" + std::to_string(i) + "_body_fitted", body_fitted[i - 1], "deg");
  }
  results.report("damping_ratio", decay.damping_ratio(), "1");
  results.report("y_plus_min", decay.y_plus.smallest, "1");
  results.report("y_plus_mean", decay.y_plus.mean(), "1");
  results.report("y_plus_max", decay.y_plus.largest, "1");
  results.report("turbulence_share", decay.phases.at("turbulence") / decay.cpu, "1");
  if (context.quick()) return;
  report("slip", let_go(h, dt, Model::laminar, Walls::slip, context.threads), results);
  report("no_slip", let_go(h, dt, Model::laminar, Walls::no_slip, context.threads), results);
  report("standard", let_go(h, dt, Model::standard, Walls::wall_function, context.threads), results);
  report("non_equilibrium", let_go(h, dt, Model::stabilised, Walls::non_equilibrium, context.threads), results);
  const Decay coarse = let_go(0.010, dt, Model::stabilised, Walls::wall_function, context.threads);
  report("10mm", coarse, results);
  const Decay fine = let_go(0.0025, dt / 2, Model::stabilised, Walls::wall_function, context.threads);
  results.expect_near("period_2.5mm", fine.period(), "s", experimental_period, 0.015 * experimental_period);
  for (std::size_t i = 1; i <= 5; ++i) results.report("peak_" + std::to_string(i) + "_2.5mm", fine.peak(i), "deg");
  results.report("damping_ratio_2.5mm", fine.damping_ratio(), "1");
}

}  // namespace seaway::validation
