// Spectra of the sea and the linear waves that stand for them.
//
// f is the frequency [Hz], S(f) the spectral density of the elevation [m2/Hz], fp = 1 / Tp its peak. Moments are
// m_n = integral of f^n S df; Hs = 4 sqrt(m0), Tz = sqrt(m0 / m2), Te = m_-1 / m0.
#pragma once

#include <cstdint>
#include <vector>

namespace seaway::waves {

struct SpectrumSpec {
  enum class Shape { jonswap, bretschneider, ittc, pierson_moskowitz };
  Shape shape = Shape::jonswap;
  double peak_period = 0;         ///< Tp [s]
  double significant_height = 0;  ///< Hs of the whole spectrum [m]; pierson_moskowitz: not used
  double peak_enhancement = 3.3;  ///< jonswap [hasselmann1973]
  int n_components = 100;
  double lower_cutoff = 0.5, upper_cutoff = 2.5;  ///< part of the spectrum that is made [fp]
  double gravity = 9.81;
};

/// One linear wave: amplitude cos(k s - 2 pi f t - phase).
struct Component {
  double amplitude = 0;  ///< [m]
  double frequency = 0;  ///< [Hz]
  double phase = 0;      ///< lead [rad]
};

/// What a set of components amounts to.
struct SeaStatistics {
  double significant_height = 0;      ///< 4 sqrt(m0) [m]
  double zero_crossing_period = 0;    ///< Tz [s]
  double energy_period = 0;           ///< Te [s]
};

/// Hs of the whole spectrum [m]: as asked for, or what Tp fixes.
double significant_height_of(const SpectrumSpec& spec);

/// The density S(f) [m2/Hz]; 0 for f <= 0.
///   bretschneider  5/16 Hs^2 fp^4 f^-5 exp(-5/4 (fp/f)^4)                             [bretschneider1959]
///   jonswap        the same times gamma^exp(-(f/fp - 1)^2 / (2 s^2)), s = 0.07 below fp and 0.09 above, scaled to Hs
///   ittc           173 Hs^2 / T1^4 w^-5 exp(-691 / (T1 w)^4) per rad/s, T1 such that the peak is at Tp   [ittc1978]
///   pierson_moskowitz  0.0081 g^2 (2 pi)^-4 f^-5 exp(-5/4 (fp/f)^4)                   [pierson1964]
class Spectrum {
 public:
  explicit Spectrum(const SpectrumSpec& spec);
  double operator()(double frequency) const;

 private:
  SpectrumSpec spec_;
  double peak_, scale_;
};

/// `n_components` waves between the cut-offs: bins of equal width, the energy of each in one wave whose frequency lies
/// at random in its bin, so that the sea does not repeat itself. Random numbers: std::mt19937_64 seeded with `seed`, its
/// upper 53 bits over 2^53; for each bin first the place of the frequency, then the phase in turns. Throws
/// Error(invalid_argument) for numbers that are out of range.
std::vector<Component> make_components(const SpectrumSpec& spec, std::uint64_t seed);

SeaStatistics statistics(const std::vector<Component>& components);

}  // namespace seaway::waves
