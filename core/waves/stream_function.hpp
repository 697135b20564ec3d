// Exact steady periodic waves: Fourier approximation of the stream function [rienecker1981].
//
// In axes that travel with the crest the motion is steady. With the bed at z = -d and
//   psi = -ubar (d + z) + sum_j b_j / (j k) sinh(j k (d + z)) / cosh(j k d) cos(j k s)
// Laplace's equation and the bed condition hold exactly; the unknowns follow from collocation at
// N + 1 points from crest to trough of
//   psi(s, eta) = -Q                                  the surface is a streamline
//   (u^2 + w^2) / 2 + g eta = R                       of constant pressure
// together with the zero mean level, the height, the period or length, and the mean flow
//   zero_eulerian: c = ubar,   zero_transport: c = Q / d.
// Newton's method with the analytic Jacobian; starts from the linear wave and raises the height in
// steps [fenton1988]. The number of modes is raised until the last one no longer matters.
#pragma once

#include <memory>
#include <vector>

#include "core/waves/wave_field.hpp"

namespace seaway::waves {

struct StreamFunctionProblem {
  double height = 0;  ///< [m]
  double depth = 0;   ///< [m]
  double period = 0;  ///< [s]; exactly one of period and length is > 0
  double length = 0;  ///< [m]
  double gravity = 9.81;
  RegularWaveSpec::MeanFlow mean_flow = RegularWaveSpec::MeanFlow::zero_transport;
  int n_modes = 0;  ///< 0: 12, 16, 24, 32 until b_N at the crest < 1e-9 b_1
};

struct StreamFunctionSolution {
  double wave_number = 0, length = 0, period = 0, celerity = 0;  ///< SI, earth axes
  double mean_speed = 0;   ///< ubar, mean speed under the crest's axes [m/s]
  double volume_flux = 0;  ///< Q [m2/s]
  double bernoulli = 0;    ///< R [m2/s2], z from the mean level
  double crest = 0, trough = 0;
  std::vector<double> elevation_modes;  ///< E_1 .. E_N [m]
  std::vector<double> velocity_modes;   ///< b_1 .. b_N [m/s]
  double residual = 0;                  ///< largest residual of the scaled equations
  int iterations = 0;                   ///< Newton steps of the last solve
};

/// Throws Error(invalid_argument) if the wave is higher than the highest steady wave or so close to
/// it that the series does not converge.
StreamFunctionSolution solve_stream_function(const StreamFunctionProblem& problem);

std::unique_ptr<const WaveField> make_stream_function_wave(const RegularWaveSpec& spec);

}  // namespace seaway::waves
