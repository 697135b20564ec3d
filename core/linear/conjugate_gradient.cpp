#include "core/linear/conjugate_gradient.hpp"

#include <cmath>

namespace seaway::linear {
namespace {

/// Sum over a block in 8 lanes: independent of vector width and of the compiler's mood.
template <int Dim, class F>
double block_sum(F&& f) {
  double lanes[8] = {};
  for (int i = 0; i < BlockShape<Dim>::cells; i += 8)
    for (int l = 0; l < 8; ++l) lanes[l] += f(i + l);
  double sum = 0;
  for (const double x : lanes) sum += x;
  return sum;
}

}  // namespace

template <int Dim>
ConjugateGradient<Dim>::ConjugateGradient(const Forest<Dim>& forest)
    : forest_(forest), r_(forest), p_(forest), q_(forest) {}

template <int Dim>
double ConjugateGradient<Dim>::largest_residual() const {
  return forest_.max_over_leaves(0.0, [&](int b) {
    const double* r = r_.block(b);
    double m = 0, sum = 0;
    for (int i = 0; i < BlockShape<Dim>::cells; ++i) {
      m = std::max(m, std::abs(r[i]));
      sum += r[i];
    }
    if (!std::isfinite(sum)) return std::nan("");
    return m / forest_.block(b).cell_volume();
  });
}

template <int Dim>
SolveReport ConjugateGradient<Dim>::solve(const PoissonOperator<Dim>& op, Multigrid<Dim>& preconditioner,
                                          const CellField<double, Dim>& b, CellField<double, Dim>& x,
                                          double tolerance, int max_iterations) {
  constexpr int cells = BlockShape<Dim>::cells;
  SolveReport report;
  op.apply(x, q_);
  forest_.for_each_leaf([&](int blk) {
    const double *bb = b.block(blk), *q = q_.block(blk);
    double* r = r_.block(blk);
    for (int i = 0; i < cells; ++i) r[i] = bb[i] - q[i];
  });
  report.residual_before = report.residual_after = largest_residual();
  double rho_old = 0;
  while (!(report.residual_after <= tolerance) && report.iterations < max_iterations) {
    if (!std::isfinite(report.residual_after)) return report;
    preconditioner.apply(r_);
    const double scale = preconditioner.scale();
    const double rho = scale * forest_.sum_over_leaves([&](int blk) {
      const float* z = preconditioner.solution(blk);
      const double* r = r_.block(blk);
      return block_sum<Dim>([&](int i) { return static_cast<double>(z[i]) * r[i]; });
    });
    if (!(rho > 0)) return report;
    const double beta = report.iterations == 0 ? 0.0 : rho / rho_old;
    rho_old = rho;
    forest_.for_each_leaf([&](int blk) {
      const float* z = preconditioner.solution(blk);
      double* p = p_.block(blk);
      if (report.iterations == 0) {
        for (int i = 0; i < cells; ++i) p[i] = scale * static_cast<double>(z[i]);
      } else {
        for (int i = 0; i < cells; ++i) p[i] = scale * static_cast<double>(z[i]) + beta * p[i];
      }
    });
    const double curvature = op.apply(p_, q_);
    if (!(curvature > 0)) return report;
    const double alpha = rho / curvature;
    forest_.for_each_leaf([&](int blk) {
      const double *p = p_.block(blk), *q = q_.block(blk);
      double *r = r_.block(blk), *xx = x.block(blk);
      for (int i = 0; i < cells; ++i) {
        xx[i] += alpha * p[i];
        r[i] -= alpha * q[i];
      }
    });
    report.residual_after = largest_residual();
    ++report.iterations;
  }
  report.converged = report.residual_after <= tolerance;
  return report;
}

template class ConjugateGradient<2>;
template class ConjugateGradient<3>;

}  // namespace seaway::linear
