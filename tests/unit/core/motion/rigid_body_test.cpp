#include "core/motion/rigid_body.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.hpp"

namespace seaway::motion {
namespace {

RigidBody<3> ship() {
  RigidBody<3> body = make_rigid_body<3>(63.5, Vec3(0.1, 0, 0.148), Vec3(0.12, 0.69, 0.7));
  body.inertia(0, 2) = body.inertia(2, 0) = -0.6;  // product of inertia: bow high, stern low
  return body;
}

const Pose<3> heeled = make_pose<3>(Vec3(0, 0, 0.03), {0.4, -0.2, 1.0});

TEST(RigidBody, EffectiveInverseMassIsTheConstrainedInverse) {
  const DofMatrix<3> m = mass_matrix(ship(), heeled);
  for (int mask = 0; mask < 64; ++mask) {
    FreeDofs<3> free{};
    std::vector<int> rows;
    for (int i = 0; i < 6; ++i) {
      free[i] = (mask >> i & 1) != 0;
      if (free[i]) rows.push_back(i);
    }
    const int n = static_cast<int>(rows.size());
    Eigen::MatrixXd s = Eigen::MatrixXd::Zero(6, n);
    for (int i = 0; i < n; ++i) s(rows[i], i) = 1;
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 6);
    if (n > 0) expected = s * (s.transpose() * m * s).inverse() * s.transpose();
    const DofMatrix<3> ours = effective_inverse_mass(ship(), heeled, free);
    EXPECT_LT((ours - expected).cwiseAbs().maxCoeff(),
              1e-12 * (1 + expected.cwiseAbs().maxCoeff()));
    EXPECT_EQ(ours, DofMatrix<3>(ours.transpose()));
    const Eigen::SelfAdjointEigenSolver<DofMatrix<3>> eigen(ours);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-14);
    for (int i = 0; i < 6; ++i) {
      if (free[i]) continue;
      EXPECT_TRUE(ours.row(i).isZero(0));
    }
  }
}

TEST(RigidBody, SectionHasPlainReciprocals) {
  const RigidBody<2> body = make_rigid_body<2>(15, Vec3(0, 0, 0.05), Vec3(0.132, 0, 0));
  const DofMatrix<2> inverse =
      effective_inverse_mass(body, Pose<2>{}, free_dofs<2>({Dof::heave, Dof::roll}));
  DofMatrix<2> expected = DofMatrix<2>::Zero();
  expected(1, 1) = 1.0 / 15;
  expected(2, 2) = 1 / (15 * 0.132 * 0.132);
  EXPECT_LT((inverse - expected).norm(), 1e-13);
  EXPECT_TRUE(gyroscopic_load(body, Pose<2>{}, Twist<2>(1, 2, 3)).isZero(0));
}

TEST(RigidBody, HullAxesTransformsAreInverse) {
  const RigidBody<3> body = ship();
  const Vec3 x(1.2, -0.1, 0.05);
  EXPECT_LT((earth_to_hull<3>(body, heeled, hull_to_earth<3>(body, heeled, x)) - x).norm(), 1e-14);
  EXPECT_LT((hull_to_earth<3>(body, heeled, body.cog) - heeled.cog).norm(), 1e-15);
}

TEST(RigidBody, TorqueFreeTumblingConservesMomentumAndEnergy) {
  // Rotation about the middle axis is unstable: the body tumbles, a severe test.
  const RigidBody<3> body = make_rigid_body<3>(2, Vec3::Zero(), Vec3(0.3, 0.5, 0.55));
  const FreeDofs<3> all{true, true, true, true, true, true};
  const auto energy_drift = [&](double dt) {
    Pose<3> pose;
    Twist<3> twist;
    twist << 0.3, 0, 0, 0.02, 3, 0.01;
    const double energy = kinetic_energy(body, pose, twist);
    const Vec3 momentum = earth_inertia(body, pose) * twist.tail<3>();
    double worst = 0;
    for (int i = 0; i * dt < 20; ++i) {
      // Centred in time: the pose moves with the twist at its own half step.
      const Pose<3> half = advance(pose, twist, dt / 2);
      const Twist<3> mid = keep_momentum(body, pose, half, twist, all);
      const Pose<3> next = advance(pose, mid, dt);
      twist = keep_momentum(body, pose, next, twist, all);
      pose = next;
      worst = std::max(worst, std::abs(kinetic_energy(body, pose, twist) / energy - 1));
    }
    const Vec3 now = earth_inertia(body, pose) * twist.tail<3>();
    EXPECT_LT((now - momentum).norm(), 1e-11 * momentum.norm());
    return worst;
  };
  const double coarse = energy_drift(0.01), fine = energy_drift(0.005);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.35 * coarse);  // second order
}

TEST(RigidBody, KeepMomentumEqualsGyroscopicLoadToFirstOrder) {
  const FreeDofs<3> rotations = free_dofs<3>({Dof::roll, Dof::pitch, Dof::yaw});
  Twist<3> twist;
  twist << 0.1, 0, 0, 1.0, 0.4, -0.7;
  const auto difference = [&](double dt) {
    const Twist<3> kept =
        keep_momentum(ship(), heeled, advance(heeled, twist, dt), twist, rotations);
    const Twist<3> loaded = twist + dt * effective_inverse_mass(ship(), heeled, rotations) *
                                        gyroscopic_load(ship(), heeled, twist);
    return (kept - loaded).norm();
  };
  EXPECT_LT(difference(1e-3), 1e-4);
  EXPECT_NEAR(difference(1e-3) / difference(5e-4), 4, 0.1);
}

TEST(RigidBody, HeldRotationsStayHeld) {
  const FreeDofs<3> free = free_dofs<3>({Dof::heave, Dof::roll});
  Twist<3> twist = Twist<3>::Zero();
  twist[3] = 1.0;
  const Twist<3> after = keep_momentum(ship(), heeled, advance(heeled, twist, 0.1), twist, free);
  EXPECT_EQ(after[4], 0);
  EXPECT_EQ(after[5], 0);
}

TEST(RigidBody, RefusesImpossibleBodies) {
  const auto message = [](auto make) -> std::string {
    try {
      make();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::invalid_argument);
      return e.what();
    }
    return "accepted";
  };
  using ::testing::HasSubstr;
  const Vec3 cog = Vec3::Zero();
  EXPECT_THAT(message([&] { make_rigid_body<2>(-1, cog, Vec3(0.1, 0, 0)); }),
              HasSubstr("mass is -1"));
  EXPECT_THAT(message([&] { make_rigid_body<2>(1, cog, Vec3(0, 1, 1)); }),
              HasSubstr("about x is 0"));
  EXPECT_THAT(message([&] { make_rigid_body<3>(1, cog, Vec3(0.1, 0.2, 0.9)); }),
              HasSubstr("impossible"));
  EXPECT_THAT(message([&] {
                make_rigid_body<3>(1, Vec3(0, 0, std::numeric_limits<double>::quiet_NaN()),
                                   Vec3(0.1, 0.2, 0.2));
              }),
              HasSubstr("finite"));
  EXPECT_THAT(message([] { free_dofs<2>({Dof::pitch}); }), HasSubstr("pitch cannot be free"));
}

}  // namespace
}  // namespace seaway::motion
