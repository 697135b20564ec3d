#include "core/waves/linear_sea.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/base/error.hpp"
#include "core/waves/airy.hpp"
#include "core/waves/vector_math.hpp"

namespace seaway::waves {
namespace {

constexpr int lanes = 8;  ///< partial sums: the order of additions does not depend on how loops are vectorised

/// Sum of a[j] b[j]; sizes are whole numbers of lanes.
double dot(const double* a, const double* b, int n) {
  std::array<double, lanes> part{};
  for (int j = 0; j < n; j += lanes)
    for (int l = 0; l < lanes; ++l) part[static_cast<std::size_t>(l)] += a[j + l] * b[j + l];
  double sum = 0;
  for (const double p : part) sum += p;
  return sum;
}

class LinearSea final : public WaveField {
 public:
  explicit LinearSea(const LinearSeaSpec& spec);

  double elevation(double x, double y, double t) const override;
  void elevation_grid(const Grid& grid, double t, std::span<double> out) const override;
  Vec3 velocity(const Vec3& x, double t) const override;
  void column_velocity(double x, double y, double t, std::span<const double> z, std::span<Vec3> velocity) const override;
  double pressure(const Vec3& x, double t) const override;

  double length() const override { return length_; }
  double period() const override { return spec_.peak_period; }
  double celerity() const override { return length_ / spec_.peak_period; }
  double depth() const override { return spec_.depth; }
  double height() const override { return spec_.height; }
  double heading() const override { return spec_.heading; }
  double gravity() const override { return spec_.gravity; }
  double rho() const override { return spec_.rho; }
  double crest() const override { return crest_; }
  double trough() const override { return -crest_; }
  double max_slope() const override { return max_slope_; }
  double mean_eulerian_velocity() const override { return current_; }
  double mean_transport() const override { return transport_; }

 private:
  static constexpr int most = 1000 + lanes;
  using Row = std::array<double, most>;

  double along(double x, double y) const { return x * cos_heading_ + y * sin_heading_; }
  void angles(double s, double t, Row& cosine, Row& sine) const;
  /// Horizontal and vertical velocity at heights up to z = 0 that are equally spaced, from the lowest.
  void below(const Row& cosine, const Row& sine, std::span<const double> z, double dz, std::span<Vec3> velocity) const;
  Vec3 at_height(const Row& cosine, const Row& sine, double z) const;
  Vec3 turned(double u, double w) const { return {u * cos_heading_, u * sin_heading_, w}; }

