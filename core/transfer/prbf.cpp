#include "core/transfer/prbf.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/base/constants.hpp"
#include "core/base/error.hpp"
#include "core/base/run_context.hpp"
#include "core/mesh/parallel.hpp"
#include "core/transfer/local_rbf.hpp"

namespace seaway::transfer {
namespace {

using Index = Eigen::Index;

int least_tail(Kernel kernel) {
  switch (kernel) {
    case Kernel::r:
    case Kernel::multiquadric: return 0;
    case Kernel::r3:
    case Kernel::thin_plate: return 1;
    case Kernel::gaussian:
    case Kernel::wendland_c2: return -1;
  }
  return -1;
}

/// Kernels that are negative definite on the complement of the tail.
double sign_of(Kernel kernel) {
  return kernel == Kernel::r || kernel == Kernel::multiquadric ? -1.0 : 1.0;
}

bool has_shape(Kernel kernel) {
  return kernel == Kernel::multiquadric || kernel == Kernel::gaussian || kernel == Kernel::wendland_c2;
}

/// Calls f(phi) with phi a function of r^2.
template <class F>
void with_kernel(Kernel kernel, F&& f) {
  switch (kernel) {
    case Kernel::r: return f([](double s) { return std::sqrt(s); });
    case Kernel::r3: return f([](double s) { return s * std::sqrt(s); });
    case Kernel::thin_plate: return f([](double s) { return s > 0 ? 0.5 * s * std::log(s) : 0.0; });
    case Kernel::multiquadric: return f([](double s) { return std::sqrt(1 + s); });
    case Kernel::gaussian: return f([](double s) { return std::exp(-s); });
    case Kernel::wendland_c2:
      return f([](double s) {
        const double r = std::sqrt(s), left = std::max(0.0, 1 - r);
        return left * left * left * left * (4 * r + 1);
      });
  }
}

/// Edge of the cube that each of m points has to itself in the box of all points.
template <int Dim>
double spacing(const std::vector<Vec<Dim>>& points, double m) {
  Vec<Dim> low = points.front(), high = points.front();
  for (const auto& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  double volume = 1;
  int axes = 0;
  for (int a = 0; a < Dim; ++a) {
    if (high[a] > low[a]) volume *= high[a] - low[a], ++axes;
  }
  return axes == 0 ? 1.0 : std::pow(volume / m, 1.0 / axes);
}

/// Interleaved bits of the position in the box, 20 bits an axis.
template <int Dim>
std::uint64_t morton(const Vec<Dim>& x, const Vec<Dim>& low, const Vec<Dim>& size) {
  std::uint64_t key = 0;
  for (int a = 0; a < Dim; ++a) {
    const double part = size[a] > 0 ? (x[a] - low[a]) / size[a] : 0;
    const auto q = static_cast<std::uint64_t>(part * ((1 << 20) - 1));
    for (int bit = 0; bit < 20; ++bit) key |= ((q >> bit) & 1) << (bit * Dim + a);
  }
  return key;
}

template <int Dim>
std::vector<Index> order_of(const PrbfOptions& options, const std::vector<Vec<Dim>>& points) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), Index{0});
  if (options.ordering == Ordering::shuffle) {
    std::mt19937_64 rng(options.seed);  // own shuffle: std::shuffle differs between libraries
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng() % i]);
  } else if (options.ordering == Ordering::morton) {
    Vec<Dim> low = points.front(), high = points.front();
    for (const auto& x : points) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    std::vector<std::uint64_t> key;
    key.reserve(points.size());
    for (const auto& x : points) key.push_back(morton<Dim>(x, low, high - low));
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return key[static_cast<std::size_t>(a)] < key[static_cast<std::size_t>(b)];
    });
  }
  return order;
}

/// One subset's interpolant.
template <int Dim>
struct Interpolant {
  std::vector<Vec<Dim>> centre;  ///< in units of L, from `origin`
  Vec<Dim> origin;
  double length = 1;
  Eigen::MatrixXd lambda;  ///< [field, centre], so that a centre's weights are contiguous
  Eigen::MatrixXd beta;    ///< [monomial, field]
  bool degenerate = false, indefinite = false;
};

