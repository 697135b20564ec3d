#include "core/waves/wave_field.hpp"

#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/waves/airy.hpp"
#include "core/waves/regular_wave.hpp"
#include "core/waves/stokes.hpp"
#include "core/waves/stream_function.hpp"

namespace seaway::waves {

RegularWave::RegularWave(const RegularWaveSpec& spec, const Shape& shape, ModeSeries series)
    : spec_(spec),
      shape_(shape),
      series_(std::move(series)),
      k_(2 * pi / shape.length),
      omega_(2 * pi / shape.period),
      cos_heading_(std::cos(spec.heading)),
      sin_heading_(std::sin(spec.heading)) {}

double RegularWave::theta(double x, double y, double t) const {
  return k_ * (x * cos_heading_ + y * sin_heading_) - omega_ * t - spec_.phase;
}

double RegularWave::elevation(double x, double y, double t) const {
  return series_.elevation(theta(x, y, t));
}

Vec3 RegularWave::velocity(const Vec3& x, double t) const {
  ModeSeries::Column column = series_.column(theta(x.x(), x.y(), t));
  const ModeSeries::Velocity v = series_.velocity(column, x.z());
  return {v.along * cos_heading_, v.along * sin_heading_, v.up};
}

BernoulliWave::BernoulliWave(const RegularWaveSpec& spec, const Shape& shape, ModeSeries series, double bernoulli)
    : RegularWave(spec, shape, std::move(series)), bernoulli_(bernoulli) {}

double BernoulliWave::pressure(const Vec3& x, double t) const {
  ModeSeries::Column column = series().column(theta(x.x(), x.y(), t));
  const ModeSeries::Velocity v = series().velocity(column, x.z());
  const double u = v.along - celerity();
  return rho() * (bernoulli_ - gravity() * x.z() - 0.5 * (u * u + v.up * v.up));
}

void RegularWave::column_velocity(double x, double y, double t, std::span<const double> z,
                                  std::span<Vec3> velocity) const {
  SEAWAY_ASSERT(z.size() == velocity.size());
  ModeSeries::Column column = series_.column(theta(x, y, t));
  for (std::size_t i = 0; i < z.size(); ++i) {
    const ModeSeries::Velocity v = series_.velocity(column, z[i]);
    velocity[i] = {v.along * cos_heading_, v.along * sin_heading_, v.up};
  }
}

void WaveField::elevation_grid(const Grid& grid, double t, std::span<double> out) const {
  std::size_t at = 0;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) out[at++] = elevation(grid.x0 + i * grid.dx, grid.y0 + j * grid.dy, t);
}

double highest_wave(double length, double depth) {
  const double r = length / depth;  // [fenton1990]
  return depth * (0.141063 * r + 0.0095721 * r * r + 0.0077829 * r * r * r) /
         (1 + 0.0788340 * r + 0.0317567 * r * r + 0.0093407 * r * r * r);
}

std::unique_ptr<const WaveField> make_wave(const RegularWaveSpec& spec) {
  const auto positive = [](double value, const char* what) {
    SEAWAY_CHECK(std::isfinite(value) && value > 0, "wave {} is {}; it must be greater than 0",
                 what, value);
  };
  positive(spec.height, "height");
  positive(spec.depth, "depth");
  positive(spec.gravity, "gravity");
  positive(spec.rho, "water density");
  SEAWAY_CHECK(std::isfinite(spec.heading) && std::isfinite(spec.phase),
               "wave heading {} rad and phase {} rad must be finite", spec.heading, spec.phase);
  SEAWAY_CHECK((spec.period > 0) != (spec.length > 0),
               "wave period is {} s and length is {} m; give exactly one of the two", spec.period,
               spec.length);
  positive(spec.period > 0 ? spec.period : spec.length, spec.period > 0 ? "period" : "length");
  const double length = spec.length > 0 ? spec.length : 2 * pi / linear_wave_number(2 * pi / spec.period, spec.depth, spec.gravity);
  const double highest = highest_wave(length, spec.depth);  // not a number where powers of length over depth overflow
  SEAWAY_CHECK(std::isfinite(highest) && highest > 0,
               "wave length {:.4g} m (period {:.4g} s) in depth {:.4g} m is out of all proportion; check the units", length,
               spec.period, spec.depth);
  switch (spec.theory) {
    case RegularWaveSpec::Theory::airy:
      return make_airy_wave(spec);
    case RegularWaveSpec::Theory::stokes_5:
      return make_stokes_wave(spec);
    case RegularWaveSpec::Theory::stream_function:
      return make_stream_function_wave(spec);
  }
  fail(ErrorCode::internal, "unknown wave theory {}", static_cast<int>(spec.theory));
}

}  // namespace seaway::waves
