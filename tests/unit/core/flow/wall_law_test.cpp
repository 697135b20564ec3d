#include "core/flow/wall_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/flow/k_epsilon.hpp"

namespace seaway::flow::wall_law {
namespace {

constexpr double nu = 1e-6;

double log_law(double y_plus) { return std::log(smoothness * y_plus) / kappa; }

TEST(WallLaw, BranchesMeetWhereTheyShould) {
  EXPECT_NEAR(log_law(sublayer), sublayer, 1e-3 * sublayer);  // printed digits of 11.225
}

TEST(WallLaw, FrictionVelocityIsThatOfTheLogLaw) {
  for (const double y_plus : {12.0, 30.0, 200.0, 5000.0}) {
    const double u_tau = 0.03, y = y_plus * nu / u_tau;
    EXPECT_NEAR(friction_velocity(u_tau * log_law(y_plus), y, nu), u_tau, 1e-8 * u_tau) << y_plus;
  }
}

TEST(WallLaw, FrictionVelocityIsViscousInTheSublayer) {
  const double y = 1e-3, u = 0.05;  // y+ u+ = 50
  EXPECT_NEAR(friction_velocity(u, y, nu), std::sqrt(nu * u / y), 1e-15);
  EXPECT_EQ(friction_velocity(0, y, nu), 0);
}

TEST(WallLaw, SensitisedStressWithoutGradientIsTheLogLawInEquilibrium) {
  const double u_tau = 0.03, y_plus = 150, y = y_plus * nu / u_tau;
  const double k = u_tau * u_tau / std::sqrt(k_epsilon::c_mu);
  EXPECT_NEAR(sensitised_stress(u_tau * log_law(y_plus), y, nu, k, 0), u_tau * u_tau, 1e-8 * u_tau * u_tau);
}

TEST(WallLaw, AdverseGradientLowersTheStressToNothing) {
  const double u_tau = 0.03, y_plus = 150, y = y_plus * nu / u_tau;
  const double k = u_tau * u_tau / std::sqrt(k_epsilon::c_mu), u = u_tau * log_law(y_plus);
  const double none = sensitised_stress(u, y, nu, k, 0);
  const double adverse = sensitised_stress(u, y, nu, k, 1.0), favourable = sensitised_stress(u, y, nu, k, -1.0);
  EXPECT_LT(adverse, 0.98 * none);
  EXPECT_NEAR(favourable - none, none - adverse, 1e-9 * none);  // linear in the gradient
  EXPECT_EQ(sensitised_stress(u, y, nu, k, 1e4), 0);
}

TEST(WallLaw, SourcesBalanceForTheEnergyOfTheLogLayer) {
  const double u_tau = 0.03, y = 5e-3, k = u_tau * u_tau / std::sqrt(k_epsilon::c_mu);
  const Sources s = equilibrium_sources(u_tau * u_tau, y, nu);
  EXPECT_NEAR(s.production / std::sqrt(k), s.dissipation * std::pow(k, 1.5), 1e-12);
  EXPECT_NEAR(s.dissipation * std::pow(k, 1.5), std::pow(u_tau, 3) / (kappa * y), 1e-9);
  EXPECT_EQ(equilibrium_sources(1e-10, y, nu).production, 0);  // y+ = 0.05
}

TEST(WallLaw, AveragedSourcesTendToTheLogLayersOwnFarFromTheSublayer) {
  const double u_tau = 1, y = 0.1, k = u_tau * u_tau / std::sqrt(k_epsilon::c_mu);  // y+ = 1e5
  const Sources s = averaged_sources(u_tau * u_tau, y, nu, k);
  const double production = s.production / std::sqrt(k), dissipation = s.dissipation * std::pow(k, 1.5);
  // Both are the integral of u_tau^3 / (kappa y) over the cell but for the sublayer's small share.
  const double exact = std::pow(u_tau, 3) / (kappa * 2 * y) * std::log(2 * y / (sublayer * nu / u_tau));
  EXPECT_NEAR(production, exact, 1e-9 * exact);
  EXPECT_NEAR(dissipation, exact, 0.1 * exact);
}

}  // namespace
}  // namespace seaway::flow::wall_law
