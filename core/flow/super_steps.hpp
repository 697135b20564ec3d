// Diffusion over a step of any length by stages: the Runge-Kutta-Legendre scheme of first order [meyer2014].
//   Y_1 = Y_0 + m_1 dt L(Y_0),   Y_j = a_j Y_(j-1) + b_j Y_(j-2) + m_j dt L(Y_(j-1)),   j = 2 .. s
// is stable for dt <= (s^2 + s) / 2 times the limit of the explicit Euler step, and keeps a positive field
// positive; one stage is that step. The work grows with the square root of dt, there is no system to solve.
#pragma once

namespace seaway::flow {

struct SuperStep {
  double previous = 1;  ///< a_j
  double before = 0;    ///< b_j
  double rate = 1;      ///< m_j
};

/// Stages for a step of `ratio` explicit limits, at least 1. Throws Error(diverged) for what is not a number or
/// would need more than 1000 stages.
int super_stages(double ratio);

/// Weights of stage j = 1 .. s.
SuperStep super_step(int stage, int stages);

}  // namespace seaway::flow
