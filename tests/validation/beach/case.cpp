// [beach] What a damping zone sends back; see README.md beside this file.
#include <Eigen/Dense>
#include <cmath>
#include <complex>

#include "core/waves/wave_field.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/signal.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

using Complex = std::complex<double>;

/// Amplitudes of the waves to port and back from harmonics at three or more gauges: least squares
/// for  a_j = incident exp(i k y_j) + reflected exp(-i k y_j), time factor exp(-i omega t).
std::pair<Complex, Complex> separate(const std::vector<double>& y, const std::vector<Complex>& a,
                                     double k) {
  const auto n = static_cast<Eigen::Index>(y.size());
  Eigen::MatrixXcd m(n, 2);
  Eigen::VectorXcd right(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto at = static_cast<std::size_t>(j);
    m(j, 0) = std::exp(Complex(0, k * y[at]));
    m(j, 1) = std::exp(Complex(0, -k * y[at]));
    right[j] = a[at];
  }
  const Eigen::Vector2cd x = (m.adjoint() * m).ldlt().solve(m.adjoint() * right);
  return {x[0], x[1]};
}

}  // namespace

void run_beach(const Context& context, Results& results) {
  const double period = 1.4;
  // Free water of 4 m between zones of one wavelength and a little more.
  sim::Case c;
  c.base_cell = 0.16;
  c.tank.lower = {0, -5.12, -2.79};
  c.tank.upper = {0, 5.12, 1.05};
  c.wave.kind = sim::Wave::Kind::regular;
  c.wave.height = 0.061;
  c.wave.period = period;
  c.zones.generation_length = 3.1;
  c.zones.absorption_length = 3.1;
  c.zones.absorption_target = sim::Zones::Target::rest;
  sim::Stage stage;
  stage.mesh.surface = {{context.quick() ? 0.02 : 0.01, 0.09}};
  c.stages = {stage};
  const auto run = start(c, context.threads);
  const double k = 2 * pi / run->model().wave->length();

  // Distances of 0.12 and 0.29 wavelengths: no two gauges half a wavelength apart.
  const std::vector<double> gauges{0.2, 0.57, 1.09};
  std::vector<Record> records(gauges.size());
  // Waves go at half their phase speed as a group: after six periods those that met the zone at its
  // start, and came back from its far end, have passed the gauges.
  const double settled = 7 * period, end = 12 * period;
  while (run->time() < end - 1e-9) {
    step(*run);
    for (std::size_t j = 0; j < gauges.size(); ++j)
      records[j].add(run->time(), run->elevation(0, gauges[j]));
  }
  std::vector<Complex> amplitude;
  for (const Record& r : records) amplitude.push_back(harmonic(r, 2 * pi / period, settled));
  const auto [incident, reflected] = separate(gauges, amplitude, k);
  // Three per cent of the amplitude: 1 mm of the waves of this project.
  results.expect_below("reflection", std::abs(reflected) / std::abs(incident), "1", 0.03);
  results.report("incident_over_wanted", std::abs(incident) / (0.5 * c.wave.height), "1");
  results.report("cells", static_cast<double>(run->forest().n_cells()), "1");
}

}  // namespace seaway::validation