/// Solves for the weights. With the QR factors of the tail matrix P the moment conditions P^T lambda = 0
/// leave lambda = Q2 y, and Q2^T A Q2 is definite: Cholesky instead of an indefinite saddle system.
template <int Dim>
void solve(const PrbfOptions& options, const Eigen::MatrixXd& f, Interpolant<Dim>& s) {
  const auto m = static_cast<Index>(s.centre.size());
  Eigen::MatrixXd a(m, m);
  with_kernel(options.kernel, [&](auto phi) {
    for (Index j = 0; j < m; ++j)
      for (Index i = 0; i < m; ++i)
        a(i, j) = phi((s.centre[static_cast<std::size_t>(i)] - s.centre[static_cast<std::size_t>(j)])
                          .squaredNorm());
  });
  const Index q = monomials<Dim>(Vec<Dim>::Zero(), options.tail_degree).size();
  Eigen::MatrixXd right = f, y;
  Index rank = 0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  if (q > 0) {
    Eigen::MatrixXd p(m, q);
    for (Index i = 0; i < m; ++i)
      p.row(i) = monomials<Dim>(s.centre[static_cast<std::size_t>(i)], options.tail_degree);
    qr.setThreshold(1e-10);
    qr.compute(p);
    rank = qr.rank();  // lower for points on a plane: the tail is then determined only on it
    s.degenerate = rank < q;
    a.applyOnTheLeft(qr.householderQ().setLength(rank).adjoint());
    a.applyOnTheRight(qr.householderQ().setLength(rank));
    right.applyOnTheLeft(qr.householderQ().setLength(rank).adjoint());
  }
  const Index free = m - rank;
  const double sign = sign_of(options.kernel);
  const Eigen::MatrixXd corner = a.topRightCorner(rank, free);
  {
    Eigen::MatrixXd block = sign * a.bottomRightCorner(free, free);
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(block);
    if (cholesky.info() == Eigen::Success) {
      y = sign * cholesky.solve(right.bottomRows(free));
    } else {
      s.indefinite = true;
      y = a.bottomRightCorner(free, free).partialPivLu().solve(right.bottomRows(free));
    }
  }
  Eigen::MatrixXd lambda = Eigen::MatrixXd::Zero(m, f.cols());
  lambda.bottomRows(free) = y;
  s.beta = Eigen::MatrixXd::Zero(q, f.cols());
  if (q > 0) {
    const Eigen::MatrixXd rest = right.topRows(rank) - corner * y;
    Eigen::MatrixXd pivoted = Eigen::MatrixXd::Zero(q, f.cols());
    pivoted.topRows(rank) =
        qr.matrixR().topLeftCorner(rank, rank).template triangularView<Eigen::Upper>().solve(rest);
    s.beta = qr.colsPermutation() * pivoted;
    lambda.applyOnTheLeft(qr.householderQ().setLength(rank));
  }
  s.lambda = lambda.transpose();
}

/// Adds factor x the interpolant at targets [begin, end) to out.
template <int Dim, class Phi>
void add_values(const Interpolant<Dim>& s, const std::vector<Vec<Dim>>& targets, std::size_t begin,
                std::size_t end, double factor, int tail_degree, Phi phi, Eigen::MatrixXd& out) {
  constexpr int tile = 32;
  const Index fields = s.lambda.rows();
  double x[Dim][tile] = {}, value[tile];
  std::vector<double> sum(static_cast<std::size_t>(fields) * tile, 0.0);
  const auto count = static_cast<int>(end - begin);
  for (int t = 0; t < count; ++t)
    for (int a = 0; a < Dim; ++a)
      x[a][t] = (targets[begin + static_cast<std::size_t>(t)][a] - s.origin[a]) / s.length;
  for (std::size_t j = 0; j < s.centre.size(); ++j) {
    for (int t = 0; t < tile; ++t) {
      double r2 = 0;
      for (int a = 0; a < Dim; ++a) {
        const double d = x[a][t] - s.centre[j][a];
        r2 += d * d;
      }
      value[t] = phi(r2);
    }
    for (Index f = 0; f < fields; ++f) {
      const double w = s.lambda(f, static_cast<Index>(j));
      double* to = sum.data() + f * tile;
      for (int t = 0; t < tile; ++t) to[t] += w * value[t];
    }
  }
  for (int t = 0; t < count; ++t) {
    Vec<Dim> at;
    for (int a = 0; a < Dim; ++a) at[a] = x[a][t];
    const Eigen::RowVectorXd p = monomials<Dim>(at, tail_degree);
    for (Index f = 0; f < fields; ++f) {
      double v = sum[static_cast<std::size_t>(f * tile + t)];
      for (Index q = 0; q < p.size(); ++q) v += p[q] * s.beta(q, f);
      out(static_cast<Index>(begin) + t, f) += factor * v;
    }
  }
}

template <int Dim>
Interpolant<Dim> make_interpolant(const PrbfOptions& options, const std::vector<Vec<Dim>>& points,
                                  const Eigen::MatrixXd& values, const std::vector<Index>& order,
                                  std::size_t first) {
  Interpolant<Dim> s;
  std::vector<Index> members;
  for (std::size_t i = first; i < order.size(); i += static_cast<std::size_t>(options.k))
    members.push_back(order[i]);
  s.origin.setZero();
  for (const Index i : members) s.origin += points[static_cast<std::size_t>(i)];
  s.origin /= static_cast<double>(members.size());
  const double shape = has_shape(options.kernel) ? options.shape : 1.0;
  s.length = shape * spacing<Dim>(points, static_cast<double>(members.size()));
  Eigen::MatrixXd f(static_cast<Index>(members.size()), values.cols());
  for (std::size_t j = 0; j < members.size(); ++j) {
    s.centre.push_back((points[static_cast<std::size_t>(members[j])] - s.origin) / s.length);
    f.row(static_cast<Index>(j)) = values.row(members[j]);
  }
  solve<Dim>(options, f, s);
  return s;
}

