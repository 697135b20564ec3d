#include "core/waves/spectrum.hpp"

#include <cmath>
#include <random>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"

namespace seaway::waves {
namespace {

/// f^-5 exp(-5/4 (fp/f)^4), times fp^4 so that its integral is 1/5.
double fetch_shape(double f, double fp) {
  const double r = fp / f, r4 = r * r * r * r;
  return r4 / f * std::exp(-1.25 * r4);
}

double peak_factor(const SpectrumSpec& s, double f, double fp) {
  const double width = f <= fp ? 0.07 : 0.09, offset = (f / fp - 1) / width;
  return std::pow(s.peak_enhancement, std::exp(-0.5 * offset * offset));
}

/// Simpson's rule with `n` (even) intervals.
template <class F>
double integrate(F f, double from, double until, int n) {
  const double h = (until - from) / n;
  double sum = f(from) + f(until);
  for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(from + i * h);
  return sum * h / 3;
}

/// Integral of the enhanced shape with fp = 1 over all frequencies; of the plain one it is 1/5.
double enhanced_area(const SpectrumSpec& s) {
  const auto f = [&](double x) { return fetch_shape(x, 1) * peak_factor(s, x, 1); };
  const double top = 5, beyond = (1 - std::exp(-1.25 / (top * top * top * top))) / 5;  // not enhanced there
  return integrate(f, 0.2, 1, 400) + integrate(f, 1, top, 2000) + beyond;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double next() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 generator_;
};

void check(const SpectrumSpec& s) {
  SEAWAY_CHECK(std::isfinite(s.peak_period) && s.peak_period > 0, "peak period is {} s; it must be greater than 0", s.peak_period);
  SEAWAY_CHECK(s.shape == SpectrumSpec::Shape::pierson_moskowitz || (std::isfinite(s.significant_height) && s.significant_height > 0),
               "significant height is {} m; it must be greater than 0", s.significant_height);
  SEAWAY_CHECK(s.n_components >= 10 && s.n_components <= 1000, "{} wave components; allowed: 10 to 1000", s.n_components);
  SEAWAY_CHECK(s.peak_enhancement >= 1 && s.peak_enhancement <= 10, "peak enhancement is {}; allowed: 1 to 10", s.peak_enhancement);
  SEAWAY_CHECK(s.lower_cutoff >= 0.3 && s.lower_cutoff <= 0.95 && s.upper_cutoff >= 1.2 && s.upper_cutoff <= 6,
               "cut-offs at {} and {} of the peak frequency; allowed: 0.3 to 0.95 and 1.2 to 6", s.lower_cutoff, s.upper_cutoff);
}

}  // namespace

double significant_height_of(const SpectrumSpec& s) {
  if (s.shape == SpectrumSpec::Shape::pierson_moskowitz) {
    const double wp = 2 * pi / s.peak_period;
    return 4 * s.gravity * std::sqrt(0.0081 / 5) / (wp * wp);  // m0 = 0.0081 g^2 / (5 wp^4)
  }
  if (s.shape == SpectrumSpec::Shape::ittc) return s.significant_height * 4 * std::sqrt(173.0 / 691 / 4);  // its m0 = 173/691/4 Hs^2
  return s.significant_height;
}

Spectrum::Spectrum(const SpectrumSpec& spec) : spec_(spec), peak_(1 / spec.peak_period) {
  const double hs = significant_height_of(spec);
  scale_ = 5.0 / 16 * hs * hs;
  if (spec.shape == SpectrumSpec::Shape::jonswap) scale_ *= 0.2 / enhanced_area(spec);
}

double Spectrum::operator()(double f) const {
  if (!(f > 0)) return 0;
  const double factor = spec_.shape == SpectrumSpec::Shape::jonswap ? peak_factor(spec_, f, peak_) : 1;
  return scale_ * factor * fetch_shape(f, peak_);
}

std::vector<Component> make_components(const SpectrumSpec& spec, std::uint64_t seed) {
  check(spec);
  const Spectrum density(spec);
  Random random(seed);
  const double fp = 1 / spec.peak_period, lower = spec.lower_cutoff * fp;
  const double width = (spec.upper_cutoff * fp - lower) / spec.n_components;
  std::vector<Component> out;
  for (int i = 0; i < spec.n_components; ++i) {
    const double from = lower + i * width;
    Component c;
    c.amplitude = std::sqrt(2 * integrate(density, from, from + width, 16));
    c.frequency = from + width * random.next();
    c.phase = 2 * pi * random.next();
    out.push_back(c);
  }
  return out;
}

SeaStatistics statistics(const std::vector<Component>& components) {
  double m0 = 0, m2 = 0, before = 0;
  for (const Component& c : components) {
    const double energy = 0.5 * c.amplitude * c.amplitude;
    m0 += energy;
    m2 += energy * c.frequency * c.frequency;
    before += energy / c.frequency;
  }
  if (!(m0 > 0)) return {};
  return {4 * std::sqrt(m0), std::sqrt(m0 / m2), before / m0};
}

}  // namespace seaway::waves