  LinearSeaSpec spec_;
  int n_ = 0;  ///< components, filled up with nothing to whole lanes
  std::vector<double> amplitude_, k_, omega_, phase_;
  std::vector<double> speed_;   ///< a w / (1 - exp(-2 k d)): velocity over exp(k z) +- exp(-k (2 d + z))
  std::vector<double> mirror_;  ///< exp(-2 k d)
  std::vector<double> top_;     ///< level of the continuation
  double length_, current_ = 0, transport_ = 0, crest_ = 0, max_slope_ = 0, cos_heading_, sin_heading_;
};

LinearSea::LinearSea(const LinearSeaSpec& spec)
    : spec_(spec), cos_heading_(std::cos(spec.heading)), sin_heading_(std::sin(spec.heading)) {
  double sum = 0, energy = 0, slopes = 0, slope_energy = 0, stokes = 0;
  for (const Component& c : spec.components) {
    const double omega = 2 * pi * c.frequency, k = linear_wave_number(omega, spec.depth, spec.gravity);
    amplitude_.push_back(c.amplitude);
    k_.push_back(k);
    omega_.push_back(omega);
    phase_.push_back(c.phase);
    mirror_.push_back(std::exp(-2 * k * spec.depth));
    speed_.push_back(c.amplitude * omega / (1 - mirror_.back()));
    top_.push_back(0.5 / k);
    const double a = std::abs(c.amplitude);
    sum += a;
    energy += 0.5 * a * a;
    slopes += k * a;
    slope_energy += 0.5 * k * k * a * a;
    stokes += spec.gravity * a * a * k / (2 * omega);
  }
  n_ = (static_cast<int>(k_.size()) + lanes - 1) / lanes * lanes;
  for (auto* list : {&amplitude_, &omega_, &phase_, &speed_, &mirror_}) list->resize(static_cast<std::size_t>(n_), 0.0);
  for (auto* list : {&k_, &top_}) list->resize(static_cast<std::size_t>(n_), 1.0);
  const double peak = linear_wave_number(2 * pi / spec.peak_period, spec.depth, spec.gravity);
  length_ = 2 * pi / peak;
  crest_ = spec.bounded_by_sum ? sum : std::min(sum, 8 * std::sqrt(energy));
  max_slope_ = spec.bounded_by_sum ? slopes : std::min(slopes, 8 * std::sqrt(slope_energy));
  const bool at_rest = spec.mean_flow == RegularWaveSpec::MeanFlow::zero_transport;
  current_ = at_rest ? -stokes / spec.depth : 0;
  transport_ = at_rest ? 0 : stokes;
}

void LinearSea::angles(double s, double t, Row& cosine, Row& sine) const {
  const double* k = k_.data();
  const double* omega = omega_.data();
  const double* phase = phase_.data();
  for (int j = 0; j < n_; ++j) cos_sin(k[j] * s - omega[j] * t - phase[j], cosine[static_cast<std::size_t>(j)], sine[static_cast<std::size_t>(j)]);
}

double LinearSea::elevation(double x, double y, double t) const {
  Row cosine, sine;
  angles(along(x, y), t, cosine, sine);
  return dot(amplitude_.data(), cosine.data(), n_);
}

/// The sea is the same all along its crests: points with the same s are worked out once.
void LinearSea::elevation_grid(const Grid& grid, double t, std::span<double> out) const {
  const bool along_y = std::abs(cos_heading_) < 1e-12, along_x = std::abs(sin_heading_) < 1e-12;
  if (!along_x && !along_y) return WaveField::elevation_grid(grid, t, out);
  const auto at = [&](int i, int j) -> double& { return out[static_cast<std::size_t>(j * grid.nx + i)]; };
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      if (along_y && i > 0) at(i, j) = at(0, j);
      else if (along_x && j > 0) at(i, j) = at(i, 0);
      else at(i, j) = elevation(grid.x0 + i * grid.dx, grid.y0 + j * grid.dy, t);
    }
}

void LinearSea::below(const Row& cosine, const Row& sine, std::span<const double> z, double dz, std::span<Vec3> velocity) const {
  Row up, step, down, back;  // exp(k z), exp(k dz) and the parts of the mirror at the bed
  for (int j = 0; j < n_; ++j) {
    const auto i = static_cast<std::size_t>(j);
    const double growth = exponential(k_[i] * z.front()), ratio = exponential(k_[i] * dz);
    up[i] = speed_[i] * growth;
    step[i] = ratio;
    down[i] = speed_[i] * (mirror_[i] / growth);
    back[i] = 1 / ratio;
  }
  for (std::size_t level = 0; level < z.size(); ++level) {
    std::array<double, lanes> u{}, w{};
    for (int j = 0; j < n_; j += lanes)
      for (int l = 0; l < lanes; ++l) {
        const auto i = static_cast<std::size_t>(j + l);
        u[static_cast<std::size_t>(l)] += (up[i] + down[i]) * cosine[i];
        w[static_cast<std::size_t>(l)] += (up[i] - down[i]) * sine[i];
        up[i] *= step[i];
        down[i] *= back[i];
      }
    double along = current_, upwards = 0;
    for (std::size_t l = 0; l < lanes; ++l) {
      along += u[l];
      upwards += w[l];
    }
    velocity[level] = turned(along, upwards);
  }
}

Vec3 LinearSea::at_height(const Row& cosine, const Row& sine, double z) const {
  const double level = std::max(z, -spec_.depth);
  std::array<double, lanes> u{}, w{};
  for (int j = 0; j < n_; j += lanes)
    for (int l = 0; l < lanes; ++l) {
      const auto i = static_cast<std::size_t>(j + l);
      const double inside = level < top_[i] ? level : top_[i], over = level - inside;
      const double growth = exponential(k_[i] * inside), mirrored = mirror_[i] / growth;
      const double even = speed_[i] * (growth + mirrored), odd = speed_[i] * (growth - mirrored);
      // f = (1 + a h) exp(-k h) with a = k (1 + even / odd): w = f odd, u = f' / k odd, continuous at the top.
      const double kh = k_[i] * over, fade = exponential(-kh), both = odd + even;
      u[static_cast<std::size_t>(l)] += fade * (even - kh * both) * cosine[i];
      w[static_cast<std::size_t>(l)] += fade * (odd + kh * both) * sine[i];
    }
  double along = current_, upwards = 0;
  for (std::size_t l = 0; l < lanes; ++l) {
    along += u[l];
    upwards += w[l];
  }
  return turned(along, upwards);
}

Vec3 LinearSea::velocity(const Vec3& x, double t) const {
  Row cosine, sine;
  angles(along(x.x(), x.y()), t, cosine, sine);
  return at_height(cosine, sine, x.z());
}

void LinearSea::column_velocity(double x, double y, double t, std::span<const double> z, std::span<Vec3> velocity) const {
  SEAWAY_ASSERT(z.size() == velocity.size());
  Row cosine, sine;
  angles(along(x, y), t, cosine, sine);
  // Heights in the water that are equally spaced, as in a grid, need two exponentials a component in all.
  std::size_t n = 0;
  if (z.size() > 2 && z[0] > -spec_.depth) {
    const double dz = z[1] - z[0];
    while (n < z.size() && z[n] <= 0 && std::abs(z[n] - z[0] - dz * static_cast<double>(n)) <= 1e-12 * std::abs(dz) * static_cast<double>(n + 1)) ++n;
    if (dz > 0 && n > 2)
      below(cosine, sine, z.first(n), dz, velocity.first(n));
    else
      n = 0;
  }
  for (; n < z.size(); ++n) velocity[n] = at_height(cosine, sine, z[n]);
}

double LinearSea::pressure(const Vec3& x, double t) const {
  Row cosine, sine;
  angles(along(x.x(), x.y()), t, cosine, sine);
  const double z = std::clamp(x.z(), -spec_.depth, 0.0);
  double head = 0;
  for (int j = 0; j < n_; ++j) {
    const auto i = static_cast<std::size_t>(j);
    const double growth = std::exp(k_[i] * z);
    head += amplitude_[i] * cosine[i] * (growth + mirror_[i] / growth) / (1 + mirror_[i]);
  }
  return spec_.rho * spec_.gravity * (head - x.z());
}

}  // namespace

