#include "core/waves/stream_function.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/error.hpp"
#include "core/waves/airy.hpp"
#include "core/waves/regular_wave.hpp"

namespace seaway::waves {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// The equations, scaled with lengths 1 / k_linear and g = 1. Unknowns in this order:
/// eta_0 .. eta_N (crest to trough), b_1 .. b_N, k, ubar, q = Q - ubar d, R, c.
class SteadyWaveEquations {
 public:
  SteadyWaveEquations(int n, double depth, double period, double length, bool zero_transport)
      : n_(n), depth_(depth), period_(period), length_(length), zero_transport_(zero_transport) {}

  int size() const { return 2 * n_ + 6; }
  int eta(int m) const { return m; }
  int mode(int j) const { return n_ + j; }  // j = 1 .. N
  int k() const { return 2 * n_ + 1; }
  int ubar() const { return 2 * n_ + 2; }
  int q() const { return 2 * n_ + 3; }
  int bernoulli() const { return 2 * n_ + 4; }
  int c() const { return 2 * n_ + 5; }

  Vector linear_wave(double height) const {
    Vector x = Vector::Zero(size());
    const double speed = std::sqrt(std::tanh(depth_));
    for (int m = 0; m <= n_; ++m) x[eta(m)] = height / 2 * std::cos(m * pi / n_);
    x[mode(1)] = height / 2 / speed;
    x[k()] = 1;
    x[ubar()] = x[c()] = speed;
    x[bernoulli()] = speed * speed / 2;
    return x;
  }

  void evaluate(const Vector& x, double height, Vector& f, Matrix& jacobian) const {
    f.setZero(size());
    jacobian.setZero(size(), size());
    for (int m = 0; m <= n_; ++m) surface_point(m, x, f, jacobian);
    int row = 2 * (n_ + 1);
    for (int m = 0; m <= n_; ++m) {  // mean level zero, trapezoidal rule (exact for the series)
      const double weight = (m == 0 || m == n_) ? 0.5 / n_ : 1.0 / n_;
      f[row] += weight * x[eta(m)];
      jacobian(row, eta(m)) = weight;
    }
    ++row;
    f[row] = x[eta(0)] - x[eta(n_)] - height;
    jacobian(row, eta(0)) = 1;
    jacobian(row, eta(n_)) = -1;
    ++row;
    f[row] = x[c()] - x[ubar()] - (zero_transport_ ? x[q()] / depth_ : 0.0);
    jacobian(row, c()) = 1;
    jacobian(row, ubar()) = -1;
    if (zero_transport_) jacobian(row, q()) = -1 / depth_;
    ++row;
    if (length_ > 0) {
      f[row] = x[k()] * length_ / (2 * pi) - 1;
      jacobian(row, k()) = length_ / (2 * pi);
    } else {
      f[row] = x[c()] * x[k()] * period_ / (2 * pi) - 1;
      jacobian(row, c()) = x[k()] * period_ / (2 * pi);
      jacobian(row, k()) = x[c()] * period_ / (2 * pi);
    }
  }

