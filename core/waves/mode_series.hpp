// The kinematics that regular wave theories share: a steady profile that travels, as a Fourier
// series.
//
//   elevation = sum_j E_j cos(j theta)
//   u = U + sum_j b_j cosh(j k (d + z)) / cosh(j k d) cos(j theta)
//   w =     sum_j b_j sinh(j k (d + z)) / cosh(j k d) sin(j theta)
//
// With X = exp(k z) and Y = exp(-k (2 d + z)) the ratio of hyperbolic functions is
// (X^j + Y^j) / (1 + exp(-2 j k d)), so that u and w at one position are polynomials in X and Y:
// no overflow in deep water and one exponential a point. Above z = `top` see WaveField::velocity.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace seaway::waves {

class ModeSeries {
 public:
  static constexpr int max_modes = 40;

  /// `elevation_modes[j - 1]` is E_j [m], `velocity_modes[j - 1]` is b_j [m/s]; at most max_modes
  /// each. `top` is the level from which the velocity decays upwards. `current` is U.
  /// Modes that contribute less than 1e-11 of the first are dropped.
  ModeSeries(double k, double depth, double top, double current,
             std::span<const double> elevation_modes, std::span<const double> velocity_modes);

  double elevation(double theta) const;
  /// d elevation / d theta.
  double elevation_slope(double theta) const;
  double max_slope() const;  ///< sum of j k |E_j|

  struct Velocity {
    double along, up;
  };
  /// One position and time: factors of the polynomials, made once and used for many heights.
  struct Column {
    int n = 0;
    std::array<double, max_modes> even, odd;  ///< b_j / (1 + exp(-2jkd)) times cos, sin
    std::array<double, max_modes> above_u0, above_u1, above_w0, above_w1;  ///< empty until needed
    bool above_ready = false;
    double cos_theta = 0, sin_theta = 0;
  };
  Column column(double theta) const;
  Velocity velocity(Column& column, double z) const;

  int n_velocity_modes() const { return static_cast<int>(b_.size()); }
  int n_elevation_modes() const { return static_cast<int>(e_.size()); }

 private:
  void prepare_above(Column& column) const;

  double k_, depth_, top_, current_;
  double two_depth_decay_;                   ///< exp(-2 k d)
  std::vector<double> e_;                    ///< E_j
  std::vector<double> b_;                    ///< b_j / (1 + exp(-2jkd))
  std::vector<double> cosh_top_, sinh_top_;  ///< b_j times the ratios at z = top
};

}  // namespace seaway::waves
