// Fifth-order Stokes waves [fenton1985]: elevation, velocity and speed as series in kH/2, with coefficients that depend on
// the depth. Cheaper to set up than the stream function and good for moderate waves that are not long; the stream
// function has no such limits.
#pragma once

#include <memory>

#include "core/waves/wave_field.hpp"

namespace seaway::waves {

/// Throws Error(invalid_argument) beyond breaking, and for waves so long in so little water that the series fails: Ursell
/// number H L^2 / d^3 > 40 [fenton1990].
std::unique_ptr<const WaveField> make_stokes_wave(const RegularWaveSpec& spec);

}  // namespace seaway::waves