 private:
  /// Streamline and pressure condition at collocation point m, with their derivatives.
  void surface_point(int m, const Vector& x, Vector& f, Matrix& jacobian) const {
    const double kk = x[k()], z = x[eta(m)];
    double psi = 0, psi_k = 0, u = -x[ubar()], w = 0, u_z = 0, w_z = 0, u_k = 0, w_k = 0;
    const int row_psi = m, row_p = n_ + 1 + m;
    for (int j = 1; j <= n_; ++j) {
      const double jk = j * kk, b = x[mode(j)];
      const double grow = std::exp(jk * z), below = std::exp(-2 * jk * (depth_ + z));
      const double norm = 1 / (1 + std::exp(-2 * jk * depth_)), th = std::tanh(jk * depth_);
      const double ch = grow * (1 + below) * norm, sh = grow * (1 - below) * norm;
      const double ch_k = j * ((depth_ + z) * sh - depth_ * ch * th);
      const double sh_k = j * ((depth_ + z) * ch - depth_ * sh * th);
      const int turns = (j * m) % (2 * n_);
      const double cos_jm = std::cos(turns * pi / n_), sin_jm = std::sin(turns * pi / n_);
      psi += b / jk * sh * cos_jm;
      psi_k += b / jk * (sh_k - sh / kk) * cos_jm;
      u += b * ch * cos_jm;
      w += b * sh * sin_jm;
      u_z += b * jk * sh * cos_jm;
      w_z += b * jk * ch * sin_jm;
      u_k += b * ch_k * cos_jm;
      w_k += b * sh_k * sin_jm;
      jacobian(row_psi, mode(j)) = sh / jk * cos_jm;
      jacobian(row_p, mode(j)) = ch * cos_jm;  // completed below, once u and w are known
    }
    for (int j = 1; j <= n_; ++j) {
      const double jk = j * kk;
      const double grow = std::exp(jk * z), below = std::exp(-2 * jk * (depth_ + z));
      const double sh = grow * (1 - below) / (1 + std::exp(-2 * jk * depth_));
      const double sin_jm = std::sin(((j * m) % (2 * n_)) * pi / n_);
      jacobian(row_p, mode(j)) = u * jacobian(row_p, mode(j)) + w * sh * sin_jm;
    }
    f[row_psi] = psi - x[ubar()] * z + x[q()];
    jacobian(row_psi, eta(m)) = u;  // d psi / dz is the horizontal velocity
    jacobian(row_psi, k()) = psi_k;
    jacobian(row_psi, ubar()) = -z;
    jacobian(row_psi, q()) = 1;
    f[row_p] = 0.5 * (u * u + w * w) + z - x[bernoulli()];
    jacobian(row_p, eta(m)) = u * u_z + w * w_z + 1;
    jacobian(row_p, k()) = u * u_k + w * w_k;
    jacobian(row_p, ubar()) = -u;
    jacobian(row_p, bernoulli()) = -1;
  }

  int n_;
  double depth_, period_, length_;
  bool zero_transport_;
};

/// Largest absolute value; infinite if any is not finite.
double largest(const Vector& v) {
  double out = 0;
  for (const double value : v) {
    if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
    out = std::max(out, std::abs(value));
  }
  return out;
}

struct NewtonResult {
  Vector x;
  double residual = 0;
  int iterations = 0;
};

std::optional<NewtonResult> newton(const SteadyWaveEquations& equations, Vector x, double height) {
  constexpr int max_iterations = 40;
  Vector f;
  Matrix jacobian;
  double last_step = std::numeric_limits<double>::infinity();
  for (int i = 0; i < max_iterations; ++i) {
    equations.evaluate(x, height, f, jacobian);
    const double residual = largest(f);
    if (!std::isfinite(residual)) return std::nullopt;
    // Quadratic convergence: once a step is tiny, the point it led to is exact to rounding.
    if (last_step < 1e-9 && residual < 1e-10) return NewtonResult{std::move(x), residual, i};
    const Vector step = jacobian.partialPivLu().solve(f);
    last_step = largest(step);
    if (!std::isfinite(last_step) || last_step > 10) return std::nullopt;
    x -= step;
  }
  return std::nullopt;
}

/// Raises the height from the linear wave in equal steps, each started by extrapolation of the last
/// two.
std::optional<NewtonResult> raise_height(const SteadyWaveEquations& equations, double height,
                                         int steps) {
  Vector before = equations.linear_wave(0);
  std::optional<NewtonResult> now;
  for (int i = 1; i <= steps; ++i) {
    const double h = height * i / steps;
    Vector start = equations.linear_wave(h);
    if (now) {
      start = 2 * now->x - before;
      before = now->x;
    }
    now = newton(equations, std::move(start), h);
    if (!now) return std::nullopt;
    // A branch with the crest elsewhere (a third of the wanted length) is not the wave asked for.
    for (int m = 0; m < equations.mode(1) - 1; ++m) {
      if (now->x[m + 1] >= now->x[m] + 1e-12) return std::nullopt;
    }
  }
  return now;
}

}  // namespace

