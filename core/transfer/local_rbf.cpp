#include "core/transfer/local_rbf.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <limits>

namespace seaway::transfer {
namespace {

double cube(double r) { return r * r * r; }

void measure(PointWeights& w) {
  w.lebesgue = w.weight.cwiseAbs().rowwise().sum().maxCoeff();
}

template <int Dim>
PointWeights rbf_of_degree(const std::vector<Vec<Dim>>& points, const std::vector<Vec<Dim>>& targets,
                           int degree) {
  const auto n = static_cast<Eigen::Index>(points.size());
  const auto m = static_cast<Eigen::Index>(targets.size());
  const Eigen::Index q = monomials<Dim>(Vec<Dim>::Zero(), degree).size();
  PointWeights out;
  if (n < q) return out;
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + q, n + q), right(n + q, m);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec<Dim>& x = points[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j)
      system(i, j) = cube((x - points[static_cast<std::size_t>(j)]).norm());
    system.row(i).tail(q) = monomials<Dim>(x, degree);
    system.col(i).tail(q) = system.row(i).tail(q).transpose();
    for (Eigen::Index t = 0; t < m; ++t)
      right(i, t) = cube((x - targets[static_cast<std::size_t>(t)]).norm());
  }
  for (Eigen::Index t = 0; t < m; ++t)
    right.col(t).tail(q) = monomials<Dim>(targets[static_cast<std::size_t>(t)], degree).transpose();
  Eigen::FullPivLU<Eigen::MatrixXd> factors(system);
  factors.setThreshold(1e-10);
  if (!factors.isInvertible()) return out;
  out.weight = factors.solve(right).topRows(n).transpose();
  measure(out);
  return out;
}

template <int Dim>
PointWeights copy_nearest(const std::vector<Vec<Dim>>& points, Eigen::Index targets) {
  Eigen::Index nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (points[j].squaredNorm() < least) {
      least = points[j].squaredNorm();
      nearest = static_cast<Eigen::Index>(j);
    }
  }
  PointWeights out;
  out.weight = Eigen::MatrixXd::Zero(targets, static_cast<Eigen::Index>(points.size()));
  out.weight.col(nearest).setOnes();
  return out;
}

}  // namespace

template <int Dim>
Eigen::RowVectorXd monomials(const Vec<Dim>& x, int degree) {
  std::vector<double> p;
  if (degree >= 0) p.push_back(1);
  if (degree >= 1)
    for (int a = 0; a < Dim; ++a) p.push_back(x[a]);
  if (degree >= 2)
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) p.push_back(x[a] * x[b]);
  return Eigen::Map<const Eigen::RowVectorXd>(p.data(), static_cast<Eigen::Index>(p.size()));
}

template <int Dim>
PointWeights least_squares_weights(const std::vector<Vec<Dim>>& points,
                                   const std::vector<Vec<Dim>>& targets) {
  const auto n = static_cast<Eigen::Index>(points.size());
  PointWeights out;
  Eigen::MatrixXd weight(static_cast<Eigen::Index>(targets.size()), n);
  for (std::size_t t = 0; t < targets.size(); ++t) {
    Eigen::MatrixXd a(n, Dim + 1);
    Eigen::VectorXd root(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Vec<Dim> d = points[static_cast<std::size_t>(j)] - targets[t];
      root[j] = 1 / std::max(d.norm(), 1e-6);  // square root of 1 / r^2
      a.row(j) = root[j] * monomials<Dim>(d, 1);
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
    if (qr.rank() < Dim + 1) return out;
    // The fitted polynomial at the target is its constant term: first row of the pseudo-inverse.
    const Eigen::MatrixXd inverse = qr.solve(Eigen::MatrixXd::Identity(n, n));
    weight.row(static_cast<Eigen::Index>(t)) = inverse.row(0).cwiseProduct(root.transpose());
  }
  out.weight = weight;
  measure(out);
  return out;
}

template <int Dim>
PointWeights rbf_weights(const std::vector<Vec<Dim>>& points, const std::vector<Vec<Dim>>& targets,
                         const RbfOptions& options) {
  for (int degree = options.degree; degree >= 1; --degree) {
    PointWeights w = rbf_of_degree<Dim>(points, targets, degree);
    w.fell_back = degree < options.degree;
    if (w.weight.size() > 0 && w.lebesgue <= options.lebesgue_limit) return w;
  }
  PointWeights w = least_squares_weights<Dim>(points, targets);
  if (!(w.weight.size() > 0 && w.lebesgue <= options.lebesgue_limit))
    w = copy_nearest<Dim>(points, static_cast<Eigen::Index>(targets.size()));
  w.fell_back = true;
  return w;
}

template <int Dim>
WeightRule<Dim> rbf_rule(const RbfOptions& options) {
  return [options](const std::vector<Vec<Dim>>& points, const std::vector<Vec<Dim>>& targets) {
    return rbf_weights<Dim>(points, targets, options);
  };
}

#define SEAWAY_INSTANTIATE(D)                                                                        \
  template Eigen::RowVectorXd monomials<D>(const Vec<D>&, int);                                      \
  template PointWeights least_squares_weights<D>(const std::vector<Vec<D>>&, const std::vector<Vec<D>>&); \
  template PointWeights rbf_weights<D>(const std::vector<Vec<D>>&, const std::vector<Vec<D>>&,       \
                                       const RbfOptions&);                                           \
  template WeightRule<D> rbf_rule<D>(const RbfOptions&);
SEAWAY_INSTANTIATE(2)
SEAWAY_INSTANTIATE(3)

}  // namespace seaway::transfer
