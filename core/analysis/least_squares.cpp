// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/analysis/least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/constants.hpp"

namespace seaway::analysis {
namespace {

/// P(|T| < t) for a whole number of degrees of freedom, as finite sums (26.7.3 and 26.7.4 of [abramowitz1964]).
double student_central(double t, int freedom) {
  const double angle = std::atan(t / std::sqrt(freedom));
  const double c = std::cos(angle), s = std::sin(angle);
  if (freedom == 1) return 2 * angle / pi;
  const bool odd = freedom % 2 != 0;
  double term = odd ? c : 1, sum = term;
  for (int i = odd ? 2 : 1; i <= freedom - 3; i += 2) {
    term *= c * c * i / (i + 1);
    sum += term;
  }
  return odd ? 2 / pi * (angle + s * sum) : s * sum;
}

double student_whole(int freedom) {
  double lower = 1.9, upper = 13;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (lower + upper);
    (student_central(middle, freedom) < 0.95 ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

Eigen::MatrixXd derivatives(const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& residual, int n,
                            const Eigen::VectorXd& at) {
  Eigen::MatrixXd out(n, at.size());
  Eigen::VectorXd plus(n), minus(n), p = at;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const double step = 6e-6 * std::max(std::abs(at[i]), 1e-3);  // cube root of the rounding error
    p[i] = at[i] + step;
    residual(p, plus);
    p[i] = at[i] - step;
    residual(p, minus);
    p[i] = at[i];
    out.col(i) = (plus - minus) / (2 * step);
  }
  return out;
}

}  // namespace

double student_95(double freedom) {
  if (freedom >= 200) return 1.959964 + 2.372 / freedom;  // two terms of the expansion in 1 / freedom
  const int whole = std::max(1, static_cast<int>(std::floor(freedom)));
  return student_whole(whole);
}

double correlation_length(const Eigen::VectorXd& r) {
  const Eigen::Index n = r.size();
  if (n < 3) return 1;
  const double square = r.squaredNorm();
  if (!(square > 0)) return 1;
  const double correlation = r.head(n - 1).dot(r.tail(n - 1)) / square;
  return std::max(1.0, (1 + correlation) / std::max(1 - correlation, 1e-12));
}

Estimate LeastSquares::estimate(double value, const Eigen::VectorXd& gradient, double correlation) const {
  const double left = static_cast<double>(residuals.size()) / correlation - static_cast<double>(parameters.size());
  if (freedom() < 1 || left < 1 || !converged) return {value, -1};
  const double variance = sum_of_squares / freedom() * correlation * gradient.dot(inverse_normal * gradient);
  return {value, student_95(left) * std::sqrt(std::max(variance, 0.0))};
}

Estimate LeastSquares::estimate(int parameter, double correlation) const {
  return estimate(parameters[parameter], Eigen::VectorXd::Unit(parameters.size(), parameter), correlation);
}

LeastSquares minimise(const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& residual, int n,
                      const Eigen::VectorXd& start) {
  LeastSquares out;
  out.parameters = start;
  out.residuals.resize(n);
  residual(out.parameters, out.residuals);
  out.sum_of_squares = out.residuals.squaredNorm();
  const Eigen::Index size = start.size();
  Eigen::VectorXd trial_residuals(n);
  double damping = 1e-3;
  for (int iteration = 0; iteration < 100 && !out.converged; ++iteration) {
    const Eigen::MatrixXd jacobian = derivatives(residual, n, out.parameters);
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::VectorXd slope = jacobian.transpose() * out.residuals;
    bool better = false;
    for (int attempt = 0; attempt < 30 && !better; ++attempt) {
      Eigen::MatrixXd damped = normal;
      for (Eigen::Index i = 0; i < size; ++i) damped(i, i) += damping * normal(i, i) + 1e-300;
      const Eigen::VectorXd step = damped.ldlt().solve(-slope);
      const Eigen::VectorXd trial = out.parameters + step;
      residual(trial, trial_residuals);
      const double sum = trial_residuals.squaredNorm();
      better = std::isfinite(sum) && sum <= out.sum_of_squares;
      if (!better) {
        damping *= 4;
        continue;
      }
      damping = std::max(damping / 5, 1e-15);
      const double scale = (step.array().abs() / (out.parameters.array().abs() + 1e-3)).maxCoeff();
      out.converged = scale < 1e-9 || out.sum_of_squares - sum <= 1e-13 * out.sum_of_squares;
      out.parameters = trial;
      out.residuals = trial_residuals;
      out.sum_of_squares = sum;
    }
    if (!better) {  // no step goes down any more: a minimum to rounding
      out.converged = true;
    }
  }
  const Eigen::MatrixXd jacobian = derivatives(residual, n, out.parameters);
  out.inverse_normal = (jacobian.transpose() * jacobian).ldlt().solve(Eigen::MatrixXd::Identity(size, size));
  return out;
}

}  // namespace seaway::analysis
