#include "tests/validation/support/linear_heave.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::validation {
namespace {

using Complex = std::complex<double>;
constexpr double largest_wave_number = 20;

/// E1(z) by its power series [abramowitz1964, 5.1.11]; for |z| <= 21 and Re z <= 0, where its terms hardly cancel.
Complex exponential_integral(Complex z) {
  constexpr double euler = 0.57721566490153286;
  Complex sum = -euler - std::log(z), power = 1;
  for (int k = 1; k < 120 && std::norm(power) > 1e-34; ++k) {
    power *= -z / static_cast<double>(k);
    sum -= power / static_cast<double>(k);
  }
  return sum;
}

/// A potential at a point of the unit circle or sphere, and its radial derivative there.
struct Pole {
  Complex value, slope;
};

/// Integral of exp(-k w) / (k - K) over k > 0, real part, with the waves going outwards for exp(-i omega t);
/// w = depth + i distance, K the wave number.
Pole outgoing_source(Complex w, double wave_number) {
  const Complex wave = std::exp(-wave_number * w);
  const Complex value = wave * (exponential_integral(-wave_number * w) - Complex(0, pi));
  const Complex slope = -wave_number * value - 1.0 / w;
  return {{value.real(), pi * wave.real()}, {(w * slope).real(), -pi * wave_number * (w * wave).real()}};
}

/// Plane sources k cos alpha apart have the mean J0(k R): a point source in the surface, 1/r and its waves.
Pole point_source(double theta, double wave_number) {
  constexpr int n_angles = 200;
  Pole sum{};
  for (int i = 0; i < n_angles; ++i) {
    const double alpha = (i + 0.5) * pi / (2 * n_angles);
    const Pole plane = outgoing_source({std::cos(theta), std::sin(theta) * std::cos(alpha)}, wave_number);
    sum.value += plane.value;
    sum.slope += plane.slope;
  }
  const double share = wave_number / n_angles;
  return {1.0 + share * sum.value, -1.0 + share * sum.slope};
}

/// Poles that make no waves, m >= 1.
Pole wave_free_pole(int dim, int m, double theta, double wave_number) {
  if (dim == 2) {
    const double even = std::cos(2 * m * theta), odd = std::cos((2 * m - 1) * theta);
    return {even + wave_number / (2 * m - 1) * odd, -2 * m * even - wave_number * odd};
  }
  const double x = std::cos(theta);
  const double even = std::legendre(2u * static_cast<unsigned>(m), x);
  const double odd = std::legendre(2u * static_cast<unsigned>(m) - 1, x);
  return {even + wave_number / (2 * m) * odd, -(2 * m + 1) * even - wave_number * odd};
}

/// Heave velocity over -c y0 in the frequency domain, real part: 1 / (c - omega^2 (m + A) + i omega B), displaced mass,
/// radius and gravity 1. The restoring force of the waterplane over the displaced weight: 4/pi and 3/2.
double response(int dim, double wave_number) {
  const double stiffness = dim == 2 ? 4 / pi : 1.5;
  if (wave_number <= 0) return 1 / stiffness;
  HeaveRadiation r = heave_radiation(dim, std::min(wave_number, largest_wave_number));
  if (wave_number > largest_wave_number) {  // towards the limit of fast motions as 1 / K
    const double limit = dim == 2 ? 1.0 : 0.5;
    r = {limit - (limit - r.added_mass) * largest_wave_number / wave_number, 0, 0};
  }
  return (1.0 / Complex(stiffness - wave_number * (1 + r.added_mass), wave_number * r.damping)).real();
}

}  // namespace

HeaveRadiation heave_radiation(int dim, double wave_number) {
  SEAWAY_CHECK(wave_number > 0 && wave_number <= largest_wave_number, "wave number {} is not in (0, {}]", wave_number,
               largest_wave_number);
  constexpr int n_poles = 16, n_points = 48;
  Eigen::MatrixXcd value(n_points, n_poles), slope(n_points, n_poles);
  Eigen::VectorXcd normal(n_points);
  for (int i = 0; i < n_points; ++i) {
    const double theta = (i + 0.5) * pi / (2 * n_points);
    for (int m = 0; m < n_poles; ++m) {
      Pole p = wave_free_pole(dim, std::max(m, 1), theta, wave_number);
      if (m == 0) p = dim == 2 ? outgoing_source(std::polar(1.0, theta), wave_number) : point_source(theta, wave_number);
      value(i, m) = p.value;
      slope(i, m) = p.slope;
    }
    normal[i] = std::cos(theta);
  }
  const Eigen::VectorXcd strength = slope.colPivHouseholderQr().solve(normal);
  const Eigen::VectorXcd potential = value * strength;
  Complex impulse = 0;  // of the pressure over the wetted surface, for the velocity 1
  for (int i = 0; i < n_points; ++i) {
    const double theta = (i + 0.5) * pi / (2 * n_points), width = pi / (2 * n_points);
    impulse -= potential[i] * std::cos(theta) * width * (dim == 2 ? 2 : 2 * pi * std::sin(theta));
  }
  const double displaced = dim == 2 ? pi / 2 : 2 * pi / 3;
  // Waves of the source: pi exp(-K depth) in each of two directions, or pi K sqrt(2 / (pi K R)) all around.
  const double flux = std::norm(strength[0]) * pi * pi * (dim == 2 ? 1 : 2 * wave_number);
  return {impulse.real() / displaced, impulse.imag() / displaced, flux / displaced};
}

Record linear_heave_decay(int dim, double duration, double step) {
  // y = 1 - (2 c / pi) integral of Re{1 / D} sin(omega t) / omega, by Simpson's rule; what is left out beyond the end
  // is omega^-3.
  constexpr int n = 4000;
  const double width = 40.0 / n;
  std::vector<double> real_part(n + 1);
  for (int i = 0; i <= n; ++i) real_part[static_cast<std::size_t>(i)] = response(dim, std::pow(i * width, 2));
  const double stiffness = dim == 2 ? 4 / pi : 1.5;
  Record heave;
  for (double t = 0; t < duration + 0.5 * step; t += step) {
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
      const double omega = i * width;
      const double weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
      sum += weight * real_part[static_cast<std::size_t>(i)] * (i == 0 ? t : std::sin(omega * t) / omega);
    }
    heave.add(t, 1 - 2 * stiffness / pi * sum * width / 3);
  }
  return heave;
}

}  // namespace seaway::validation
