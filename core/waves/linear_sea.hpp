// A long-crested sea: the sum of linear waves that go one way.
//
//   elevation = sum_j a_j cos(k_j s - w_j t - p_j),   w_j^2 = g k_j tanh(k_j d)
//
// Velocities are Airy's, up to the level z_j = 1 / (2 k_j) at which a component has grown by a factor 1.65; from there its
// stream function goes on as (1 + a h) exp(-k_j h) (see WaveField::velocity): short waves would otherwise blow up in the
// crests of long ones. Every component stays solenoidal by itself. The mean transport, the sum of g a_j^2 / (2 c_j), is
// taken back by a uniform current if it is to be zero; the slow set-down that goes with wave groups is of second order
// and not part of the sea.
//
// length(), period(), celerity() are those of the peak, height() is Hs (focused: twice the amplitude). crest() and
// trough() are what no run meets: 8 standard deviations, or the sum of all amplitudes if that is less.
#pragma once

#include <memory>
#include <vector>

#include "core/waves/spectrum.hpp"
#include "core/waves/wave_field.hpp"

namespace seaway::waves {

struct LinearSeaSpec {
  std::vector<Component> components;
  double peak_period = 0;        ///< [s]
  double height = 0;             ///< what height() answers [m]
  bool bounded_by_sum = false;   ///< crests can add up: focused groups
  RegularWaveSpec::MeanFlow mean_flow = RegularWaveSpec::MeanFlow::zero_transport;
  double depth = 0, heading = pi / 2, gravity = 9.81, rho = 1000;
};

/// Throws Error(invalid_argument): nothing in it, not finite, highest waves (1.86 `height`, the mean largest of 1000
/// waves of a narrow sea [longuethiggins1952]; `height` itself if bounded_by_sum) beyond breaking at the peak.
std::unique_ptr<const WaveField> make_linear_sea(const LinearSeaSpec& spec);

/// Phases such that all crests (amplitude > 0) or troughs (< 0) meet at s [m along the heading] and t, and amplitudes
/// in the ratio of the components' energies that add up to `amplitude`: the mean shape of the sea around an extreme
/// crest [tromans1991].
std::vector<Component> focus(std::vector<Component> components, double amplitude, double s, double t, double depth, double gravity);

/// Fourier components of samples at equal steps [m, s] between two frequencies, measured at s, the first at time `start`.
/// Throws Error(invalid_argument) if they do not resolve the upper one or leave more than 1000 components.
std::vector<Component> components_of_series(const std::vector<double>& elevation, double step, double start, double lower,
                                            double upper, double s, double depth, double gravity);

}  // namespace seaway::waves
