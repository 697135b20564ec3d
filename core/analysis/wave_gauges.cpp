// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/analysis/wave_gauges.hpp"

#include <cmath>

#include "core/base/constants.hpp"

namespace seaway::analysis {
namespace {

/// Time that each sample stands for.
double weight_of(const Signal& s, std::size_t i) {
  const double before = i > 0 ? s.t[i - 1] : s.t[i], after = i + 1 < s.t.size() ? s.t[i + 1] : s.t[i];
  return 0.5 * (after - before);
}

double mean_of(const Signal& s) {
  double sum = 0, time = 0;
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    sum += weight_of(s, i) * s.x[i];
    time += weight_of(s, i);
  }
  return sum / time;
}

}  // namespace

std::vector<double> frequencies_of(double duration, double lower, double upper) {
  std::vector<double> out;
  for (int m = static_cast<int>(std::ceil(lower * duration)); m <= upper * duration; ++m)
    if (m > 0) out.push_back(m / duration);
  return out;
}

std::vector<std::complex<double>> transform(const Signal& s, const std::vector<double>& frequencies) {
  std::vector<std::complex<double>> out;
  const double mean = mean_of(s), from = s.t.front(), duration = s.t.back() - from;
  std::vector<double> x(s.t.size());
  double windows = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double window = weight_of(s, i) * (1 - std::cos(2 * pi * (s.t[i] - from) / duration));
    x[i] = window * (s.x[i] - mean);
    windows += window;
  }
  for (const double f : frequencies) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += std::polar(x[i], -2 * pi * f * s.t[i]);
    out.push_back(2.0 / windows * sum);
  }
  return out;
}

double significant_height(const Signal& s) {
  const double mean = mean_of(s);
  double square = 0, time = 0;
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    square += weight_of(s, i) * (s.x[i] - mean) * (s.x[i] - mean);
    time += weight_of(s, i);
  }
  return 4 * std::sqrt(square / time);
}

double peak_period(const std::vector<double>& frequencies, const std::vector<std::complex<double>>& amplitudes, double width) {
  if (frequencies.size() < 3) return frequencies.empty() ? 0 : 1 / frequencies.front();
  const auto smooth = [&](double f) {
    double sum = 0;
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const double offset = (frequencies[i] - f) / width;
      sum += std::norm(amplitudes[i]) * std::exp(-0.5 * offset * offset);
    }
    return sum;
  };
  const double step = 0.1 * (frequencies[1] - frequencies[0]);
  double best = frequencies.front(), largest = 0;
  for (double f = frequencies.front(); f <= frequencies.back(); f += step)
    if (const double value = smooth(f); value > largest) {
      largest = value;
      best = f;
    }
  return 1 / best;
}

double mean_up_crossing_period(const Signal& s) {
  const double mean = mean_of(s);
  double first = 0, last = 0;
  int n = 0;
  for (std::size_t i = 1; i < s.x.size(); ++i) {
    const double a = s.x[i - 1] - mean, b = s.x[i] - mean;
    if (!(a < 0 && b >= 0)) continue;
    last = s.t[i - 1] + (s.t[i] - s.t[i - 1]) * a / (a - b);
    if (n++ == 0) first = last;
  }
  return n < 2 ? 0 : (last - first) / (n - 1);
}

Separation separate(const std::vector<Gauge>& gauges, const std::vector<double>& wave_numbers) {
  using Complex = std::complex<double>;
  const auto n = static_cast<double>(gauges.size());
  double incident = 0, reflected = 0;
  for (std::size_t m = 0; m < wave_numbers.size(); ++m) {
    // gauge = a exp(-i k s) + b exp(i k s): normal equations [n, e; conj e, n] (a, b) = (p, q).
    Complex e = 0, p = 0, q = 0;
    for (const Gauge& g : gauges) {
      const Complex turn = std::polar(1.0, wave_numbers[m] * g.place);
      e += turn * turn;
      p += g.amplitudes[m] * turn;
      q += g.amplitudes[m] * std::conj(turn);
    }
    const double determinant = n * n - std::norm(e);
    if (determinant < 0.2 * n * n) continue;
    incident += std::norm((n * p - e * q) / determinant);
    reflected += std::norm((n * q - std::conj(e) * p) / determinant);
  }
  return {4 * std::sqrt(0.5 * incident / 1.5), incident > 0 ? std::sqrt(reflected / incident) : 0};
}

}  // namespace seaway::analysis
