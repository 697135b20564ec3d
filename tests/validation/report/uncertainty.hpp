// How far a value on the finest mesh may be from that on an infinitely fine one, from the same quantity on several
// meshes; and what a comparison with a measurement can say given that. Pure functions.
//
//   4 meshes and more  least squares fits of powers of h [eca2014]
//   3 meshes           Richardson extrapolation [celik2008], factor of safety by the observed order [xing2010]
//   2 meshes           grid convergence index with the formal order and the factor 3 [roache1994]
//
// Values that do not come closer to each other (oscillating, diverging) get three times their range.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace seaway::validation {

/// One quantity on several meshes, in any order; h: edge of the cells, in any unit.
struct GridSeries {
  std::vector<double> h, value;
  double formal_order = 2;
};

struct NumericalUncertainty {
  std::string method;                  ///< one line: procedure and factor of safety
  std::optional<double> order;         ///< observed; none where the values say nothing about it
  std::optional<double> extrapolated;  ///< to h = 0
  double fit_deviation = 0;            ///< standard deviation of a least squares fit
  double expanded = 0;                 ///< U, 95 % interval of the finest value: +- U
  bool converging = false;             ///< the values come closer to each other as h falls
};

/// Nothing for a single mesh. Before: sizes agree, h > 0 and different, values finite; else Error(invalid_argument).
std::optional<NumericalUncertainty> numerical_uncertainty(GridSeries series);

/// Order p of f = f0 + C h^p through three meshes h1 < h2 < h3, any ratios [celik2008]; nothing unless the differences have
/// one sign and fall.
std::optional<double> order_of_three(const double h[3], const double f[3]);

/// Comparison of a computed with a measured value [asme2009]: E = S - D is the model's error to +- 2 u_val.
struct Comparison {
  double error = 0;                ///< E
  double u_num = 0, u_input = 0, u_data = 0, u_val = 0;  ///< standard uncertainties
  /// Whether the error is larger than what the comparison can resolve.
  bool significant() const;
};
Comparison compare(double computed, double measured, double expanded_numerical, double u_input, double u_data);

}  // namespace seaway::validation