template <int Dim>
void check(const PrbfOptions& o, std::int64_t n) {
  SEAWAY_CHECK(o.k >= 1, "prbf k is {}; it must be at least 1", o.k);
  SEAWAY_CHECK(o.subsets >= 0 && o.subsets <= o.k,
               "prbf subsets is {}; it must lie between 0 (all) and k = {}", o.subsets, o.k);
  SEAWAY_CHECK(o.tail_degree >= least_tail(o.kernel) && o.tail_degree <= 2,
               "prbf tail degree is {}; this kernel needs {} to 2", o.tail_degree, least_tail(o.kernel));
  SEAWAY_CHECK(o.shape > 0, "prbf shape is {}; it must be positive", o.shape);
  const Index tail = monomials<Dim>(Vec<Dim>::Zero(), o.tail_degree).size();
  SEAWAY_CHECK(n / o.k > tail, "prbf k = {} leaves subsets of {} points out of {}; use a smaller k", o.k,
               n / o.k, n);
  const double memory = prbf_memory(n, o);
  if (memory > o.memory_limit) {
    fail(ErrorCode::resource_exhausted,
         "prbf with k = {} over {} points needs about {:.2g} GB, more than the limit of {:.2g} GB; "
         "raise k or use local-rbf", o.k, n, memory * 1e-9, o.memory_limit * 1e-9);
  }
}

}  // namespace

double prbf_memory(std::int64_t n, const PrbfOptions& options) {
  const double m = std::ceil(static_cast<double>(n) / options.k);
  return 2 * 8 * m * m;
}

template <int Dim>
Eigen::MatrixXd prbf_interpolate(const PrbfOptions& options, const std::vector<Vec<Dim>>& points,
                                 const Eigen::MatrixXd& values, const std::vector<Vec<Dim>>& targets,
                                 int threads, PrbfReport* report) {
  const auto n = static_cast<std::int64_t>(points.size());
  SEAWAY_CHECK(values.rows() == n, "prbf has {} values for {} points", values.rows(), n);
  check<Dim>(options, n);
  const std::vector<Index> order = order_of<Dim>(options, points);
  const int count = options.subsets > 0 ? options.subsets : options.k;
  const double memory = prbf_memory(n, options);
  // Several subsets are factorised at a time as far as memory allows; they are added in their order.
  const int together = std::clamp(static_cast<int>(options.memory_limit / memory), 1, std::max(threads, 1));

  constexpr std::size_t tile = 32;
  const auto tiles = static_cast<int>((targets.size() + tile - 1) / tile);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Index>(targets.size()), values.cols());
  PrbfReport result;
  result.subsets = count;
  result.subset_size = (n + options.k - 1) / options.k;
  result.memory = memory * together;
  for (int done = 0; done < count; done += together) {
    const int now = std::min(together, count - done);
    std::vector<Interpolant<Dim>> batch(static_cast<std::size_t>(now));
    double start = process_cpu_seconds();
    mesh::parallel_for(now, threads, [&](int i) {
      const auto l = static_cast<std::size_t>(static_cast<std::int64_t>(done + i) * options.k / count);
      batch[static_cast<std::size_t>(i)] = make_interpolant<Dim>(options, points, values, order, l);
    });
    result.factor_cpu_s += process_cpu_seconds() - start;
    start = process_cpu_seconds();
    for (const auto& s : batch) {
      result.degenerate += s.degenerate;
      result.indefinite += s.indefinite;
      with_kernel(options.kernel, [&](auto phi) {
        mesh::parallel_for(tiles, threads, [&](int t) {
          const std::size_t begin = static_cast<std::size_t>(t) * tile;
          add_values<Dim>(s, targets, begin, std::min(begin + tile, targets.size()), 1.0 / count,
                          options.tail_degree, phi, out);
        });
      });
    }
    result.evaluate_cpu_s += process_cpu_seconds() - start;
  }
  if (report) *report = result;
  return out;
}

double prbf_filter(const Vec3& xi, int b, int beta) {
  const Vec3 x = xi * b;
  const double power = -0.5 * (3 + beta);
  if (x.squaredNorm() == 0) return 1;
  const double own = std::pow(x.squaredNorm(), power);
  constexpr int reach = 12;  // what lies beyond is less than 1e-3 of the sum for beta = 1
  double sum = 0;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k)
        sum += std::pow((x + 2 * pi * Vec3(i, j, k)).squaredNorm(), power);
  return own / sum;
}

template Eigen::MatrixXd prbf_interpolate<2>(const PrbfOptions&, const std::vector<Vec<2>>&,
                                             const Eigen::MatrixXd&, const std::vector<Vec<2>>&, int,
                                             PrbfReport*);
template Eigen::MatrixXd prbf_interpolate<3>(const PrbfOptions&, const std::vector<Vec<3>>&,
                                             const Eigen::MatrixXd&, const std::vector<Vec<3>>&, int,
                                             PrbfReport*);

}  // namespace seaway::transfer
