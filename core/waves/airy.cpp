#include "core/waves/airy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.hpp"
#include "core/waves/regular_wave.hpp"

namespace seaway::waves {
namespace {

class AiryWave final : public RegularWave {
 public:
  using RegularWave::RegularWave;

  double pressure(const Vec3& x, double t) const override {
    const double eta = elevation(x.x(), x.y(), t);
    const double weight = rho() * gravity();
    if (x.z() >= 0) return weight * (eta - x.z());
    const double k = 2 * pi / length(), d = depth(), z = std::max(x.z(), -d);
    const double decay =
        std::exp(k * z) * (1 + std::exp(-2 * k * (d + z))) / (1 + std::exp(-2 * k * d));
    return weight * (eta * decay - x.z());
  }
};

}  // namespace

double linear_omega(double wave_number, double depth, double gravity) {
  return std::sqrt(gravity * wave_number * std::tanh(wave_number * depth));
}

double linear_wave_number(double omega, double depth, double gravity) {
  // Newton on k tanh(k d) = omega^2 / g from a start between the deep and the shallow limit; the
  // function is convex where it matters, so a handful of steps reach rounding.
  const double deep = omega * omega / gravity;
  double k = deep / std::sqrt(std::tanh(deep * depth));
  for (int i = 0; i < 50; ++i) {
    const double th = std::tanh(k * depth);
    const double step = (k * th - deep) / (th + k * depth * (1 - th * th));
    k -= step;
    if (std::abs(step) < 1e-15 * k) break;
  }
  return k;
}

std::unique_ptr<const WaveField> make_airy_wave(const RegularWaveSpec& spec) {
  const double k = spec.length > 0
                       ? 2 * pi / spec.length
                       : linear_wave_number(2 * pi / spec.period, spec.depth, spec.gravity);
  const double omega = linear_omega(k, spec.depth, spec.gravity);
  const double length = 2 * pi / k, limit = highest_wave(length, spec.depth);
  SEAWAY_CHECK(
      spec.height <= limit,
      "wave height {:.4g} m is beyond breaking: at length {:.4g} m and depth {:.4g} m at most "
      "{:.4g} m; lower the height or make the wave longer",
      spec.height, length, spec.depth, limit);
  const double amplitude = spec.height / 2, c = omega / k;
  const double stokes = spec.gravity * spec.height * spec.height / (8 * c);
  const bool at_rest = spec.mean_flow == RegularWaveSpec::MeanFlow::zero_transport;
  const double current = at_rest ? -stokes / spec.depth : 0;
  const std::array<double, 1> e{amplitude};
  const std::array<double, 1> b{spec.gravity * k * amplitude / omega};
  const RegularWave::Shape shape{length,  2 * pi / omega,        c, amplitude, -amplitude,
                                 current, at_rest ? 0.0 : stokes};
  return std::make_unique<AiryWave>(spec, shape,
                                    ModeSeries(k, spec.depth, amplitude, current, e, b));
}

}  // namespace seaway::waves
