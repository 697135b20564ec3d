// Linear theory of a half-submerged circular cylinder (2-D) or sphere (3-D) in heave on deep water: added mass and
// damping by multipoles [ursell1949, hulme1982], and from them the decay after a release from rest [maskell1970].
// Lengths are in radii, masses in those of the displaced water, times in sqrt(radius / gravity). Pure functions.
#pragma once

#include "tests/validation/support/signal.hpp"

namespace seaway::validation {

struct HeaveRadiation {
  double added_mass = 0;  ///< over the displaced mass
  double damping = 0;     ///< over the displaced mass and omega
  /// The damping once more, from the energy of the waves far away: equal to `damping` if the solution is one.
  double damping_of_waves = 0;
};

/// `wave_number`: omega^2 radius / gravity, in (0, 20]; `dim` 2 or 3.
HeaveRadiation heave_radiation(int dim, double wave_number);

/// Heave over the release height at the times 0, step, 2 step, ... up to `duration`, of a body let go at rest above the
/// position in which it floats half submerged. Accurate to 1e-4 up to duration 40.
Record linear_heave_decay(int dim, double duration, double step);

}  // namespace seaway::validation
