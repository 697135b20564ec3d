// [viscous_wave] A small standing wave between viscous fluids against its exact solution; see README.md.
#include <algorithm>
#include <cmath>
#include <complex>

#include "core/field/restrict.hpp"
#include "tests/validation/cases.hpp"
#include "tests/validation/support/one_fluid.hpp"
#include "tests/validation/support/signal.hpp"

namespace seaway::validation {
namespace {

using Complex = std::complex<double>;

constexpr double length = 1, amplitude = 0.01, gravity = 9.81, rho_water = 1000, rho_air = 1.2;
constexpr double k = 2 * pi / length;

/// Complementary error function by Simpson's rule along the straight line from 0: good to 1e-10 for |z| < 6.
Complex erfc(Complex z) {
  constexpr int n = 2000;
  Complex sum = 0;
  for (int i = 0; i <= n; ++i) {
    const Complex s = z * (static_cast<double>(i) / n);
    sum += std::exp(-s * s) * (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  return 1.0 - 2 / std::sqrt(pi) * z * sum / (3.0 * n);
}

/// Amplitude over the first one of a wave that starts at rest between two deep fluids of equal kinematic
/// viscosity: normal modes of the linear problem [prosperetti1981].
class ExactWave {
 public:
  explicit ExactWave(double nu) : nu_(nu) {
    beta_ = rho_water * rho_air / std::pow(rho_water + rho_air, 2);
    omega2_ = gravity * k * (rho_water - rho_air) / (rho_water + rho_air);
    const double d = nu * k * k, root = std::sqrt(d);
    const std::array<double, 4> c{(1 - 4 * beta_) * d * d + omega2_, 4 * (1 - 3 * beta_) * d * root,
                                  2 * (1 - 6 * beta_) * d, -4 * beta_ * root};
    for (std::size_t i = 0; i < 4; ++i) z_[i] = std::pow(Complex(0.4, 0.9), static_cast<double>(i)) * std::pow(omega2_, 0.25);
    for (int iteration = 0; iteration < 500; ++iteration)  // all roots at once (Durand and Kerner)
      for (std::size_t i = 0; i < 4; ++i) {
        Complex value = (((z_[i] + c[3]) * z_[i] + c[2]) * z_[i] + c[1]) * z_[i] + c[0];
        for (std::size_t j = 0; j < 4; ++j)
          if (j != i) value /= z_[i] - z_[j];
        z_[i] -= value;
      }
  }
  double operator()(double t) const {
    const double d = nu_ * k * k, part = (1 - 4 * beta_) * d * d;
    Complex sum = 4 * part / (8 * part + omega2_) * erfc(std::sqrt(d * t));
    for (std::size_t i = 0; i < 4; ++i) {
      Complex others = 1;
      for (std::size_t j = 0; j < 4; ++j)
        if (j != i) others *= z_[j] - z_[i];
      sum += z_[i] / others * omega2_ / (z_[i] * z_[i] - d) * std::exp((z_[i] * z_[i] - d) * t) *
             erfc(z_[i] * std::sqrt(t));
    }
    return sum.real();
  }
  double period() const { return 2 * pi / std::sqrt(omega2_); }

 private:
  double nu_, beta_ = 0, omega2_ = 0;
  std::array<Complex, 4> z_{};
};

/// Rms deviation of the amplitude over three periods, with `cells` a wavelength.
double error_on(int cells, const ExactWave& exact, double nu, int threads, Results& results) {
  const double h = length / cells;
  sim::Case c = one_fluid_tank(0, -length, cells / 2, 2 * cells, h, nu);  // half a wave between slip walls
  c.fluids.rho_water = rho_water;
  c.fluids.rho_air = rho_air;
  c.time.dt = exact.period() / (4 * cells);
  const auto run = start(c, threads);
  each_cell(*run, [&](int b, int i, const Vec2& x) {
    const double surface = amplitude * std::sin(0.5 * k * h) / (0.5 * k * h) * std::cos(k * x[0]);  // mean of a cell
    run->state().vof.block(b)[i] = std::clamp((surface - x[1]) / h + 0.5, 0.0, 1.0);
  });
  field::restrict_cells<double, 2>(run->forest(), run->state().vof);
  double sum = 0;
  int count = 0;
  Curve computed{fmt::format("{} cells", cells), {}, {}, false}, wanted{"exact", {}, {}, true};
  while (run->time() < 3 * exact.period()) {
    step(*run);
    double harmonic = 0;
    for (int i = 0; i < cells / 2; ++i) {
      const double y = (i + 0.5) * h;
      harmonic += 4 * h / length * run->elevation(0, y) * std::cos(k * y);
    }
    // Velocities live half a step later and were at rest: so was the wave half a step after the start.
    const double there = exact(run->time() - 0.5 * run->dt());
    sum += std::pow(harmonic / amplitude - there, 2);
    computed.x.push_back(run->time() / exact.period());
    computed.y.push_back(harmonic / amplitude);
    if (count++ % (cells / 4) == 0) {
      wanted.x.push_back(computed.x.back());
      wanted.y.push_back(there);
    }
  }
  results.plot({fmt::format("standing wave, {} cells", cells), "t / T", "amplitude / a", {computed, wanted}});
  return std::sqrt(sum / count);
}

}  // namespace

void run_viscous_wave(const Context& context, Results& results) {
  const double nu = 0.01 * std::sqrt(gravity * k) / (k * k);  // a wave loses 12 % of its height in a period
  const ExactWave exact(nu);
  results.expect_near("exact_start", exact(1e-9), "1", 1, 1e-6);  // the formula itself
  const double coarse = error_on(32, exact, nu, context.threads, results), medium = error_on(64, exact, nu, context.threads, results);
  results.report("error_32", coarse, "1");
  if (context.quick()) {
    results.expect_below("error", medium, "1", 0.02);
    return;
  }
  results.report("error_64", medium, "1");
  const double fine = error_on(128, exact, nu, context.threads, results);
  results.expect_below("error", fine, "1", 0.01);
  results.expect_above("order", std::log2(coarse / fine) / 2, "1", 1.5);
  results.refinement({"amplitude_error", "1", {length / 32, length / 64, length / 128}, {coarse, medium, fine}, 2, 0.0});
}

}  // namespace seaway::validation
