#include "core/transfer/linear.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/transfer/local_rbf.hpp"

namespace seaway::transfer {

template <int Dim>
WeightRule<Dim> linear_rule() {
  return [](const std::vector<Vec<Dim>>& points, const std::vector<Vec<Dim>>& targets) {
    PointWeights out;
    out.weight = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(targets.size()),
                                       static_cast<Eigen::Index>(points.size()));
    bool complete = true;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      double sum = 0;
      for (std::size_t j = 0; j < points.size(); ++j) {
        double w = 1;
        for (int a = 0; a < Dim; ++a) w *= std::max(0.0, 1 - std::abs(points[j][a] - targets[t][a]));
        out.weight(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(j)) = w;
        sum += w;
      }
      complete = complete && std::abs(sum - 1) < 1e-12;
    }
    if (complete) return out;
    PointWeights fit = least_squares_weights<Dim>(points, targets);
    if (fit.weight.size() == 0) fail(ErrorCode::internal, "a stencil of the mesh is flat");
    fit.fell_back = true;
    return fit;
  };
}

template WeightRule<2> linear_rule<2>();
template WeightRule<3> linear_rule<3>();

}  // namespace seaway::transfer
