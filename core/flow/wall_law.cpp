#include "core/flow/wall_law.hpp"

#include <algorithm>
#include <cmath>

#include "core/flow/k_epsilon.hpp"

namespace seaway::flow::wall_law {
namespace {

const double quarter = std::pow(k_epsilon::c_mu, 0.25);
const double three_quarters = std::pow(k_epsilon::c_mu, 0.75);

double log_law(double y_plus) { return std::log(smoothness * y_plus) / kappa; }

}  // namespace

double friction_velocity(double u, double y, double nu) {
  const double reynolds = u * y / nu;  // y+ u+
  if (!(reynolds > sublayer * sublayer)) return std::sqrt(nu * std::max(u, 0.0) / y);
  double y_plus = std::max(sublayer, reynolds / 20);
  for (int i = 0; i < 30; ++i) {  // Newton
    const double next = std::max((kappa * reynolds + y_plus) / (1 + std::log(smoothness * y_plus)), sublayer);
    const bool done = std::abs(next - y_plus) < 1e-10 * next;
    y_plus = next;
    if (done) break;
  }
  return y_plus * nu / y;
}

double sensitised_stress(double u, double y, double nu, double k, double gradient) {
  const double speed = quarter * std::sqrt(std::max(k, k_epsilon::smallest_tke));
  const double y_star = speed * y / nu;
  if (y_star <= sublayer) return nu * std::max(u, 0.0) / y;
  const double y_v = sublayer * nu / speed;
  const double root = kappa * speed / quarter;
  const double reduced =
      u - 0.5 * gradient * (y_v / root * std::log(y / y_v) + (y - y_v) / root + y_v * y_v / nu);
  return std::max(reduced, 0.0) * speed / log_law(y_star);
}

Sources equilibrium_sources(double stress, double y, double nu) {
  const double y_plus = std::sqrt(stress) * y / nu;
  return {y_plus > sublayer ? stress * stress / (kappa * quarter * y) : 0.0, three_quarters / (kappa * y)};
}

Sources averaged_sources(double stress, double y, double nu, double k) {
  const double root = std::sqrt(std::max(k, k_epsilon::smallest_tke));
  const double y_v = sublayer * nu / (quarter * root), y_n = 2 * y;
  if (y_n <= y_v) return {0, 2 * nu / (y * y * root)};
  const double part = std::log(y_n / y_v) / y_n;
  return {stress * stress / (kappa * quarter) * part, 2 * nu / (root * y_v * y_n) + three_quarters / kappa * part};
}

}  // namespace seaway::flow::wall_law
