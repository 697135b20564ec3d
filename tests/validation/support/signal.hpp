// What is read off a record: crossings, turning points, noise, harmonics, grid convergence.
#pragma once

#include <complex>
#include <utility>
#include <vector>

namespace seaway::validation {

/// Samples of one signal at rising times.
struct Record {
  std::vector<double> t, value;
  void add(double time, double v) {
    t.push_back(time);
    value.push_back(v);
  }
};

/// Times at which the signal changes sign: straight line between samples, exact to third order
/// where a swing crosses its mean.
std::vector<double> zero_crossings(const Record& record);

struct TurningPoint {
  double t = 0, value = 0;
};
/// Top of the parabola through each sample that exceeds its neighbours; the ends do not count.
std::vector<TurningPoint> turning_points(const Record& record);

/// Rms distance of the samples from `from` on to a running least-squares fit over `width` seconds
/// around each: what no force of the swing's own frequency can explain. `parabola` false: running
/// mean, which leaves part of the swing itself, (width / period)^2 or so, in the result.
double high_frequency_rms(const Record& record, double from, double width, bool parabola);

/// Least-squares a of  mean + Re(a exp(-i omega t))  from `from` on.
std::complex<double> harmonic(const Record& record, double omega, double from);

/// Slope of the straight line of least squares.
double slope(const Record& record);

/// Angles made continuous: steps of more than pi are taken back.
void unwrap(std::vector<double>& angle);

/// Order p of  f(h) = f(0) + C h^p  from three grids, each twice as fine as the one before.
double observed_order(double coarse, double medium, double fine);
/// f(0) from the two finest of them.
double extrapolate(double medium, double fine, double order);

}  // namespace seaway::validation
