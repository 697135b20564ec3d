// Waves as functions of (x, t): what initial fields, relaxation zones and reports ask of a wave
// theory.
//
// Earth axes: x forward, y port, z up, z = 0 at the mean water level, bed at z = -depth.
// Heading beta is the direction the wave goes to, from +x towards port: 0 following, pi/2 from
// starboard to port, pi head sea. With s = x cos(beta) + y sin(beta) a regular wave depends on
//
//   theta = k s - omega t - phase
//
// and has its crest at theta = 0: at the origin the crest passes at t = -phase / omega (lead
// positive). A 2-D section (y-z plane) uses x = 0; its waves need heading +-pi/2 (checked by
// make_wave's caller, who alone knows the dimension).
//
// Everything here is const after construction and safe to call from any thread.
#pragma once

#include <memory>
#include <span>

#include "core/base/constants.hpp"
#include "core/base/vec.hpp"

namespace seaway::waves {

class WaveField {
 public:
  virtual ~WaveField() = default;

  /// Height of the surface above z = 0 [m].
  virtual double elevation(double x, double y, double t) const = 0;

  /// The same at all points of a grid, x fastest; out has nx ny entries.
  struct Grid {
    double x0, y0, dx, dy;
    int nx, ny;
  };
  virtual void elevation_grid(const Grid& grid, double t, std::span<double> out) const;

  /// Water velocity [m/s] at any point. Below the crest level it is the theory's own field (also
  /// above the surface in a trough: the series is continued). Above the crest level the stream
  /// function of each mode goes on as (1 + a s) exp(-j k s), s = height over the crest: velocity
  /// continuous, solenoidal, dying out upwards; the mean current goes on unchanged. At and below
  /// the bed: the bed's value (vertical velocity 0).
  virtual Vec3 velocity(const Vec3& x, double t) const = 0;

  /// The same at many heights over one horizontal position: the fast path for grids. Sizes must
  /// agree. Cost: about one cosine and two dozen multiplications a column, then one exponential and
  /// four short polynomials a height (measured in tests/unit/core/waves/wave_speed_test.cpp).
  virtual void column_velocity(double x, double y, double t, std::span<const double> z,
                               std::span<Vec3> velocity) const = 0;

  /// Pressure [Pa]: hydrostatic and dynamic, 0 at the surface (exactly for the stream function, to
  /// first order for Airy). Negative above the surface; meant to be read in the water.
  virtual double pressure(const Vec3& x, double t) const = 0;

  /// pressure + rho g z [Pa].
  double dynamic_pressure(const Vec3& x, double t) const {
    return pressure(x, t) + rho() * gravity() * x.z();
  }

  virtual double length() const = 0;    ///< [m]
  virtual double period() const = 0;    ///< [s] in earth axes
  virtual double celerity() const = 0;  ///< speed of the crest in earth axes [m/s]
  virtual double depth() const = 0;     ///< [m]
  virtual double height() const = 0;    ///< crest to trough [m]
  virtual double heading() const = 0;   ///< [rad]
  virtual double gravity() const = 0;   ///< [m/s2]
  virtual double rho() const = 0;       ///< [kg/m3]

  virtual double crest() const = 0;      ///< highest elevation [m], > 0
  virtual double trough() const = 0;     ///< lowest elevation [m], < 0
  virtual double max_slope() const = 0;  ///< bound of |d elevation / d s|

  /// Mean velocity of a fixed point below the trough, along the heading [m/s].
  virtual double mean_eulerian_velocity() const = 0;
  /// Mean volume flux through a vertical plane across the heading [m2/s]; 0 for zero_transport.
  virtual double mean_transport() const = 0;
};

/// A regular wave as the user describes it. Exactly one of period and length is > 0.
struct RegularWaveSpec {
  enum class Theory { stream_function, airy, stokes_5 };
  /// What is at rest in the mean: the water as a whole (Stokes' second definition; a closed tank,
  /// where the crests' forward transport must flow back below) or a fixed probe under the trough
  /// (the first).
  enum class MeanFlow { zero_transport, zero_eulerian };
  Theory theory = Theory::stream_function;
  MeanFlow mean_flow = MeanFlow::zero_transport;
  double height = 0;        ///< crest to trough [m]
  double period = 0;        ///< [s]
  double length = 0;        ///< [m]
  double depth = 0;         ///< [m]
  double heading = pi / 2;  ///< [rad]
  double phase = 0;         ///< lead of the crest at the origin at t = 0 [rad]
  double gravity = 9.81;    ///< [m/s2]
  double rho = 1000;        ///< [kg/m3]; only scales the pressure
};

/// Throws Error(invalid_argument) with the value and the limit: not finite, not positive, both or
/// none of period and length, higher than the highest steady wave.
std::unique_ptr<const WaveField> make_wave(const RegularWaveSpec& spec);

/// Height of the highest steady wave of this length and depth [m]: Fenton's fit [fenton1990] to
/// Williams' computed limits; good to about 1 %.
double highest_wave(double length, double depth);

/// The wave seen by a run of Dim dimensions (2: the y-z plane at x = 0).
template <int Dim>
double elevation_at(const WaveField& wave, const Vec<Dim>& x, double t) {
  const Vec3 p = to_vec3<Dim>(x);
  return wave.elevation(p.x(), p.y(), t);
}
template <int Dim>
Vec<Dim> velocity_at(const WaveField& wave, const Vec<Dim>& x, double t) {
  return from_vec3<Dim>(wave.velocity(to_vec3<Dim>(x), t));
}

}  // namespace seaway::waves
