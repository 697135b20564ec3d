// The published stage-to-stage interpolation [fastmultigrid2022, equations 9 to 13], as a reference to compare with:
// the n points are dealt out to k subsets, subset l taking points l, l + k, l + 2k, ...; each subset's
// radial-basis-function interpolant is evaluated on its own and the k results are averaged:
//
//   s_l(x) = sum_j lambda_j phi(|x - X_j| / L) + sum_q beta_q p_q(x),   s(x) = 1/k sum_l s_l(x)
//
// Subsets are not parts of the domain: each spans it with k^(1/Dim) times coarser spacing, so the average
// is a low-pass filter with cut-off wavelength of about 2 k^(1/Dim) spacings (docs/mapping.md). Not
// recommended for production; core/transfer/local_rbf.hpp is more accurate and thousands of times cheaper.
//
// Cost: n^3 / (3 k^2) operations to factorise, n_targets x n kernel evaluations whatever k is.
// What the publication leaves open is an option here: kernel, shape, tail, order of the points.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vec.hpp"

namespace seaway::transfer {

enum class Kernel {
  r,             ///< r
  r3,            ///< r^3
  thin_plate,    ///< r^2 log r
  multiquadric,  ///< sqrt(1 + r^2)
  gaussian,      ///< exp(-r^2)
  wendland_c2,   ///< (1 - r)^4 (4 r + 1) for r < 1
};

enum class Ordering { as_is, morton, shuffle };

struct PrbfOptions {
  int k = 120;              ///< number of interleaved subsets; 1: one interpolant through all points
  int subsets = 0;          ///< average only so many of them, evenly chosen; 0: all k
  Kernel kernel = Kernel::r3;
  double shape = 2;         ///< L in spacings of the subset: multiquadric, gaussian, wendland_c2
  int tail_degree = 1;      ///< -1: none (gaussian, wendland_c2 only) .. 2; r3, thin_plate need 1, the others 0
  Ordering ordering = Ordering::as_is;
  std::uint64_t seed = 1;   ///< of the shuffle
  bool evaluate_all = true; ///< on forests: replace kept values as well, as published; false: new ones only
  double memory_limit = 4e9;  ///< [bytes]; refused beyond
};

struct PrbfReport {
  int subsets = 0;
  std::int64_t subset_size = 0;  ///< largest
  double memory = 0;             ///< estimate [bytes]
  int degenerate = 0;            ///< subsets whose points do not determine the whole tail
  int indefinite = 0;            ///< subsets solved by LU because Cholesky met a negative pivot
  double factor_cpu_s = 0, evaluate_cpu_s = 0;
};

/// Estimate of the working memory [bytes]: two m x m matrices of the subset size m = ceil(n / k).
double prbf_memory(std::int64_t n, const PrbfOptions& options);

/// values(i, f): field f at points[i]; returns field f at targets[t] in (t, f). Fields share the factors.
/// Points must differ. Threads change no bit. Throws Error(resource_exhausted) when the estimate exceeds
/// memory_limit, Error(invalid_argument) for options out of range or subsets smaller than the tail.
template <int Dim>
Eigen::MatrixXd prbf_interpolate(const PrbfOptions& options, const std::vector<Vec<Dim>>& points,
                                 const Eigen::MatrixXd& values, const std::vector<Vec<Dim>>& targets,
                                 int threads = 1, PrbfReport* report = nullptr);

/// The amplitude that a mode of angular wave number `xi` (per spacing of the points) keeps, for kernels
/// r^beta and subsets that are the k = b^3 shifted sublattices of an unbounded lattice [buhmann2003]:
///   |xi b|^-(3 + beta) / sum over integer j of |xi b + 2 pi j|^-(3 + beta)
double prbf_filter(const Vec3& xi, int b, int beta);

}  // namespace seaway::transfer
