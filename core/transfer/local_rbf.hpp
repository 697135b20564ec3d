// Weights of small radial-basis-function stencils, phi(r) = r^3 with a polynomial tail: no shape parameter,
// scale-invariant and well conditioned for the up to 150 points of a stencil [wendland2005; flyer2016].
//
//   s(x) = sum_j lambda_j |x - x_j|^3 + sum_q beta_q p_q(x),   s(x_j) = f_j,   sum_j lambda_j p_q(x_j) = 0
//
// Values are taken as point values at the lattice points, so tail degree d reproduces polynomials of degree
// d exactly. Pure functions of numbers.
#pragma once

#include "core/transfer/stencil.hpp"

namespace seaway::transfer {

/// Polynomials up to `degree` in Dim variables: 1, x, y, ..., then the second-degree products.
/// degree -1: none. At most 2.
template <int Dim>
Eigen::RowVectorXd monomials(const Vec<Dim>& x, int degree);

struct RbfOptions {
  int degree = 1;             ///< of the tail; 2 for smooth data, needs 3 points along every axis
  double lebesgue_limit = 6;  ///< largest sum of |weights| accepted
};

/// Weights of degree `degree`; where the points do not determine that polynomial or the weights are too large
/// the degree is lowered, then linear least squares with weights 1/r^2 are tried, then the value at the
/// origin (or nearest to it) is copied; each of these sets `fell_back`.
template <int Dim>
PointWeights rbf_weights(const std::vector<Vec<Dim>>& points, const std::vector<Vec<Dim>>& targets,
                         const RbfOptions& options);

/// Moving least squares of degree 1, weights 1/r^2 from each target. Empty `weight` if the points do not
/// span the space.
template <int Dim>
PointWeights least_squares_weights(const std::vector<Vec<Dim>>& points,
                                   const std::vector<Vec<Dim>>& targets);

template <int Dim>
WeightRule<Dim> rbf_rule(const RbfOptions& options);

}  // namespace seaway::transfer
