#include "tests/validation/support/heave_decay.hpp"

#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/run_context.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

template <int Dim>
HeaveDecay run_in(const sim::Case& c, double duration, int threads) {
  const double cpu_before = process_cpu_seconds();
  const auto run = start<Dim>(std::make_shared<const sim::Model<Dim>>(sim::make_model<Dim>(c)), threads);
  const auto height = [&] {
    return motion::displacement<Dim>(run->body().pose, run->model().rest_cog)[motion::dof_index<Dim>(motion::Dof::heave)];
  };
  HeaveDecay decay;
  decay.cells = run->forest().n_cells();
  decay.heave.add(0, height());
  while (run->time() < duration) {
    step<Dim>(*run);
    decay.heave.add(run->time(), height());
  }
  decay.cpu_s = process_cpu_seconds() - cpu_before;
  return decay;
}

}  // namespace

double HeaveDecay::period() const {
  const std::vector<double> crossings = zero_crossings(heave);
  return crossings.size() < 2 ? missing : 2 * (crossings[1] - crossings[0]);
}

double HeaveDecay::peak(std::size_t i) const {
  const std::vector<TurningPoint> points = turning_points(heave);
  return i == 0 || points.size() < i ? missing : points[i - 1].value;
}

HeaveDecay run_heave_decay(const sim::Case& c, double duration, int threads) {
  return c.dim == 2 ? run_in<2>(c, duration, threads) : run_in<3>(c, duration, threads);
}

namespace {

double rms_difference(const Record& a, const Record& b) {
  SEAWAY_CHECK(a.t.size() == b.t.size() && !a.t.empty(), "records of {} and {} samples", a.t.size(), b.t.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.t.size(); ++i) sum += std::pow(a.value[i] - b.value[i], 2);
  return std::sqrt(sum / static_cast<double>(a.t.size()));
}

}  // namespace

double order_of_records(const Record& coarse, const Record& medium, const Record& fine) {
  return std::log2(rms_difference(coarse, medium) / rms_difference(medium, fine));
}

void report_refinement(const std::array<HeaveDecay, 3>& runs, double h, double release_height, double largest_change,
                       Results& results) {
  const auto refine = [&](const std::string& quantity, const std::string& unit, const std::array<double, 3>& value) {
    for (std::size_t i = 0; i < 3; ++i) results.report(quantity + "_mesh_" + std::to_string(i + 1), value[i], unit);
    results.expect_below(quantity + "_change", std::abs(value[2] / value[1] - 1), "1", largest_change);
    results.report(quantity + "_order", observed_order(value[0], value[1], value[2]), "1");
    results.refinement({quantity, unit, {h, h / 2, h / 4}, {value[0], value[1], value[2]}, 1, {}, 0, 0});
  };
  results.expect_above("order", order_of_records(runs[0].heave, runs[1].heave, runs[2].heave), "1", 1);
  refine("period", "s", {runs[0].period(), runs[1].period(), runs[2].period()});
  for (std::size_t i = 1; i <= 3; ++i)
    refine("peak_" + std::to_string(i), "1",
           {runs[0].peak(i) / release_height, runs[1].peak(i) / release_height, runs[2].peak(i) / release_height});
  results.report("cells", static_cast<double>(runs[2].cells), "1");
}

}  // namespace seaway::validation