StreamFunctionSolution solve_stream_function(const StreamFunctionProblem& p) {
  const bool by_length = p.length > 0;
  const double k_linear =
      by_length ? 2 * pi / p.length : linear_wave_number(2 * pi / p.period, p.depth, p.gravity);
  const double speed = std::sqrt(p.gravity / k_linear);  // scale of velocities
  const double limit = highest_wave(2 * pi / k_linear, p.depth);
  const auto too_high = [&](double length, double highest) {
    fail(ErrorCode::invalid_argument,
         "wave height {:.4g} m is beyond breaking or too close to it: at length {:.4g} m and depth "
         "{:.4g} m the highest steady wave is about {:.4g} m; lower the height or make the wave "
         "longer",
         p.height, length, p.depth, highest);
  };
  // A steep wave of given period is up to about 20 % longer than the linear one.
  if (!(p.height <= (by_length ? 1.0 : 1.3) * limit)) too_high(2 * pi / k_linear, limit);  // also if there is no limit

  std::optional<NewtonResult> result;
  int n = 0;
  const std::vector<int> choices =
      p.n_modes > 0 ? std::vector<int>{p.n_modes} : std::vector<int>{12, 16, 24, 32};
  const int n_most = choices.back();
  for (const int modes : choices) {
    SEAWAY_CHECK(modes >= 3 && modes <= ModeSeries::max_modes,
                 "a stream-function wave with {} modes; allowed are 3 to {}", modes,
                 static_cast<int>(ModeSeries::max_modes));
    const SteadyWaveEquations equations(modes, p.depth * k_linear, p.period * k_linear * speed,
                                        p.length * k_linear,
                                        p.mean_flow == RegularWaveSpec::MeanFlow::zero_transport);
    const int first_steps = 1 + static_cast<int>(8 * p.height / limit);
    std::optional<NewtonResult> attempt;
    for (int steps = first_steps; !attempt && steps <= 8 * first_steps; steps *= 2) {
      attempt = raise_height(equations, p.height * k_linear, steps);
    }
    if (!attempt) continue;
    result = std::move(attempt);
    n = modes;
    const double grow = std::exp((modes - 1) * result->x[equations.k()] * result->x[0]);
    const double last = std::abs(result->x[equations.mode(modes)]) * grow;
    if (last < 1e-9 * std::abs(result->x[equations.mode(1)])) break;
  }
  if (!result) {
    SEAWAY_CHECK(
        p.height > 0.7 * limit,
        "no steady wave found for height {:.4g} m, depth {:.4g} m and length about {:.4g} m = "
        "{:.3g} depths; waves longer than about 30 depths are nearly solitary and need more "
        "modes than the {} supported: shorten the wave or use Airy theory",
        p.height, p.depth, 2 * pi / k_linear, 2 * pi / (k_linear * p.depth), n_most);
    too_high(2 * pi / k_linear, limit);
  }

  const Vector& x = result->x;
  const SteadyWaveEquations at(n, 1, 1, 1, false);  // only for the positions of the unknowns
  StreamFunctionSolution s;
  s.wave_number = x[at.k()] * k_linear;
  s.length = 2 * pi / s.wave_number;
  s.celerity = x[at.c()] * speed;
  s.period = s.length / s.celerity;
  s.mean_speed = x[at.ubar()] * speed;
  s.volume_flux = (x[at.q()] * speed) / k_linear + s.mean_speed * p.depth;
  s.bernoulli = x[at.bernoulli()] * speed * speed;
  s.crest = x[0] / k_linear;
  s.trough = x[n] / k_linear;
  s.residual = result->residual;
  s.iterations = result->iterations;
  for (int j = 1; j <= n; ++j) {
    double e = 0;
    for (int m = 0; m <= n; ++m) {
      const double weight = (m == 0 || m == n) ? 0.5 : 1.0;
      e += weight * x[m] * std::cos(((j * m) % (2 * n)) * pi / n);
    }
    s.elevation_modes.push_back((j == n ? 1.0 : 2.0) / n * e / k_linear);
    s.velocity_modes.push_back(x[at.mode(j)] * speed);
  }
  const double highest = highest_wave(s.length, p.depth);
  if (p.height > highest) too_high(s.length, highest);
  // A series that has not died out would put wiggles on the surface.
  if (std::abs(s.elevation_modes.back()) > 1e-3 * p.height) too_high(s.length, highest);
  return s;
}

std::unique_ptr<const WaveField> make_stream_function_wave(const RegularWaveSpec& spec) {
  StreamFunctionProblem p;
  p.height = spec.height;
  p.depth = spec.depth;
  p.period = spec.period;
  p.length = spec.length;
  p.gravity = spec.gravity;
  p.mean_flow = spec.mean_flow;
  const StreamFunctionSolution s = solve_stream_function(p);
  const double current = s.celerity - s.mean_speed;
  const RegularWave::Shape shape{s.length, s.period,  s.celerity, s.crest,
                                 s.trough, current, s.celerity * spec.depth - s.volume_flux};
  return std::make_unique<BernoulliWave>(
      spec, shape, ModeSeries(s.wave_number, spec.depth, s.crest, current, s.elevation_modes, s.velocity_modes), s.bernoulli);
}

}  // namespace seaway::waves
