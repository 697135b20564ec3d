#include "core/waves/stokes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.hpp"
#include "core/waves/airy.hpp"
#include "core/waves/regular_wave.hpp"

namespace seaway::waves {
namespace {

constexpr double largest_ursell = 40;  // [fenton1990]

/// The series summed for one wave, lengths over 1/k and speeds over sqrt(g/k). Letters as in table 1 of [fenton1985].
struct Series {
  std::array<double, 5> elevation{};  ///< k E_j
  std::array<double, 5> velocity{};   ///< b_j sqrt(k/g), at z = 0
  double mean_speed = 0;              ///< ubar
  double flux = 0;                    ///< Q - ubar k d
  double head = 0;                    ///< R k/g - k d
};

/// Polynomial in s, lowest power first.
template <std::size_t N>
double polynomial(const double (&c)[N], double s) {
  double sum = 0;
  for (std::size_t i = N; i-- > 0;) sum = sum * s + c[i];
  return sum;
}

Series sum_series(double e, double true_kd) {
  const double kd = std::min(true_kd, 10.0);  // all terms are at their limits there, and nothing overflows
  const double s = 1 / std::cosh(2 * kd), sh = std::sinh(kd), th = std::tanh(kd), r = 1 - s;
  const double r2 = r * r, r3 = r2 * r, r4 = r2 * r2, r5 = r4 * r, r6 = r3 * r3, p = 3 + 2 * s, q = 4 + s;
  const double a11 = 1 / sh;
  const double a22 = 3 * s * s / (2 * r2);
  const double a31 = polynomial({-4, -20, 10, -13}, s) / (8 * sh * r3);
  const double a33 = polynomial({0, 0, -2, 11}, s) / (8 * sh * r3);
  const double a42 = polynomial({0, 12, -14, -264, -45, -13}, s) / (24 * r5);
  const double a44 = polynomial({0, 0, 0, 10, -174, 291, 278}, s) / (48 * p * r5);
  const double a51 = polynomial({-1184, 32, 13232, 21712, 20940, 12554, -500, -3341, -670}, s) / (64 * sh * p * q * r6);
  const double a53 = polynomial({0, 4, 105, 198, -1376, -1302, -117, 58}, s) / (32 * sh * p * r6);
  const double a55 = polynomial({0, 0, 0, -6, 272, -1552, 852, 2029, 430}, s) / (64 * sh * p * q * r6);
  const double b22 = (1 + 2 * s) / (2 * r * th);
  const double b31 = -3 * polynomial({1, 3, 3, 2}, s) / (8 * r3);
  const double b42 = polynomial({6, -26, -182, -204, -25, 26}, s) / (6 * p * r4 * th);
  const double b44 = polynomial({24, 92, 122, 66, 67, 34}, s) / (24 * p * r4 * th);
  const double b53 = 9 * polynomial({132, 17, -2216, -5897, -6292, -2687, 194, 467, 82}, s) / (128 * p * q * r6);
  const double b55 = 5 * polynomial({300, 1579, 3176, 2949, 1188, 675, 1326, 827, 130}, s) / (384 * p * q * r6);
  const double c0 = std::sqrt(th);
  const double c2 = c0 * (2 + 7 * s * s) / (4 * r2);
  const double c4 = c0 * polynomial({4, 32, -116, -400, -71, 146}, s) / (32 * r5);
  const double d2 = -0.5 / c0;
  const double d4 = polynomial({2, 4, 1, 2}, s) / (8 * c0 * r3);
  const double e2 = th * polynomial({2, 2, 5}, s) / (4 * r2);
  const double e4 = th * polynomial({8, 12, -152, -308, -42, 77}, s) / (32 * r5);

  const double ee = e * e, e3 = ee * e, e4th = ee * ee, e5 = e4th * e;
  Series out;
  out.elevation = {e + e3 * b31 - e5 * (b53 + b55), ee * b22 + e4th * b42, -e3 * b31 + e5 * b53, e4th * b44, e5 * b55};
  const std::array<double, 5> potential{e * a11 + e3 * a31 + e5 * a51, ee * a22 + e4th * a42, e3 * a33 + e5 * a53, e4th * a44, e5 * a55};
  for (std::size_t j = 0; j < 5; ++j) {
    const double n = static_cast<double>(j + 1);
    out.velocity[j] = c0 * n * potential[j] * std::cosh(n * kd);
  }
  out.mean_speed = c0 + ee * c2 + e4th * c4;
  out.flux = ee * d2 + e4th * d4;
  out.head = 0.5 * th + ee * e2 + e4th * e4;
  return out;
}

/// Speed of the crest in earth axes over sqrt(g/k).
double celerity_of(const Series& s, double kd, RegularWaveSpec::MeanFlow flow) {
  return flow == RegularWaveSpec::MeanFlow::zero_transport ? s.mean_speed + s.flux / kd : s.mean_speed;
}

/// k from the period: c k = omega, with c at the height of the wave.
double wave_number_of(const RegularWaveSpec& spec) {
  if (spec.length > 0) return 2 * pi / spec.length;
  const double omega = 2 * pi / spec.period;
  const auto excess = [&](double k) {
    const Series s = sum_series(0.5 * k * spec.height, k * spec.depth);
    return celerity_of(s, k * spec.depth, spec.mean_flow) * std::sqrt(spec.gravity * k) - omega;
  };
  // Nonlinear waves are longer than linear ones, by less than a third.
  double upper = 1.05 * linear_wave_number(omega, spec.depth, spec.gravity), lower = 0.6 * upper;
  SEAWAY_CHECK(excess(lower) < 0 && excess(upper) > 0,
               "no fifth-order Stokes wave has height {:.4g} m and period {:.4g} s in {:.4g} m of water; use the stream function", spec.height,
               spec.period, spec.depth);
  for (int i = 0; i < 200 && upper - lower > 1e-15 * upper; ++i) {
    const double middle = 0.5 * (lower + upper);
    (excess(middle) < 0 ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

}  // namespace

std::unique_ptr<const WaveField> make_stokes_wave(const RegularWaveSpec& spec) {
  const double k = wave_number_of(spec), length = 2 * pi / k, kd = k * spec.depth;
  const double limit = highest_wave(length, spec.depth);
  SEAWAY_CHECK(spec.height <= limit,
               "wave height {:.4g} m is beyond breaking: at length {:.4g} m and depth {:.4g} m at most {:.4g} m; lower the height or make "
               "the wave longer",
               spec.height, length, spec.depth, limit);
  const double ursell = spec.height * length * length / (spec.depth * spec.depth * spec.depth);
  SEAWAY_CHECK(ursell <= largest_ursell,
               "Stokes' series fails for a wave of {:.4g} m, {:.4g} m long, in {:.4g} m of water: its Ursell number is {:.3g}, allowed is {}; "
               "use the stream function",
               spec.height, length, spec.depth, ursell, largest_ursell);
  const Series s = sum_series(0.5 * k * spec.height, kd);
  const double speed = std::sqrt(spec.gravity / k), c = celerity_of(s, kd, spec.mean_flow) * speed;
  std::array<double, 5> elevation{}, velocity{};
  double crest = 0, trough = 0;
  for (std::size_t j = 0; j < 5; ++j) {
    elevation[j] = s.elevation[j] / k;
    velocity[j] = s.velocity[j] * speed;
    crest += elevation[j];
    trough += j % 2 == 0 ? -elevation[j] : elevation[j];
  }
  const double current = c - s.mean_speed * speed;
  const double transport = c * spec.depth - (s.flux + s.mean_speed * kd) * speed / k;
  const RegularWave::Shape shape{length, length / c, c, crest, trough, current, transport};
  return std::make_unique<BernoulliWave>(spec, shape, ModeSeries(k, spec.depth, crest, current, elevation, velocity),
                                      s.head * spec.gravity / k);
}

}  // namespace seaway::waves
