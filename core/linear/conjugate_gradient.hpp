// Conjugate gradients in double for the pressure, preconditioned by one multigrid cycle in float.
#pragma once

#include "core/linear/multigrid.hpp"

namespace seaway::linear {

struct [[nodiscard]] SolveReport {
  int iterations = 0;
  double residual_before = 0;  ///< largest |r_c| / V_c
  double residual_after = 0;
  bool converged = false;
};

template <int Dim>
class ConjugateGradient {
 public:
  explicit ConjugateGradient(const Forest<Dim>& forest);
  /// Solves A x = b from the given x to  max_c |r_c| / V_c <= tolerance  (V_c the full cell volume).
  /// Not converged: x is the last iterate; NaN in the residual stops at once.
  SolveReport solve(const PoissonOperator<Dim>& op, Multigrid<Dim>& preconditioner,
                    const CellField<double, Dim>& b, CellField<double, Dim>& x, double tolerance,
                    int max_iterations);

 private:
  double largest_residual() const;
  const Forest<Dim>& forest_;
  CellField<double, Dim> r_, p_, q_;
};

extern template class ConjugateGradient<2>;
extern template class ConjugateGradient<3>;

}  // namespace seaway::linear
