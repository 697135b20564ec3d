// Linear (Airy) waves in water of constant depth.
#pragma once

#include <memory>

#include "core/waves/wave_field.hpp"

namespace seaway::waves {

/// Wave number k [1/m] of omega^2 = g k tanh(k d), to rounding. omega, depth, gravity > 0.
double linear_wave_number(double omega, double depth, double gravity);

/// Angular frequency [rad/s] of wave number k.
double linear_omega(double wave_number, double depth, double gravity);

/// Airy wave of spec (its theory field is ignored). To second order in height a linear wave carries
/// the transport g H^2 / (8 c); zero_transport returns it as a uniform current (whose small Doppler
/// shift is left out, as it is of higher order than the theory). Pressure is linear below z = 0 and
/// hydrostatic from the surface above it.
std::unique_ptr<const WaveField> make_airy_wave(const RegularWaveSpec& spec);

}  // namespace seaway::waves