std::unique_ptr<const WaveField> make_linear_sea(const LinearSeaSpec& spec) {
  SEAWAY_CHECK(!spec.components.empty() && spec.components.size() <= 1000, "a sea of {} components; allowed: 1 to 1000", spec.components.size());
  for (const Component& c : spec.components)
    SEAWAY_CHECK(std::isfinite(c.amplitude) && std::isfinite(c.frequency) && c.frequency > 0 && std::isfinite(c.phase),
                 "a component of amplitude {} m and frequency {} Hz; both must be finite, the frequency above 0", c.amplitude, c.frequency);
  SEAWAY_CHECK(spec.depth > 0 && spec.peak_period > 0 && spec.height > 0 && spec.gravity > 0 && spec.rho > 0,
               "depth {} m, peak period {} s, height {} m, gravity {} and density {} must be greater than 0", spec.depth,
               spec.peak_period, spec.height, spec.gravity, spec.rho);
  const double length = 2 * pi / linear_wave_number(2 * pi / spec.peak_period, spec.depth, spec.gravity);
  const double highest = spec.bounded_by_sum ? spec.height : 1.86 * spec.height, limit = highest_wave(length, spec.depth);
  SEAWAY_CHECK(highest <= limit,
               "waves of up to {:.4g} m are beyond breaking: at the peak's length {:.4g} m and depth {:.4g} m at most {:.4g} m; lower "
               "the sea or make its peak period longer",
               highest, length, spec.depth, limit);
  return std::make_unique<LinearSea>(spec);
}

std::vector<Component> focus(std::vector<Component> components, double amplitude, double s, double t, double depth, double gravity) {
  double energy = 0;
  for (const Component& c : components) energy += 0.5 * c.amplitude * c.amplitude;
  for (Component& c : components) {
    const double omega = 2 * pi * c.frequency, k = linear_wave_number(omega, depth, gravity);
    c.amplitude = amplitude * 0.5 * c.amplitude * c.amplitude / energy;
    c.phase = k * s - omega * t;
  }
  return components;
}

std::vector<Component> components_of_series(const std::vector<double>& elevation, double step, double start, double lower,
                                            double upper, double s, double depth, double gravity) {
  const auto n = elevation.size();
  SEAWAY_CHECK(n >= 16 && step > 0, "a series of {} samples every {} s; at least 16 are needed", n, step);
  SEAWAY_CHECK(lower > 0 && upper > lower, "cut-offs {} and {} Hz; the first must be above 0 and the second above it", lower, upper);
  SEAWAY_CHECK(upper * 2 * step < 1, "samples every {} s do not show {} Hz; the upper cut-off must be below {:.4g} Hz", step, upper, 0.5 / step);
  const double duration = static_cast<double>(n) * step;
  const auto first = static_cast<int>(std::ceil(lower * duration)), last = static_cast<int>(std::floor(upper * duration));
  SEAWAY_CHECK(last >= first && last - first < 1000, "{} components between {} and {} Hz in {:.4g} s; allowed: 1 to 1000", std::max(last - first + 1, 0),
               lower, upper, duration);
  std::vector<Component> out;
  for (int m = first; m <= last; ++m) {
    double even = 0, odd = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * pi * static_cast<double>(static_cast<std::uint64_t>(m) * i % n) / static_cast<double>(n);
      even += elevation[i] * std::cos(angle);
      odd += elevation[i] * std::sin(angle);
    }
    const double frequency = m / duration, omega = 2 * pi * frequency;
    // a cos(w (t - start) - lag) at s is a cos(k s - w t - phase).
    const double lag = std::atan2(odd, even);
    out.push_back({2 * std::hypot(even, odd) / static_cast<double>(n), frequency,
                   linear_wave_number(omega, depth, gravity) * s - omega * start - lag});
  }
  return out;
}

}  // namespace seaway::waves
