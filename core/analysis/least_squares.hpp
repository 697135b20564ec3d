// SPDX-License-Identifier: GPL-3.0-or-later
// Nonlinear least squares with few parameters, and confidence intervals of what it finds. Pure functions.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace seaway::analysis {

/// A number with half of its 95 % confidence interval; negative: there are too few data for one.
struct Estimate {
  double value = 0;
  double interval = -1;
};

struct LeastSquares {
  Eigen::VectorXd parameters;
  Eigen::MatrixXd inverse_normal;  ///< (J^T J)^-1; times the variance of a residual it is the covariance
  Eigen::VectorXd residuals;
  double sum_of_squares = 0;
  bool converged = false;

  /// Degrees of freedom: residuals less parameters.
  double freedom() const { return static_cast<double>(residuals.size() - parameters.size()); }
  /// Estimate of a parameter, or of a function of all with this gradient. `correlation` >= 1 is the number of
  /// residuals that count as one (see correlation_length); 1: independent.
  Estimate estimate(double value, const Eigen::VectorXd& gradient, double correlation = 1) const;
  Estimate estimate(int parameter, double correlation = 1) const;
};

/// Minimises |r(p)|^2 from `start` by Levenberg's and Marquardt's method [marquardt1963]; derivatives by central
/// differences. `residual` fills its second argument, always with `n` entries. Parameters should be of order 1 or have
/// starting values of their order.
LeastSquares minimise(const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& residual, int n,
                      const Eigen::VectorXd& start);

/// (1 + r) / (1 - r) with r the correlation of successive residuals, at least 1: what is left of a smooth history is
/// no white noise, and intervals that took it for such would be far too small.
double correlation_length(const Eigen::VectorXd& residuals);

/// The value that |t| of Student's distribution exceeds in 5 % of cases; freedom >= 1.
double student_95(double freedom);

}  // namespace seaway::analysis
