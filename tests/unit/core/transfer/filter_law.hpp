// What the partitioned interpolation leaves of plane waves, measured on a lattice and by the filter law.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "core/base/constants.hpp"
#include "core/transfer/prbf.hpp"

namespace seaway::transfer::testing {

/// The points of an edge^3 lattice so that every b^3-th of them is one shifted sublattice.
inline std::vector<Vec3> lattice_by_sublattices(int edge, int b) {
  std::vector<Vec3> x;
  const int m = edge / b;
  for (int kk = 0; kk < m; ++kk)
    for (int jj = 0; jj < m; ++jj)
      for (int ii = 0; ii < m; ++ii)
        for (int k = 0; k < b; ++k)
          for (int j = 0; j < b; ++j)
            for (int i = 0; i < b; ++i) x.emplace_back(ii * b + i, jj * b + j, kk * b + k);
  return x;
}

/// Amplitudes of plane waves after the average of 125 sublattices of a 40^3 lattice, at points in its middle.
inline std::vector<double> amplitudes(Kernel kernel, const std::vector<Vec3>& waves) {
  const std::vector<Vec3> points = lattice_by_sublattices(40, 5);
  std::vector<Vec3> targets;
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> middle(14, 25);
  for (int t = 0; t < 256; ++t) targets.emplace_back(middle(rng), middle(rng), middle(rng));
  const auto fields = [&](const std::vector<Vec3>& x) {
    Eigen::MatrixXd f(static_cast<Eigen::Index>(x.size()), static_cast<Eigen::Index>(2 * waves.size()));
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t w = 0; w < waves.size(); ++w) {
        f(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(2 * w)) = std::cos(waves[w].dot(x[i]));
        f(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(2 * w + 1)) = std::sin(waves[w].dot(x[i]));
      }
    return f;
  };
  PrbfOptions options;
  options.k = 125;
  options.kernel = kernel;
  const Eigen::MatrixXd s = prbf_interpolate<3>(options, points, fields(points), targets);
  const Eigen::MatrixXd exact = fields(targets);
  std::vector<double> out;
  for (Eigen::Index w = 0; w < exact.cols(); w += 2)
    out.push_back(s.middleCols(w, 2).cwiseProduct(exact.middleCols(w, 2)).sum() /
                  static_cast<double>(targets.size()));
  return out;
}

struct FilterMode {
  double cells;      ///< lattice spacings a wavelength
  double amplitude;  ///< measured
  double law;        ///< prbf_filter
};

/// An oblique wave of 4 to 40 spacings under the average of 125 sublattices.
inline std::vector<FilterMode> filter_modes(Kernel kernel, int beta) {
  const Vec3 direction = Vec3(1, 0.6, 0.35).normalized();
  const std::vector<double> cells{4, 6, 8, 12, 16, 24, 40};
  std::vector<Vec3> waves;
  for (const double c : cells) waves.push_back(direction * (2 * pi / c));
  const std::vector<double> found = amplitudes(kernel, waves);
  std::vector<FilterMode> modes;
  for (std::size_t w = 0; w < waves.size(); ++w)
    modes.push_back({cells[w], found[w], prbf_filter(waves[w], 5, beta)});
  return modes;
}

}  // namespace seaway::transfer::testing
