// Water volume below the elevation of a wave in a box, for volume-of-fluid cells.
#pragma once

#include "core/base/vec.hpp"
#include "core/waves/wave_field.hpp"

namespace seaway::waves {

/// Part of the box [lower, upper] (earth axes) that lies below the elevation at time t, in [0, 1].
/// The surface is taken as a plane of the right mean height on each of 4 sub-intervals a horizontal
/// direction where the box is cut through its sides only, 16 (3-D: 8) where it cuts top or bottom
/// too: error below about 1e-6 for cells of 1/40 of the wavelength and finer.
template <int Dim>
double water_fraction(const WaveField& wave, const Vec<Dim>& lower, const Vec<Dim>& upper,
                      double t);

extern template double water_fraction<2>(const WaveField&, const Vec2&, const Vec2&, double);
extern template double water_fraction<3>(const WaveField&, const Vec3&, const Vec3&, double);

/// Mean over the unit square [-1/2, 1/2]^2 of max(0, a + p x + q y): the volume under a plane.
double mean_positive_part(double a, double p, double q);

}  // namespace seaway::waves
